#pragma once
// Where the time of an update goes.

namespace vlf {

/// Seconds of the stages of DynamicRoom::update.
struct UpdateTimes {
    double place = 0;     ///< meshes and plans made ready, objects placed, what they cover
    double look = 0;      ///< rays from the objects into the room, direct light on them
    double shadows = 0;   ///< direct light taken from the room and, by objects that emit, given
    double exchange = 0;  ///< indirect light back and forth

    double total() const { return place + look + shadows + exchange; }
};

}  // namespace vlf
