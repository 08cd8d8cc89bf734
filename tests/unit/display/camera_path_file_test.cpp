#include "vlf/display/camera_path_file.h"

#include "vlf/base/error.h"
#include "vlf/math/random.h"

#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace vlf {
namespace {

const std::string kGood = R"({
  "format": "vlf camera path",
  "version": 1,
  "camera": [
    {"seconds": 0, "eye": [0, 1.6, 4], "yaw": 0, "pitch": -5, "verticalFov": 50},
    {"seconds": 2.5, "eye": [1, 1.6, 2], "yaw": 90, "pitch": 0, "verticalFov": 60}
  ]
})";

std::string with(const std::string& from, const std::string& to) {
    std::string text = kGood;
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
}

void expectRefused(const std::string& text, const std::vector<std::string>& says) {
    try {
        parseCameraPath(text, "walk.json");
        ADD_FAILURE() << "accepted: " << text;
    } catch (const InputError& e) {
        const std::string what = e.what();
        EXPECT_TRUE(what.starts_with("walk.json: ")) << what;
        for (const std::string& part : says)
            EXPECT_NE(what.find(part), std::string::npos) << what << "\nlacks " << part;
    }
}

TEST(CameraPathFile, IsReadInDegrees) {
    const CameraPath path = parseCameraPath(kGood, "walk.json");
    ASSERT_EQ(path.samples().size(), 2u);
    const CameraSample& last = path.samples()[1];
    EXPECT_EQ(last.seconds, 2.5);
    EXPECT_EQ(last.pose.eye, Vec3(1, 1.6f, 2));
    EXPECT_FLOAT_EQ(last.pose.yaw, kPi / 2);
    EXPECT_EQ(last.pose.verticalFov, 60);
    EXPECT_FLOAT_EQ(path.samples()[0].pose.pitch, -5 * kPi / 180);
}

TEST(CameraPathFile, GivesBackTheSameBits) {
    RandomStream random(1, 0);
    std::vector<CameraSample> samples;
    for (int i = 0; i < 300; ++i) {
        const float scale = std::exp2(40 * random.next() - 30);
        samples.push_back(
            {i + random.next() * 0.5,
             {scale * Vec3(random.next(), -random.next(), random.next()),
              scale * (random.next() - 0.5f), CameraPose::kMostPitch * (2 * random.next() - 1),
              1 + 178 * random.next()}});
    }
    samples.push_back({1000, {{0, 0, 0}, 0, CameraPose::kMostPitch, 50}});
    const CameraPath path(samples);
    EXPECT_EQ(parseCameraPath(toText({path, {}}, "a"), "a").samples(), samples);

    const auto file = std::filesystem::path(testing::TempDir()) / "camera_path.json";
    writeCameraPath(file.string(), path);
    EXPECT_EQ(readCameraPath(file.string()).samples(), samples);
    std::filesystem::remove(file);
}

TEST(CameraPathFile, AWalkHoldsTheObjectsAndHowTheyMoved) {
    Walk walk{parseCameraPath(kGood, "a"), {}};
    EXPECT_NE(toText(walk, "a").find("\"version\": 1,"), std::string::npos)
        << "readable by older programs";
    ScenarioObject object;
    object.source.file = "models/chair.obj";
    object.object.name = "chair";
    object.motion = KeyframeMotion{
        {{0.5, {{1, 2, 3}}}, {1.5, {{3, 2, 1}}, false}}, Interpolation::linear, false};
    walk.objects.objects = {object};
    const Walk read = parseWalk(toText(walk, "walks/a.json"), "walks/a.json");
    EXPECT_EQ(read.camera.samples(), walk.camera.samples());
    ASSERT_EQ(read.objects.objects.size(), 1u);
    EXPECT_EQ(std::filesystem::absolute(read.objects.objects[0].source.file).lexically_normal(),
              std::filesystem::absolute("models/chair.obj"));
    EXPECT_EQ(read.objects.objects[0].motion, object.motion);
    EXPECT_EQ(parseCameraPath(toText(walk, "a"), "a").samples(), walk.camera.samples());
}

TEST(CameraPathFile, NamesWhatIsWrongAndWhere) {
    expectRefused("", {"parse error"});
    expectRefused("[1, 2", {"parse error"});
    expectRefused("[]", {"is no camera path"});
    expectRefused("{\"cameras\": []}", {"is no camera path", "vlf camera path"});
    expectRefused(with("\"version\": 1,", ""), {"has no \"version\""});
    expectRefused(with("\"version\": 1,", "\"version\": 3,"), {"version: must be 1", "later"});
    expectRefused(with("\"version\": 1,", "\"version\": 2,"), {"has no \"objects\""});
    expectRefused(with("\"version\": 1,", R"("version": 2, "objects": [{"shape": "brick"}],)"),
                  {"objects[0].shape: must be one of"});
    expectRefused(with("\"version\": 1,", "\"version\": \"1\","), {"version: must be 1"});
    expectRefused(with("\"camera\"", "\"kamera\""), {"has no \"camera\""});
    expectRefused(with("\"version\": 1,", "\"version\": 1, \"objects\": [],"), {"\"objects\""});
    expectRefused(with("\"yaw\": 90, ", ""), {"camera[1]: has no \"yaw\""});
    expectRefused(with("\"yaw\": 90", "\"yaw\": 90, \"roll\": 1"), {"camera[1]: has \"roll\""});
    expectRefused(with("\"yaw\": 90", "\"yaw\": \"90\""), {"camera[1].yaw: must be a number"});
    expectRefused(with("\"yaw\": 90", "\"yaw\": NaN"), {"parse error"});
    expectRefused(with("\"yaw\": 90", "\"yaw\": 1e999"), {"number overflow"});
    expectRefused(with("\"yaw\": 90", "\"yaw\": 1e300"), {"camera[1]: yaw"});
    expectRefused(with("[1, 1.6, 2]", "[1, 1.6]"), {"camera[1].eye: must be an array of three"});
    expectRefused(with("[1, 1.6, 2]", "[1, null, 2]"), {"camera[1].eye[1]: must be a number"});
    expectRefused(with("\"seconds\": 2.5", "\"seconds\": 0"), {"camera[1]: times must increase"});
    expectRefused(with("\"pitch\": -5", "\"pitch\": -89"), {"camera[0]: pitch"});
    expectRefused(with("\"verticalFov\": 60", "\"verticalFov\": 0"), {"camera[1]: the field of"});
    EXPECT_THROW(readCameraPath("no/such/file.json"), FileError);
}

/// What a slip of the keyboard or a disk does to a text.
std::string damaged(std::string text, RandomStream& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.next() * n); };
    const std::string pieces[] = {"-", "1e99", "{}", "[", "]", "null", "\"", ",", "\xff", "1e-320"};
    for (std::size_t edits = 1 + below(3); edits > 0 && !text.empty(); --edits) {
        const std::size_t place = below(text.size()), length = below(12);
        switch (below(5)) {
            case 0:
                text[place] = static_cast<char>(below(256));
                break;
            case 1:
                text.erase(place, length);
                break;
            case 2:
                text.insert(place, text.substr(below(text.size()), length));
                break;
            case 3:
                text.insert(place, pieces[below(std::size(pieces))]);
                break;
            default:
                text.resize(place);
                break;
        }
    }
    return text;
}

TEST(CameraPathFile, DamageIsRefusedOrLeavesAPathThatCanBeFollowed) {
    RandomStream random(2, 0);
    int refused = 0, read = 0;
    for (int i = 0; i < 20000; ++i) {
        const std::string text = damaged(kGood, random);
        try {
            const CameraPath path = parseCameraPath(text, "walk.json");
            for (int k = 0; k <= 8; ++k) {
                const CameraPose pose = path.at(path.duration() * k / 8);
                ASSERT_TRUE(isFinite(pose.forward()) && isFinite(pose.eye)) << text;
                ASSERT_TRUE(pose.verticalFov > 0 && pose.verticalFov < 180) << text;
            }
            ++read;
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
    EXPECT_GT(read, 100);
}

TEST(CameraPathFile, DeepNestingIsRefused) {
    expectRefused(std::string(200000, '['), {"parse error"});
    expectRefused(with("[1, 1.6, 2]", std::string(50000, '[') + std::string(50000, ']')),
                  {"camera[1].eye"});
}

}  // namespace
}  // namespace vlf
