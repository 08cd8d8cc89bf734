#include "vlf/dynamic/scenario_file.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"
#include "vlf/math/random.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

namespace vlf {
namespace {

namespace fs = std::filesystem;

const std::string kGood = R"({
  "format": "vlf scenario",
  "version": 1,
  "objects": [
    {"shape": "cube", "position": [1, 0.05, 2], "scale": 0.1},
    {"name": "lamp", "shape": "sphere",
     "material": {"diffuse": [0.5, 0.4, 0.3], "mirror": [0.1, 0.1, 0.1], "emission": [9, 9, 9]},
     "position": [1, 2, 3], "rotation": {"axis": [0, 2, 0], "degrees": 90}, "scale": 0.5,
     "visible": false, "shading": "prt", "shadow": "hard", "directSamples": 4,
     "gather": {"points": "vertices", "subdivision": 2, "texelSize": 0.02, "lines": 129, "step": 2,
                "importanceSamples": 64, "emittersByDirections": true, "cache": true,
                "onlyVisible": false},
     "prt": {"order": 3, "reflections": false}, "hard": {"mapSize": 256, "opacity": 0.25},
     "motion": {"circle": {"centre": [0, 1, 0], "degreesPerSecond": 30, "turns": false}}},
    {"file": "models/chair.obj",
     "motion": {"interpolation": "linear", "loop": true, "keyframes": [
       {"seconds": 0, "position": [0, 0, 0]},
       {"seconds": 2.5, "rotation": {"axis": [1, 0, 0], "degrees": -45}, "scale": 2, "visible": false}]}}
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
        parseScenario(text, "room.json");
        ADD_FAILURE() << "accepted: " << text;
    } catch (const InputError& e) {
        const std::string what = e.what();
        EXPECT_TRUE(what.starts_with("room.json: ")) << what;
        for (const std::string& part : says)
            EXPECT_NE(what.find(part), std::string::npos) << what << "\nlacks " << part;
    }
}

TEST(Scenario, IsReadWithWhatItStatesAndDefaultsElse) {
    ObjectSettings defaults;
    defaults.shading = Shading::lights;
    defaults.hard.mapSize = 1024;
    const Scenario scenario = parseScenario(kGood, "folder/room.json", defaults);
    ASSERT_EQ(scenario.objects.size(), 3u);

    const ScenarioObject& cube = scenario.objects[0];
    EXPECT_EQ(cube.object.name, "cube");
    EXPECT_EQ(cube.source.primitive, "cube");
    EXPECT_EQ(cube.object.pose, (Pose{{1, 0.05f, 2}, {1, 0, 0, 0}, 0.1f}));
    EXPECT_EQ(cube.object.settings, defaults);
    EXPECT_FALSE(moves(cube.motion));

    const ScenarioObject& lamp = scenario.objects[1];
    EXPECT_EQ(lamp.object.name, "lamp");
    EXPECT_EQ(lamp.source.emission, Vec3(9));
    EXPECT_FALSE(lamp.object.visible);
    EXPECT_NEAR(glm::length(lamp.object.pose.direction({0, 0, 1}) - Vec3(1, 0, 0)), 0, 1e-6);
    EXPECT_EQ(lamp.object.settings.shadow, ShadowKind::hard);
    EXPECT_EQ(lamp.object.settings.gather.lines, 129);
    EXPECT_FALSE(lamp.object.settings.prt.reflections);
    const auto& circle = std::get<CircleMotion>(lamp.motion);
    EXPECT_EQ(circle.centre, Vec3(0, 1, 0));
    EXPECT_EQ(circle.axis, Vec3(0, 1, 0));
    EXPECT_FALSE(circle.turns);

    const ScenarioObject& chair = scenario.objects[2];
    EXPECT_EQ(chair.object.name, "chair");
    EXPECT_EQ(chair.source.file, "folder/models/chair.obj");
    const auto& keyframes = std::get<KeyframeMotion>(chair.motion);
    EXPECT_TRUE(keyframes.loop);
    EXPECT_EQ(keyframes.interpolation, Interpolation::linear);
    ASSERT_EQ(keyframes.keyframes.size(), 2u);
    EXPECT_EQ(keyframes.keyframes[1].seconds, 2.5);
    EXPECT_EQ(keyframes.keyframes[1].pose.scale, 2);
    EXPECT_FALSE(keyframes.keyframes[1].visible);
}

void expectSame(const Pose& a, const Pose& b) {
    EXPECT_EQ(a.translation, b.translation);
    EXPECT_EQ(a.scale, b.scale);
    EXPECT_GT(std::abs(glm::dot(a.rotation, b.rotation)), 1 - 1e-6f);
}

TEST(Scenario, IsReadAgainAsItWasWritten) {
    Scenario scenario = parseScenario(kGood, "folder/room.json");
    RandomStream random(3, 0);
    KeyframeMotion motion;
    for (int i = 0; i < 200; ++i) {
        const Quat rotation(random.next() - 0.5f, random.next() - 0.5f, random.next() - 0.5f,
                            random.next() - 0.5f);
        motion.keyframes.push_back({i + random.next() * 0.5,
                                    {{random.next(), -random.next(), 1000 * random.next()},
                                     glm::normalize(rotation),
                                     std::exp2(20 * random.next() - 10)},
                                    random.next() < 0.5f});
    }
    scenario.objects[0].motion = motion;
    const Scenario read = parseScenario(toText(scenario, "other/place.json"), "other/place.json");
    ASSERT_EQ(read.objects.size(), scenario.objects.size());
    for (std::size_t i = 0; i < read.objects.size(); ++i) {
        const ScenarioObject &a = scenario.objects[i], &b = read.objects[i];
        EXPECT_EQ(a.object.name, b.object.name);
        EXPECT_EQ(a.source.primitive, b.source.primitive);
        EXPECT_EQ(a.source.diffuse, b.source.diffuse);
        EXPECT_EQ(a.object.settings, b.object.settings);
        EXPECT_EQ(a.object.visible, b.object.visible);
        expectSame(a.object.pose, b.object.pose);
        EXPECT_EQ(a.motion.index(), b.motion.index());
    }
    EXPECT_EQ(fs::absolute(read.objects[2].source.file).lexically_normal(),
              fs::absolute("folder/models/chair.obj"));
    const auto& keyframes = std::get<KeyframeMotion>(read.objects[0].motion).keyframes;
    ASSERT_EQ(keyframes.size(), motion.keyframes.size());
    for (std::size_t i = 0; i < keyframes.size(); ++i) {
        EXPECT_EQ(keyframes[i].seconds, motion.keyframes[i].seconds);
        EXPECT_EQ(keyframes[i].visible, motion.keyframes[i].visible);
        expectSame(keyframes[i].pose, motion.keyframes[i].pose);
    }
}

TEST(Scenario, NamesWhatIsWrongAndWhere) {
    expectRefused("", {"parse error"});
    expectRefused("[]", {"is no scenario", "vlf scenario"});
    expectRefused(with("\"version\": 1,", ""), {"has no \"version\""});
    expectRefused(with("\"version\": 1", "\"version\": 2"), {"version: must be 1", "later"});
    expectRefused(with("\"objects\": [", "\"things\": ["), {"has no \"objects\""});
    expectRefused(R"({"format": "vlf scenario", "version": 1, "objects": {}})",
                  {"objects: must be an array"});
    expectRefused(with("\"shape\": \"cube\", ", ""), {"objects[0]: needs either", "\"file\""});
    expectRefused(with("\"cube\"", "\"brick\""), {"objects[0].shape: must be one of", "sphere"});
    expectRefused(with("\"cube\"", "\"cube\", \"color\": 1"), {"objects[0]: has \"color\""});
    expectRefused(with("[1, 0.05, 2]", "[1, 0.05]"), {"objects[0].position: must be an array"});
    expectRefused(with("[1, 0.05, 2]", "[1, null, 2]"), {"objects[0].position[1]: must be a num"});
    expectRefused(with("[1, 0.05, 2]", "[1, 1e30, 2]"), {"objects[0].position[1]: must be a num"});
    expectRefused(with("[1, 0.05, 2]", "[1, NaN, 2]"), {"parse error"});
    expectRefused(with("\"scale\": 0.1", "\"scale\": 0"), {"objects[0].scale: must be"});
    expectRefused(with("[0, 2, 0]", "[0, 0, 0]"), {"objects[1].rotation.axis: must not be zero"});
    expectRefused(with("\"degrees\": 90", "\"radians\": 1"), {"objects[1].rotation: has no"});
    expectRefused(with("[0.5, 0.4, 0.3]", "[0.5, 1.4, 0.3]"),
                  {"objects[1].material.diffuse[1]: must be a number from 0 to 1"});
    expectRefused(with("[0.1, 0.1, 0.1]", "[0.1, 0.7, 0.1]"), {"objects[1].material", "add up"});
    expectRefused(with("false,", "\"no\","), {"objects[1].visible: must be true or false"});
    expectRefused(with("\"prt\", \"shadow\"", "\"pretty\", \"shadow\""),
                  {"objects[1].shading: must be one of \"flat\", \"lights\", \"gather\", \"prt\""});
    expectRefused(with("\"lines\": 129", "\"lines\": 130"), {"objects[1].gather.lines", "513"});
    expectRefused(with("\"order\": 3", "\"order\": 2.5"),
                  {"objects[1].prt.order: must be a whole"});
    expectRefused(with("\"opacity\": 0.25", "\"opacity\": 2"), {"objects[1].hard.opacity"});
    expectRefused(with("\"circle\"", "\"spiral\""), {"objects[1].motion: has \"spiral\""});
    expectRefused(with("\"motion\": {\"circle\": {", "\"motion\": {\"turn\": {}, \"circle\": {"),
                  {"objects[1].motion: must hold one of"});
    expectRefused(with("\"models/chair.obj\"", "\"\""), {"objects[2].file: must name"});
    expectRefused(with("\"seconds\": 2.5", "\"seconds\": 0"),
                  {"objects[2].motion.keyframes[1].seconds: times must increase"});
    expectRefused(with("\"seconds\": 2.5", "\"seconds\": -1"),
                  {"objects[2].motion.keyframes[1].seconds: must be a number from 0"});
    expectRefused(with("\"linear\"", "\"cubic\""), {"objects[2].motion.interpolation: must be"});
    expectRefused(std::string(200000, '['), {"parse error"});
}

TEST(Scenario, AFileThatCannotBeUsedIsNamedWithItsElement) {
    const fs::path folder = fs::path(testing::TempDir()) / "scenario_test";
    fs::create_directories(folder);
    const std::string file = (folder / "room.json").string();
    std::ofstream(file) << kGood;
    ModelLibrary library;
    std::vector<std::string> warnings;
    try {
        readScenario(file, {}, library, warnings);
        ADD_FAILURE();
    } catch (const InputError& e) {
        const std::string what = e.what();
        EXPECT_TRUE(what.starts_with(file + ": objects[2].file: ")) << what;
        EXPECT_NE(what.find("chair.obj"), std::string::npos) << what;
    }
    EXPECT_THROW(readScenario((folder / "none.json").string(), {}, library, warnings), FileError);
    fs::remove_all(folder);
}

TEST(Scenario, ObjectsOfOneSourceShareAModel) {
    ModelLibrary library;
    std::vector<std::string> warnings;
    ObjectSource red{"cube", "", Vec3(0.6f, 0.1f, 0.1f), {}, {}};
    const auto first = library.model(red, warnings);
    EXPECT_EQ(first, library.model(red, warnings));
    EXPECT_EQ(first->scene().materials[0].diffuse, Vec3(0.6f, 0.1f, 0.1f));
    red.mirror = Vec3(0.9f);
    const auto glossy = library.model(red, warnings);
    EXPECT_NE(first, glossy);
    const Material& material = glossy->scene().materials[0];
    EXPECT_LE(maxComponent(material.diffuse + material.mirror), 1 + 1e-6f);
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
                if (below(8) == 0) text.resize(place);
                break;
        }
    }
    return text;
}

TEST(Scenario, DamageIsRefusedOrLeavesObjectsThatCanBeMoved) {
    RandomStream random(2, 0);
    int refused = 0, read = 0;
    for (int i = 0; i < 6000; ++i) {
        const std::string text = damaged(kGood, random);
        try {
            const Scenario scenario = parseScenario(text, "room.json");
            for (const DynamicObject& object : objectsAt(scenario, 7.5 * random.next()))
                ASSERT_TRUE(isValid(object.pose)) << text;
            for (const ScenarioObject& object : scenario.objects) requireValid(object.motion);
            parseScenario(toText(scenario, "room.json"), "room.json");
            ++read;
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
    EXPECT_GT(read, 100);
}

}  // namespace
}  // namespace vlf
