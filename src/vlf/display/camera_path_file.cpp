#include "vlf/display/camera_path_file.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vlf {

namespace {

using nlohmann::json;

constexpr const char* kFormat = "vlf camera path";
constexpr int kVersion = 1;
constexpr double kDegree = std::numbers::pi / 180;

/// An element of a file.
struct Element {
    const json& value;
    SourceLocation where;

    [[noreturn]] void fail(const std::string& what) const { throw InputError(where, what); }

    /// Throws unless the value is an object with exactly these members.
    void requireMembers(std::initializer_list<const char*> names) const {
        if (!value.is_object()) fail("must be an object");
        for (const char* name : names)
            if (!value.contains(name)) fail(fmt::format("has no \"{}\"", name));
        for (const auto& [key, ignored] : value.items())
            if (std::find(names.begin(), names.end(), key) == names.end())
                fail(fmt::format("has \"{}\", which version {} does not know", key, kVersion));
    }

    /// Precondition: requireMembers named it.
    Element member(const char* name) const {
        const std::string prefix = where.element.empty() ? "" : where.element + ".";
        return {value.at(name), {where.file, 0, prefix + name}};
    }
    Element item(std::size_t i) const {
        return {value.at(i), {where.file, 0, fmt::format("{}[{}]", where.element, i)}};
    }

    double number() const {
        if (!value.is_number()) fail("must be a number");
        return value.get<double>();
    }
    Vec3 point() const {
        if (!value.is_array() || value.size() != 3) fail("must be an array of three numbers");
        const auto coordinate = [&](std::size_t i) { return static_cast<float>(item(i).number()); };
        return {coordinate(0), coordinate(1), coordinate(2)};
    }
};

CameraSample readSample(const Element& element) {
    element.requireMembers({"seconds", "eye", "yaw", "pitch", "verticalFov"});
    CameraSample sample;
    sample.seconds = element.member("seconds").number();
    sample.pose.eye = element.member("eye").point();
    sample.pose.yaw = static_cast<float>(kDegree * element.member("yaw").number());
    sample.pose.pitch = static_cast<float>(kDegree * element.member("pitch").number());
    sample.pose.verticalFov = static_cast<float>(element.member("verticalFov").number());
    return sample;
}

void requireFormat(const Element& root) {
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
    json root;
    try {
        root = json::parse(text);
    } catch (const json::exception& error) {
        throw InputError({nameForErrors, 0, ""}, error.what());
    }
    const Element file{root, {nameForErrors, 0, ""}};
    requireFormat(file);
    const Element camera = file.member("camera");
    if (!camera.value.is_array()) camera.fail("must be an array of samples");
    std::vector<CameraSample> samples;
    for (std::size_t i = 0; i < camera.value.size(); ++i)
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
