#include "vlf/dynamic/object_names.h"
#include "vlf/dynamic/scenario_json.h"

#include <charconv>
#include <filesystem>

namespace vlf {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t kLineLength = 100;
constexpr float kStill = 1e-6f;  // what a rotation may differ from none

/// The number with no more digits than the float has.
double decimal(float value) {
    const std::string text = fmt::format("{}", value);
    double number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

ordered_json numbers(const Vec3& v) {
    return {decimal(v.x), decimal(v.y), decimal(v.z)};
}

ordered_json rotationToJson(const Quat& rotation) {
    const Quat q = rotation.w < 0 ? -rotation : rotation;
    const Vec3 part(q.x, q.y, q.z);
    const float sine = glm::length(part);
    const double degrees = 2 * std::atan2(static_cast<double>(sine), static_cast<double>(q.w)) *
                           180 / std::numbers::pi;
    return {{"axis", numbers(sine > 0 ? part / sine : Vec3(0, 1, 0))},
            {"degrees", decimal(static_cast<float>(degrees))}};
}

void addPose(ordered_json& json, const Pose& pose) {
    json["position"] = numbers(pose.translation);
    if (glm::length(Vec3(pose.rotation.x, pose.rotation.y, pose.rotation.z)) > kStill)
        json["rotation"] = rotationToJson(pose.rotation);
    json["scale"] = decimal(pose.scale);
}

/// As addPose, but leaves nothing out: keyframes take what they do not state from their object.
void addWholePose(ordered_json& json, const Pose& pose) {
    json["position"] = numbers(pose.translation);
    json["rotation"] = rotationToJson(pose.rotation);
    json["scale"] = decimal(pose.scale);
}

ordered_json toJson(const GatherSettings& gather) {
    return {{"points", nameAmong(kGatherPointNames, gather.points)},
            {"subdivision", gather.subdivision},
            {"texelSize", decimal(gather.texelSize)},
            {"lines", gather.lines},
            {"step", gather.step},
            {"importanceSamples", gather.importanceSamples},
            {"emittersByDirections", gather.emittersByDirections},
            {"cache", gather.cache},
            {"onlyVisible", gather.onlyVisible}};
}

void addSettings(ordered_json& json, const ObjectSettings& settings) {
    json["shading"] = nameAmong(kShadingNames, settings.shading);
    json["shadow"] = nameAmong(kShadowNames, settings.shadow);
    json["directSamples"] = settings.directSamples;
    json["gather"] = toJson(settings.gather);
    json["prt"] = {{"order", settings.prt.order}, {"reflections", settings.prt.reflections}};
    json["hard"] = {{"mapSize", settings.hard.mapSize},
                    {"opacity", decimal(settings.hard.opacity)}};
}

ordered_json toJson(const KeyframeMotion& motion) {
    ordered_json list = ordered_json::array();
    for (const Keyframe& keyframe : motion.keyframes) {
        ordered_json item{{"seconds", keyframe.seconds}};
        addWholePose(item, keyframe.pose);
        item["visible"] = keyframe.visible;
        list.push_back(item);
    }
    return {{"interpolation", motion.interpolation == Interpolation::linear ? "linear" : "smooth"},
            {"loop", motion.loop},
            {"keyframes", list}};
}

ordered_json toJson(const TurnMotion& turn) {
    return {{"turn",
             {{"axis", numbers(turn.axis)}, {"degreesPerSecond", decimal(turn.degreesPerSecond)}}}};
}

ordered_json toJson(const CircleMotion& circle) {
    return {{"circle",
             {{"centre", numbers(circle.centre)},
              {"axis", numbers(circle.axis)},
              {"degreesPerSecond", decimal(circle.degreesPerSecond)},
              {"turns", circle.turns}}}};
}

ordered_json toJson(std::monostate) {
    return {};
}

void addSource(ordered_json& json, const ObjectSource& source, const std::string& folder) {
    namespace fs = std::filesystem;
    if (source.primitive.empty())
        json["file"] = fs::absolute(source.file)
                           .lexically_proximate(fs::absolute(folder.empty() ? "." : folder))
                           .generic_string();
    else
        json["shape"] = source.primitive;
    ordered_json material = ordered_json::object();
    if (source.diffuse) material["diffuse"] = numbers(*source.diffuse);
    if (source.mirror) material["mirror"] = numbers(*source.mirror);
    if (source.emission) material["emission"] = numbers(*source.emission);
    if (!material.empty()) json["material"] = material;
}

ordered_json toJson(const ScenarioObject& object, const std::string& folder) {
    ordered_json json{{"name", object.object.name}};
    addSource(json, object.source, folder);
    addPose(json, object.object.pose);
    json["visible"] = object.object.visible;
    addSettings(json, object.object.settings);
    if (moves(object.motion))
        json["motion"] =
            std::visit([](const auto& motion) { return toJson(motion); }, object.motion);
    return json;
}

std::string inBrackets(const ordered_json& json, const std::string& text) {
    return json.is_object() ? fmt::format("{{{}}}", text) : fmt::format("[{}]", text);
}

std::string quoted(const std::string& text) {
    return ordered_json(text).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// The elements, each as `textOfValue` has it.
template <typename TextOf>
std::vector<std::string> elements(const ordered_json& json, TextOf textOfValue) {
    std::vector<std::string> all;
    for (const auto& [key, value] : json.items())
        all.push_back(json.is_object() ? fmt::format("{}: {}", quoted(key), textOfValue(value))
                                       : textOfValue(value));
    return all;
}

/// In one line.
std::string inlineText(const ordered_json& json) {
    if (json.is_string()) return quoted(json.get<std::string>());
    if (!json.is_structured()) return json.dump();
    return inBrackets(json, fmt::format("{}", fmt::join(elements(json, inlineText), ", ")));
}

/// What fits into a line is in one.
std::string textOf(const ordered_json& json, std::size_t indent) {
    std::string line = inlineText(json);
    if (!json.is_structured() || indent + line.size() <= kLineLength) return line;
    const auto deeper = [&](const ordered_json& value) { return textOf(value, indent + 2); };
    const std::string newLine = fmt::format("\n{:{}}", "", indent);
    const std::string separator = fmt::format(",{}  ", newLine);
    return inBrackets(json, fmt::format("{}  {}{}", newLine,
                                        fmt::join(elements(json, deeper), separator), newLine));
}

}  // namespace

std::string objectsToText(const Scenario& scenario, const std::string& folder) {
    ordered_json array = ordered_json::array();
    for (const ScenarioObject& object : scenario.objects) array.push_back(toJson(object, folder));
    return textOf(array, 2);
}

}  // namespace vlf
