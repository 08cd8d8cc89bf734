#pragma once
// Writes down what objects do in a walk.

#include "objects.h"

#include "vlf/dynamic/motion_recorder.h"

namespace vlf::app {

class ObjectRecorder {
  public:
    /// How things are at a time, s, since the start.
    void record(double seconds, const Objects& objects);

    /// Every object that there has been, with how it moved; name, material and settings are its
    /// last.
    Scenario scenario() const;

  private:
    struct Track {
        std::uint64_t id = 0;
        ScenarioObject object;
        MotionRecorder motion;
        bool there = false;
    };

    Track& trackOf(std::uint64_t id);

    std::vector<Track> tracks_;
};

}  // namespace vlf::app
