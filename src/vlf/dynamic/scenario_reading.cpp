#include "vlf/dynamic/object_names.h"
#include "vlf/dynamic/scenario_json.h"
#include "vlf/scene/generate/primitives.h"

#include <algorithm>
#include <filesystem>

namespace vlf {

namespace {

constexpr double kFarthest = 1e6;  // metres
constexpr double kLeastScale = 1e-6, kMostScale = 1e6;
constexpr double kMostEmission = 1e9;  // W·m⁻²·sr⁻¹
constexpr double kDay = 86400;         // seconds
constexpr double kFastest = 36000;     // degrees a second

std::string listOf(const std::vector<std::string>& names) {
    return fmt::format("\"{}\"", fmt::join(names, "\", \""));
}

template <typename Names>
auto readName(const JsonElement& element, const Names& names) {
    const std::string name = element.text();
    std::vector<std::string> known;
    for (const auto& named : names) {
        if (name == named.name) return named.value;
        known.push_back(named.name);
    }
    element.fail(fmt::format("must be one of {}", listOf(known)));
}

/// Changes `value` if the object states it.
template <typename Value, typename Read>
void readIfThere(const JsonElement& object, const char* name, Value& value, Read read) {
    if (object.has(name)) value = static_cast<Value>(read(object.member(name)));
}

auto numberIn(double least, double most) {
    return [=](const JsonElement& e) { return e.number(least, most); };
}
auto wholeIn(int least, int most) {
    return [=](const JsonElement& e) { return e.whole(least, most); };
}
bool readFlag(const JsonElement& e) {
    return e.flag();
}
Vec3 readPlace(const JsonElement& e) {
    return e.point(-kFarthest, kFarthest);
}

Vec3 readAxis(const JsonElement& element) {
    const Vec3 axis = element.point(-kFarthest, kFarthest);
    const float length = glm::length(axis);
    if (!(length > 1e-6f)) element.fail("must not be zero");
    return axis / length;
}

Quat readRotation(const JsonElement& element) {
    element.requireMembers({"axis", "degrees"});
    const double degrees = element.member("degrees").number(-kFastest, kFastest);
    return glm::angleAxis(static_cast<float>(degrees * std::numbers::pi / 180),
                          readAxis(element.member("axis")));
}

/// What is not stated stays.
Pose readPose(const JsonElement& object, Pose pose) {
    readIfThere(object, "position", pose.translation, readPlace);
    readIfThere(object, "rotation", pose.rotation, readRotation);
    readIfThere(object, "scale", pose.scale, numberIn(kLeastScale, kMostScale));
    return pose;
}

std::optional<Vec3> readColour(const JsonElement& material, const char* name, double most) {
    if (!material.has(name)) return {};
    return material.member(name).point(0, most);
}

void readMaterial(const JsonElement& material, ObjectSource& source) {
    material.requireMembers({}, {"diffuse", "mirror", "emission"});
    source.diffuse = readColour(material, "diffuse", 1);
    source.mirror = readColour(material, "mirror", 1);
    source.emission = readColour(material, "emission", kMostEmission);
    if (source.diffuse && source.mirror &&
        maxComponent(*source.diffuse + *source.mirror) > 1 + 1e-5f)
        material.fail(
            "reflects more light than it gets: diffuse and mirror must add up to 1 at "
            "most");
}

ObjectSource readSource(const JsonElement& object, const std::string& folder) {
    if (object.has("shape") == object.has("file"))
        object.fail("needs either \"shape\" or \"file\"");
    ObjectSource source;
    if (object.has("shape")) {
        source.primitive = object.member("shape").text();
        const std::vector<std::string>& known = primitiveNames();
        if (std::find(known.begin(), known.end(), source.primitive) == known.end())
            object.member("shape").fail(
                fmt::format("must be one of {}; scene files are named by \"file\"", listOf(known)));
    } else {
        const std::string file = object.member("file").text();
        if (file.empty()) object.member("file").fail("must name a scene file");
        source.file = (std::filesystem::path(folder) / file).lexically_normal().string();
    }
    if (object.has("material")) readMaterial(object.member("material"), source);
    return source;
}

void readGather(const JsonElement& element, GatherSettings& gather) {
    element.requireMembers(
        {}, {"points", "subdivision", "texelSize", "lines", "step", "importanceSamples",
             "emittersByDirections", "cache", "onlyVisible"});
    readIfThere(element, "points", gather.points,
                [](const JsonElement& e) { return readName(e, kGatherPointNames); });
    readIfThere(element, "subdivision", gather.subdivision,
                wholeIn(0, ObjectModel::kMaxSubdivision));
    readIfThere(element, "texelSize", gather.texelSize, numberIn(0, kFarthest));
    readIfThere(element, "lines", gather.lines, [](const JsonElement& e) {
        const int lines = e.whole(3, 1 << 17 | 1);
        for (int n = 3; n <= lines; n = 4 * (n - 1) + 1)
            if (n == lines) return lines;
        e.fail("must be 3, 9, 33, 129, 513, 2049 and so on: 2·4ⁿ + 1");
    });
    readIfThere(element, "step", gather.step, wholeIn(1, 1000));
    readIfThere(element, "importanceSamples", gather.importanceSamples, wholeIn(0, 1 << 17));
    readIfThere(element, "emittersByDirections", gather.emittersByDirections, readFlag);
    readIfThere(element, "cache", gather.cache, readFlag);
    readIfThere(element, "onlyVisible", gather.onlyVisible, readFlag);
}

void readPrt(const JsonElement& element, PrtSettings& prt) {
    element.requireMembers({}, {"order", "reflections"});
    readIfThere(element, "order", prt.order, wholeIn(1, 5));
    readIfThere(element, "reflections", prt.reflections, readFlag);
}

void readHard(const JsonElement& element, HardShadowSettings& hard) {
    element.requireMembers({}, {"mapSize", "opacity"});
    readIfThere(element, "mapSize", hard.mapSize, wholeIn(16, 8192));
    readIfThere(element, "opacity", hard.opacity, numberIn(0, 1));
}

ObjectSettings readSettings(const JsonElement& object, ObjectSettings settings) {
    readIfThere(object, "shading", settings.shading,
                [](const JsonElement& e) { return readName(e, kShadingNames); });
    readIfThere(object, "shadow", settings.shadow,
                [](const JsonElement& e) { return readName(e, kShadowNames); });
    readIfThere(object, "directSamples", settings.directSamples, wholeIn(1, 1024));
    if (object.has("gather")) readGather(object.member("gather"), settings.gather);
    if (object.has("prt")) readPrt(object.member("prt"), settings.prt);
    if (object.has("hard")) readHard(object.member("hard"), settings.hard);
    return settings;
}

Interpolation readInterpolation(const JsonElement& element) {
    const std::string name = element.text();
    if (name != "linear" && name != "smooth") element.fail("must be \"linear\" or \"smooth\"");
    return name == "linear" ? Interpolation::linear : Interpolation::smooth;
}

KeyframeMotion readKeyframes(const JsonElement& motion, const DynamicObject& object) {
    motion.requireMembers({"keyframes"}, {"interpolation", "loop"});
    KeyframeMotion keyframes;
    readIfThere(motion, "interpolation", keyframes.interpolation, readInterpolation);
    readIfThere(motion, "loop", keyframes.loop, readFlag);
    const JsonElement list = motion.member("keyframes");
    if (list.size("keyframes") == 0) list.fail("must hold one keyframe at least");
    for (std::size_t i = 0; i < list.value.size(); ++i) {
        const JsonElement item = list.item(i);
        item.requireMembers({"seconds"}, {"position", "rotation", "scale", "visible"});
        Keyframe keyframe{0, readPose(item, object.pose), object.visible};
        keyframe.seconds = item.member("seconds").number(0, kDay);
        readIfThere(item, "visible", keyframe.visible, readFlag);
        if (i > 0 && keyframe.seconds <= keyframes.keyframes.back().seconds)
            item.member("seconds").fail("times must increase from keyframe to keyframe");
        keyframes.keyframes.push_back(keyframe);
    }
    return keyframes;
}

TurnMotion readTurn(const JsonElement& element) {
    element.requireMembers({"degreesPerSecond"}, {"axis"});
    TurnMotion turn;
    readIfThere(element, "axis", turn.axis, readAxis);
    readIfThere(element, "degreesPerSecond", turn.degreesPerSecond, numberIn(-kFastest, kFastest));
    return turn;
}

CircleMotion readCircle(const JsonElement& element) {
    element.requireMembers({"centre", "degreesPerSecond"}, {"axis", "turns"});
    CircleMotion circle;
    readIfThere(element, "centre", circle.centre, readPlace);
    readIfThere(element, "axis", circle.axis, readAxis);
    readIfThere(element, "degreesPerSecond", circle.degreesPerSecond,
                numberIn(-kFastest, kFastest));
    readIfThere(element, "turns", circle.turns, readFlag);
    return circle;
}

Motion readMotion(const JsonElement& motion, const DynamicObject& object) {
    const auto holds = [&](const char* name) {
        return motion.value.is_object() && motion.has(name);
    };
    if (holds("keyframes")) return readKeyframes(motion, object);
    motion.requireMembers({}, {"turn", "circle"});
    if (motion.value.size() != 1)
        motion.fail("must hold one of \"keyframes\", \"turn\" and \"circle\"");
    if (motion.has("turn")) return readTurn(motion.member("turn"));
    return readCircle(motion.member("circle"));
}

ScenarioObject readObject(const JsonElement& element, const std::string& folder,
                          const ObjectSettings& defaults) {
    element.requireMembers(
        {}, {"name", "shape", "file", "material", "position", "rotation", "scale", "visible",
             "shading", "shadow", "directSamples", "gather", "prt", "hard", "motion"});
    ScenarioObject read;
    read.source = readSource(element, folder);
    DynamicObject& object = read.object;
    object.name = read.source.primitive.empty()
                      ? std::filesystem::path(read.source.file).stem().string()
                      : read.source.primitive;
    readIfThere(element, "name", object.name, [](const JsonElement& e) { return e.text(); });
    readIfThere(element, "visible", object.visible, readFlag);
    object.pose = readPose(element, {});
    object.settings = readSettings(element, defaults);
    if (element.has("motion")) read.motion = readMotion(element.member("motion"), object);
    return read;
}

}  // namespace

Scenario readObjects(const JsonElement& array, const std::string& folder,
                     const ObjectSettings& defaults) {
    Scenario scenario;
    for (std::size_t i = 0; i < array.size("objects"); ++i)
        scenario.objects.push_back(readObject(array.item(i), folder, defaults));
    return scenario;
}

void loadModels(const JsonElement& array, Scenario& scenario, ModelLibrary& library,
                std::vector<std::string>& warnings) {
    for (std::size_t i = 0; i < scenario.objects.size(); ++i) {
        ScenarioObject& object = scenario.objects[i];
        try {
            object.object.model = library.model(object.source, warnings);
        } catch (const Error& e) {
            const JsonElement element = array.item(i);
            element.member(element.has("file") ? "file" : "shape").fail(e.what());
        }
    }
}

}  // namespace vlf
