#include "vlf/display/camera_path_file.h"

#include "vlf/base/file.h"
#include "vlf/base/json_element.h"

#include <charconv>
#include <numbers>

namespace vlf {

namespace {

using nlohmann::json;

constexpr const char* kFormat = "vlf camera path";
constexpr int kVersion = 1;
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
    if (!version.is_number_integer() || version != kVersion)
        root.member("version").fail(
            fmt::format("must be {}; a file of a later version needs a later program", kVersion));
    root.requireMembers({"format", "version", "camera"});
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

CameraPath parseCameraPath(std::string_view text, const std::string& nameForErrors) {
    const json root = parseJson(text, nameForErrors);
    const JsonElement file{root, {nameForErrors, 0, ""}};
    requireFormat(file);
    const JsonElement camera = file.member("camera");
    std::vector<CameraSample> samples;
    for (std::size_t i = 0; i < camera.size("samples"); ++i)
        samples.push_back(readSample(camera.item(i)));
    return CameraPath(std::move(samples), nameForErrors);
}

std::string toText(const CameraPath& path) {
    std::string text = fmt::format("{{\n  \"format\": \"{}\",\n  \"version\": {},\n  \"camera\": [",
                                   kFormat, kVersion);
    const char* separator = "\n";
    for (const auto& [seconds, pose] : path.samples()) {
        text += fmt::format(
            "{}    {{\"seconds\": {}, \"eye\": [{}, {}, {}], \"yaw\": {}, \"pitch\": {}, "
            "\"verticalFov\": {}}}",
            separator, seconds, pose.eye.x, pose.eye.y, pose.eye.z, degrees(pose.yaw),
            degrees(pose.pitch), pose.verticalFov);
        separator = ",\n";
    }
    return text + "\n  ]\n}\n";
}

CameraPath readCameraPath(const std::string& file) {
    const std::vector<std::uint8_t> bytes = readFile(file);
    return parseCameraPath({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file);
}

void writeCameraPath(const std::string& file, const CameraPath& path) {
    const std::string text = toText(path);
    writeFile(file, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace vlf
