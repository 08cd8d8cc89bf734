#include "vlf/live/live_bake.h"

#include "vlf/io/field_file.h"
#include "vlf/propagate/bake.h"
#include "vlf/scene/export_obj.h"
#include "vlf/scene/generate/generate.h"
#include "vlf/scene/import/import.h"
#include "vlf/scene/scene_hash.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>

namespace vlf {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/// Ample: a bake of these tests takes a fraction of a second on a machine with nothing else to do.
constexpr auto kPatience = 60s;

BakeParams quickParams() {
    BakeParams p = presetParams("draft");
    p.texelBudget = 3000;
    p.directions = 129;
    p.radianceDirections = 129;
    p.radianceCells = 32;
    return p;
}

LiveOptions quickOptions() {
    LiveOptions o;
    o.niceness = 0;
    o.interval = 0ms;
    o.watchInterval = 10ms;
    o.programVersion = "of the test";
    return o;
}

class LiveBakeTest : public testing::Test {
  protected:
    LiveBakeTest()
        : folder_(fs::path(testing::TempDir()) /
                  (std::string("live-") +
                   testing::UnitTest::GetInstance()->current_test_info()->name())) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~LiveBakeTest() override { fs::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    std::string writeExample(const std::string& name, const SceneOptions& options = {}) const {
        exportObj(generateScene(name, options), folder_.string(), name);
        return path(name + ".obj");
    }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path(name), std::ios::binary) << text;
        return path(name);
    }

    std::string read(const std::string& name) const {
        std::ostringstream text;
        text << std::ifstream(path(name), std::ios::binary).rdbuf();
        return text.str();
    }

    void replace(const std::string& file, const std::string& from, const std::string& to) const {
        std::string text = read(file);
        const std::size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << file;
        write(file, text.replace(at, from.size(), to));
    }

    const fs::path folder_;
};

/// A floor lit by a panel above it.
const std::string kFloor = "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nusemtl floor\nf -4 -3 -2 -1\n";
const std::string kLamp = "v -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\nusemtl lamp\nf -4 -3 -2 -1\n";
const std::string kMaterials =
    "newmtl floor\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0.5 0.5 0.5\nKe 1 1 1\n";

bool waitFor(const std::function<bool()>& condition) {
    for (const auto end = Clock::now() + kPatience; Clock::now() < end;) {
        if (condition()) return true;
        std::this_thread::sleep_for(1ms);
    }
    return false;
}

/// All updates up to the one that ends a bake.
std::vector<LiveUpdate> updatesOf(LiveBake& bake) {
    std::vector<LiveUpdate> updates;
    EXPECT_TRUE(waitFor([&] {
        if (auto update = bake.poll()) updates.push_back(*std::move(update));
        return !updates.empty() && updates.back().complete;
    })) << bake.status().error;
    return updates;
}

bool waitForError(const LiveBake& bake, const std::string& text) {
    return waitFor([&] { return bake.status().error.find(text) != std::string::npos; });
}

Vec3 meanIrradiance(const IrradianceAtlas& atlas) {
    Vec3 sum(0);
    for (const Vec3& e : atlas.irradiance) sum += e;
    return sum / static_cast<float>(atlas.irradiance.size());
}

TEST_F(LiveBakeTest, ShowsTheRoomAtOnceAndItsLightInOrder) {
    LiveBake bake({writeExample("cornell")}, quickParams(), quickOptions());
    const std::vector<LiveUpdate> updates = updatesOf(bake);
    ASSERT_FALSE(updates.empty());
    ASSERT_TRUE(updates.front().room);
    EXPECT_EQ(updates.front().preset, "preview");
    for (std::size_t i = 1; i < updates.size(); ++i) {
        const LiveUpdate &before = updates[i - 1], &now = updates[i];
        if (before.preset == now.preset) {
            EXPECT_LT(before.stage, LiveStage::finished);
            EXPECT_LE(before.stage, now.stage);
            EXPECT_LE(before.bounces, now.bounces);
        } else {
            EXPECT_TRUE(now.room) << "new charts";
            EXPECT_GE(now.stage, LiveStage::settled) << "darker than what was shown before";
        }
    }
    EXPECT_EQ(updates.back().preset, "draft");
    EXPECT_EQ(updates.back().stage, LiveStage::finished);
}

TEST_F(LiveBakeTest, LightFitsTheChartsItComesWith) {
    LiveBake bake({writeExample("cornell")}, quickParams(), quickOptions());
    std::shared_ptr<const BakedRoom> room;
    for (const LiveUpdate& update : updatesOf(bake)) {
        if (update.room) room = update.room;
        ASSERT_TRUE(update.irradiance);
        EXPECT_EQ(update.irradiance->width, room->field.atlas.width);
        EXPECT_EQ(update.irradiance->irradiance.size(), room->field.atlas.irradiance.size());
        const float mean = luminance(meanIrradiance(*update.irradiance));
        EXPECT_TRUE(mean > 0 && mean < 100) << mean;
    }
}

TEST_F(LiveBakeTest, EndsWithTheBitsOfABakeAndAFileOfThem) {
    const std::string file = writeExample("mirror-room", {.triangles = 1000});
    LiveBake live({file}, quickParams(), quickOptions());
    const std::vector<LiveUpdate> updates = updatesOf(live);
    ASSERT_TRUE(live.finished());

    ImportReport report;
    BakedRoom room{importScene({file}, report), {}};
    Progress progress;
    room.field = bake(room.scene, quickParams(), progress);
    room.field.record.programVersion = "of the test";
    room.field.record.sceneHash = sceneHash(room.scene);
    EXPECT_EQ(updates.back().irradiance->irradiance, room.field.atlas.irradiance);
    EXPECT_FALSE(updates.back().room->field.radiance.empty());
    writeField(path("live.vlf"), *live.finished());
    writeField(path("bake.vlf"), room);
    EXPECT_TRUE(read("live.vlf") == read("bake.vlf"));
}

TEST_F(LiveBakeTest, AFinishedRoomCanBeSavedWhileABetterOneIsBaked) {
    BakeParams wanted = presetParams("high");
    wanted.radianceDirections = 0;
    LiveBake bake({writeExample("cornell")}, wanted, quickOptions());
    ASSERT_TRUE(waitFor([&] { return bake.finished() != nullptr; }));
    EXPECT_FALSE(bake.status().complete);
    writeField(path("early.vlf"), *bake.finished());
    EXPECT_EQ(readField(path("early.vlf")).field.record.seed, wanted.seed);
}

TEST_F(LiveBakeTest, EndsSoonWhateverItIsAt) {
    const std::string file = writeExample("office");
    for (const auto after : {0ms, 30ms, 100ms, 300ms, 700ms}) {
        Clock::time_point begin;
        {
            LiveBake bake({file}, presetParams("high"), quickOptions());
            std::this_thread::sleep_for(after);
            begin = Clock::now();
        }
        const std::chrono::duration<double> took = Clock::now() - begin;
        RecordProperty("after" + std::to_string(after.count()), std::to_string(took.count()));
        EXPECT_LT(took, 2s) << after.count() << " ms";  // 0.1 s on an idle machine
    }
}

TEST_F(LiveBakeTest, AColourChangedOnDiskIsInTheLight) {
    write("room.mtl", kMaterials);
    LiveBake bake({write("room.obj", "mtllib room.mtl\n" + kFloor + kLamp)}, quickParams(),
                  quickOptions());
    const Vec3 white = meanIrradiance(*updatesOf(bake).back().irradiance);
    EXPECT_NEAR(white.r / white.b, 1, 1e-4);
    replace("room.mtl", "Ke 1 1 1", "Ke 1 1 0");
    const std::vector<LiveUpdate> updates = updatesOf(bake);
    const Vec3 yellow = meanIrradiance(*updates.back().irradiance);
    EXPECT_GT(yellow.r, 0.5f * white.r);
    EXPECT_EQ(yellow.b, 0);
    EXPECT_GE(updates.front().stage, LiveStage::settled) << "darker than the room before";
    EXPECT_EQ(updates.front().room->scene.materials[1].emission.b, 0);
}

TEST_F(LiveBakeTest, AFileThatIsBrokenIsReportedAndTheRoomStays) {
    write("room.mtl", kMaterials);
    const std::string good = "mtllib room.mtl\n" + kFloor + kLamp;
    LiveBake bake({write("room.obj", good)}, quickParams(), quickOptions());
    updatesOf(bake);
    const auto room = bake.finished();
    write("room.obj", good + "f 1 2 99\n");
    ASSERT_TRUE(waitForError(bake, "room.obj:14"));
    EXPECT_FALSE(bake.poll());
    EXPECT_EQ(bake.finished(), room);
    EXPECT_TRUE(bake.status().complete);
    write("room.obj", good + "v 5 5 5\n");
    updatesOf(bake);
    EXPECT_EQ(bake.status().error, "");
}

TEST_F(LiveBakeTest, ABrokenFileDoesNotEndTheBakeUnderWay) {
    const std::string file = writeExample("cornell");
    BakeParams wanted = quickParams();
    wanted.directions = 2049;  // half a second
    LiveBake bake({file}, wanted, quickOptions());
    ASSERT_TRUE(waitFor([&] { return bake.finished() != nullptr; }));
    write("cornell.obj", "f 1 2 3\n");
    ASSERT_TRUE(waitForError(bake, "cornell.obj"));
    EXPECT_EQ(updatesOf(bake).back().preset, "draft");
    EXPECT_NE(bake.status().error, "") << "the file is still broken";
}

TEST_F(LiveBakeTest, AFileThatIsRemovedAndMadeAgainIsReadAgain) {
    const std::string text = "mtllib room.mtl\n" + kFloor + kLamp;
    write("room.mtl", kMaterials);
    LiveBake bake({write("room.obj", text)}, quickParams(), quickOptions());
    updatesOf(bake);
    fs::remove(path("room.obj"));
    ASSERT_TRUE(waitForError(bake, "no such file"));
    EXPECT_TRUE(bake.finished());
    write("room.obj", text);
    updatesOf(bake);
    EXPECT_EQ(bake.status().error, "");
}

TEST_F(LiveBakeTest, WaitsForFilesThatAreNotThereYet) {
    LiveBake bake({path("room.obj")}, quickParams(), quickOptions());
    ASSERT_TRUE(waitForError(bake, "no such file"));
    EXPECT_EQ(bake.status().activity, "");
    write("room.obj", "mtllib room.mtl\n" + kFloor + kLamp);
    updatesOf(bake);
    EXPECT_EQ(bake.status().warnings.size(), 4u) << "no library, two materials, no light";
    write("room.mtl", kMaterials);
    updatesOf(bake);
    EXPECT_TRUE(bake.status().warnings.empty());
}

TEST_F(LiveBakeTest, SaysThatASceneHasNoLight) {
    LiveBake bake({write("dark.obj", kFloor)}, quickParams(), quickOptions());
    EXPECT_EQ(meanIrradiance(*updatesOf(bake).back().irradiance), Vec3(0));
    const std::vector<std::string> warnings = bake.status().warnings;
    EXPECT_TRUE(std::ranges::any_of(
        warnings, [](const auto& w) { return w.find("no emitter") != std::string::npos; }));
}

TEST_F(LiveBakeTest, TakesTheEnvironmentForLight) {
    LiveOptions options = quickOptions();
    options.environment.radiance = Vec3(0.5f);
    LiveBake bake({write("floor.obj", kFloor)}, quickParams(), options);
    const IrradianceAtlas light = *updatesOf(bake).back().irradiance;
    EXPECT_NEAR(light.irradiance[light.irradiance.size() / 2].x, 0.5f * kPi, 0.01f);
    for (const std::string& warning : bake.status().warnings)
        EXPECT_EQ(warning.find("no emitter"), std::string::npos) << warning;
}

TEST_F(LiveBakeTest, SaysWhyParametersDoNotSuitTheScene) {
    BakeParams wanted = quickParams();
    wanted.texelSize = 1e-6f;
    LiveBake bake({writeExample("cornell")}, wanted, quickOptions());
    ASSERT_TRUE(waitForError(bake, "choose larger ones"));
    EXPECT_TRUE(bake.finished()) << "the preview";
    EXPECT_FALSE(bake.status().complete);
}

TEST_F(LiveBakeTest, MergesAndWatchesSeveralFiles) {
    write("room.mtl", kMaterials);
    const std::string lamp = "mtllib room.mtl\n" + kLamp;
    LiveBake bake({write("floor.obj", "mtllib room.mtl\n" + kFloor), write("lamp.obj", lamp)},
                  quickParams(), quickOptions());
    updatesOf(bake);
    EXPECT_EQ(bake.finished()->scene.triangles.size(), 4u);
    write("lamp.obj", lamp + "v 0 2 0\nv 1 2 0\nv 0 2 1\nf 5 6 7\n");
    updatesOf(bake);
    EXPECT_EQ(bake.finished()->scene.triangles.size(), 5u);
}

}  // namespace
}  // namespace vlf
