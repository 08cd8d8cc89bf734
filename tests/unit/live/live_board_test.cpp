#include "vlf/live/live_board.h"

#include <thread>

#include <gtest/gtest.h>

namespace vlf {
namespace {

LiveUpdate newRoom() {
    const auto room = std::make_shared<BakedRoom>();
    return {.room = room, .irradiance = {room, &room->field.atlas}};
}

LiveUpdate newLight() {
    return {.irradiance = std::make_shared<IrradianceAtlas>(), .stage = LiveStage::bounce};
}

TEST(LiveBoard, GivesAnUpdateOnce) {
    LiveBoard board;
    EXPECT_FALSE(board.takeUpdate());
    board.post(newRoom());
    EXPECT_TRUE(board.takeUpdate());
    EXPECT_FALSE(board.takeUpdate());
}

TEST(LiveBoard, NewLightDoesNotLoseTheRoomItIsOf) {
    LiveBoard board;
    const LiveUpdate room = newRoom(), light = newLight();
    board.post(room);
    board.post(light);
    const auto taken = board.takeUpdate();
    EXPECT_EQ(taken->room, room.room);
    EXPECT_EQ(taken->irradiance, light.irradiance);
    board.post(newLight());
    EXPECT_FALSE(board.takeUpdate()->room) << "it was taken before";
}

TEST(LiveBoard, ANewRoomReplacesOneThatWasNotTaken) {
    LiveBoard board;
    const LiveUpdate next = newRoom();
    board.post(newRoom());
    board.post(next);
    EXPECT_EQ(board.takeUpdate()->room, next.room);
}

TEST(LiveBoard, WhoeverShowsItNeverWaits) {
    LiveBoard board;
    board.note([](LiveStatus& s) { s.activity = "charts"; });
    EXPECT_EQ(board.status().activity, "charts");
    board.post(newRoom());
    board.note([&](LiveStatus& s) {  // holds the board
        s.activity = "bounces";
        std::thread([&] {
            EXPECT_EQ(board.status().activity, "charts");
            EXPECT_FALSE(board.takeUpdate());
        }).join();
    });
    EXPECT_EQ(board.status().activity, "bounces");
    EXPECT_TRUE(board.takeUpdate());
}

}  // namespace
}  // namespace vlf
