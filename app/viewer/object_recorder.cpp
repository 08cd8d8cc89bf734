#include "object_recorder.h"

#include <algorithm>

namespace vlf::app {

ObjectRecorder::Track& ObjectRecorder::trackOf(std::uint64_t id) {
    const auto found = std::find_if(tracks_.begin(), tracks_.end(),
                                    [&](const Track& track) { return track.id == id; });
    if (found != tracks_.end()) return *found;
    tracks_.push_back({id, {}, {}, false});
    return tracks_.back();
}

void ObjectRecorder::record(double seconds, const Objects& objects) {
    for (Track& track : tracks_) track.there = false;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        if (!objects.shown(i)) continue;
        Track& track = trackOf(objects.id(i));
        const DynamicObject& now = objects.now(i);
        if (track.motion.empty() && seconds > 0) track.motion.record(0, now.pose, false);
        track.motion.record(seconds, now.pose, now.visible);
        track.object.source = objects.scenario().objects[i].source;
        track.object.object = now;
        track.object.object.name = objects.name(i);
        track.there = true;
    }
    for (Track& track : tracks_)
        if (!track.there)
            track.motion.record(seconds, track.motion.motion().keyframes.back().pose, false);
}

Scenario ObjectRecorder::scenario() const {
    Scenario scenario;
    for (const Track& track : tracks_) {
        scenario.objects.push_back(track.object);
        scenario.objects.back().motion = track.motion.motion();
        scenario.objects.back().object.visible = true;
    }
    return scenario;
}

}  // namespace vlf::app
