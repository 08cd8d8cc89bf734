#include "viewer/object_recorder.h"

#include "placed_objects.h"

#include <gtest/gtest.h>

namespace vlf::app {
namespace {

using test::bodyAt;
using test::PlacedObjects;
using test::unlightable;

TEST(ObjectRecorder, AReplayHasEveryFrameAsItWas) {
    PlacedObjects placed;
    Objects& objects = *placed.objects;
    ObjectRecorder recorder;
    std::vector<std::vector<DynamicObject>> frames;
    objects.select(0);
    for (int frame = 0; frame < 40; ++frame) {
        if (frame > 10 && frame < 20) objects.steer({{1, 0, 0.5f}, {0.3f, 0}, false}, 1 / 30.0f);
        if (frame == 25) objects.add(bodyAt("knot", {1, 1, 1}));
        if (frame == 30) objects.remove(1);
        placed.update(frame / 30.0);
        recorder.record(frame / 30.0, objects);
        frames.emplace_back();
        for (std::size_t i = 0; i < objects.size(); ++i) frames.back().push_back(objects.now(i));
    }
    const Scenario scenario = recorder.scenario();
    ASSERT_EQ(scenario.objects.size(), 3u);
    for (int frame = 0; frame < 40; ++frame) {
        std::vector<DynamicObject> replayed = objectsAt(scenario, frame / 30.0);
        std::erase_if(replayed, [](const DynamicObject& o) { return !o.visible; });
        ASSERT_EQ(replayed.size(), frames[frame].size()) << frame;
        for (std::size_t i = 0; i < replayed.size(); ++i) {
            EXPECT_EQ(replayed[i].name, frames[frame][i].name) << frame;
            EXPECT_EQ(replayed[i].pose, frames[frame][i].pose) << frame;
        }
    }
    EXPECT_LT(std::get<KeyframeMotion>(scenario.objects[0].motion).keyframes.size(), 16u)
        << "rests are short";
}

TEST(ObjectRecorder, ARecordingHasTheLastName) {
    PlacedObjects placed;
    ObjectRecorder recorder;
    recorder.record(0, *placed.objects);
    placed.objects->setName(1, "ball");
    recorder.record(1, *placed.objects);
    EXPECT_EQ(recorder.scenario().objects[0].object.name, "cube");
    EXPECT_EQ(recorder.scenario().objects[1].object.name, "ball");
}

TEST(ObjectRecorder, WhatWasNeverShownIsNotRecorded) {
    PlacedObjects placed;
    ObjectRecorder recorder;
    ScenarioObject cube = bodyAt("cube", {1, 1, 1});
    cube.object.settings = unlightable();
    placed.objects->add(cube);
    recorder.record(0, *placed.objects);
    placed.update(1);
    recorder.record(1, *placed.objects);
    EXPECT_EQ(recorder.scenario().objects.size(), 2u);
}

}  // namespace
}  // namespace vlf::app
