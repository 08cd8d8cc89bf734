#include "vlf/display/camera_path_file.h"

#include "vlf/base/file.h"
#include "vlf/dynamic/scenario_json.h"
#include "vlf/scene/import/json_element.h"

#include <charconv>
#include <filesystem>
#include <numbers>

namespace vlf {

namespace {

using nlohmann::json;

constexpr const char* kFormat = "vlf camera path";
constexpr int kVersion = 1, kVersionWithObjects = 2;
constexpr double kDegree = std::numbers::pi / 180;

CameraSample readSample(const JsonElement& element) {
    element.requireMembers({"seconds", "eye", "yaw", "pitch", "verticalFov"});
    CameraSample sample;
    sample.seconds = element.member("seconds").number();
    sample.pose.eye = element.member("eye").point();
    sample.pose.yaw = static_cast<float>(kDegree * element.member("yaw").number());
    sample.pose.pitch = static_cast<float>(kDegree * element.member("pitch").number());
    sample.pose.verticalFov = static_cast<float>(element.member("verticalFov").number());
    return sample;
}

void requireFormat(const JsonElement& root) {
    if (!root.value.is_object() || !root.value.contains("format") ||
        root.value["format"] != kFormat)
        root.fail(fmt::format("is no camera path: it must hold an object with \"format\": \"{}\"",
                              kFormat));
    if (!root.value.contains("version")) root.fail("has no \"version\"");
    const json& version = root.value["version"];
    if (!version.is_number_integer() || (version != kVersion && version != kVersionWithObjects))
        root.member("version").fail(
            fmt::format("must be {} or {}; a file of a later version needs a later program",
                        kVersion, kVersionWithObjects));
    if (version == kVersion)
        root.requireMembers({"format", "version", "camera"});
    else
        root.requireMembers({"format", "version", "camera", "objects"});
}

CameraPath readCamera(const JsonElement& camera) {
    std::vector<CameraSample> samples;
    for (std::size_t i = 0; i < camera.size("samples"); ++i)
        samples.push_back(readSample(camera.item(i)));
    return CameraPath(std::move(samples), camera.where.file);
}

std::string folderOf(const std::string& file) {
    return std::filesystem::path(file).parent_path().string();
}

/// With models, if there is a library.
Walk readFrom(std::string_view text, const std::string& name, ModelLibrary* library,
              std::vector<std::string>* warnings) {
    const json root = parseJson(text, name);
    const JsonElement file{root, {name, 0, ""}};
    requireFormat(file);
    Walk walk{readCamera(file.member("camera")), {}};
    if (!file.has("objects")) return walk;
    const JsonElement objects = file.member("objects");
    walk.objects = readObjects(objects, folderOf(name), {});
    if (library) loadModels(objects, walk.objects, *library, *warnings);
    return walk;
}

std::string contentOf(const std::string& file) {
    const std::vector<std::uint8_t> bytes = readFile(file);
    return {bytes.begin(), bytes.end()};
}

/// The shortest decimal number of degrees that is read back as this angle in radians.
std::string degrees(float radians) {
    for (int digits = 6;; ++digits) {
        const std::string text = fmt::format("{:.{}g}", radians / kDegree, digits);
        double read = 0;
        std::from_chars(text.data(), text.data() + text.size(), read);
        if (digits == 17 || static_cast<float>(kDegree * read) == radians) return text;
    }
}

}  // namespace

Walk parseWalk(std::string_view text, const std::string& name) {
    return readFrom(text, name, nullptr, nullptr);
}

CameraPath parseCameraPath(std::string_view text, const std::string& name) {
    return parseWalk(text, name).camera;
}

std::string toText(const Walk& walk, const std::string& name) {
    const bool hasObjects = !walk.objects.objects.empty();
    std::string text = fmt::format("{{\n  \"format\": \"{}\",\n  \"version\": {},\n  \"camera\": [",
                                   kFormat, hasObjects ? kVersionWithObjects : kVersion);
    const char* separator = "\n";
    for (const auto& [seconds, pose] : walk.camera.samples()) {
        text += fmt::format(
            "{}    {{\"seconds\": {}, \"eye\": [{}, {}, {}], \"yaw\": {}, \"pitch\": {}, "
            "\"verticalFov\": {}}}",
            separator, seconds, pose.eye.x, pose.eye.y, pose.eye.z, degrees(pose.yaw),
            degrees(pose.pitch), pose.verticalFov);
        separator = ",\n";
    }
    text += "\n  ]";
    if (hasObjects) text += ",\n  \"objects\": " + objectsToText(walk.objects, folderOf(name));
    return text + "\n}\n";
}

Walk readWalk(const std::string& file, ModelLibrary& library, std::vector<std::string>& warnings) {
    return readFrom(contentOf(file), file, &library, &warnings);
}

CameraPath readCameraPath(const std::string& file) {
    return parseCameraPath(contentOf(file), file);
}

void writeWalk(const std::string& file, const Walk& walk) {
    const std::string text = toText(walk, file);
    writeFile(file, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

void writeCameraPath(const std::string& file, const CameraPath& path) {
    writeWalk(file, {path, {}});
}

}  // namespace vlf
