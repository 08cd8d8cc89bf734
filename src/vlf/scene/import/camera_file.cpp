#include "vlf/scene/import/camera_file.h"

#include "vlf/base/error.h"
#include "vlf/scene/camera_view.h"
#include "vlf/scene/import/file_bytes.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace vlf {

namespace {

using nlohmann::json;

Vec3 readVec3(const json& value, const SourceLocation& where) {
    if (!value.is_array() || value.size() != 3)
        throw InputError(where, "must be an array of three numbers");
    Vec3 v;
    for (int i = 0; i < 3; ++i) {
        if (!value[i].is_number()) throw InputError(where, "must be an array of three numbers");
        v[i] = value[i].get<float>();
    }
    if (!isFinite(v)) throw InputError(where, "must be finite");
    return v;
}

const json& member(const json& object, const char* name, const SourceLocation& where) {
    const auto it = object.find(name);
    if (it == object.end()) throw InputError(where, fmt::format("has no \"{}\"", name));
    return *it;
}

Camera readCamera(const json& object, const SourceLocation& where) {
    const auto within = [&](const char* name) {
        return SourceLocation{where.file, 0, where.element + "." + name};
    };
    if (!object.is_object()) throw InputError(where, "must be an object");
    Camera camera;
    const json& name = member(object, "name", where);
    if (!name.is_string()) throw InputError(within("name"), "must be a string");
    camera.name = name.get<std::string>();
    camera.eye = readVec3(member(object, "eye", where), within("eye"));
    camera.look = readVec3(member(object, "look", where), within("look"));
    if (object.contains("up")) camera.up = readVec3(object["up"], within("up"));
    if (object.contains("verticalFov")) {
        const json& fov = object["verticalFov"];
        if (!fov.is_number() || !(fov.get<float>() > 0) || !(fov.get<float>() < 180))
            throw InputError(within("verticalFov"), "must be a number between 0 and 180 degrees");
        camera.verticalFov = fov.get<float>();
    }
    if (!hasView(camera)) throw InputError(where, "eye, look and up must span a plane");
    return camera;
}

}  // namespace

std::vector<Camera> readCameraSidecar(const std::string& scenePath, ImportReport& report) {
    const std::string path =
        std::filesystem::path(scenePath).replace_extension(".cameras.json").string();
    noteFile(report, path);
    if (!std::filesystem::exists(path)) return {};
    json root;
    try {
        root = json::parse(readFileText(path));
    } catch (const json::exception& error) {
        throw InputError({path, 0, ""}, error.what());
    }
    if (!root.is_object() || !root.contains("cameras") || !root["cameras"].is_array())
        throw InputError({path, 0, ""}, "must hold an object with an array \"cameras\"");
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < root["cameras"].size(); ++i)
        cameras.push_back(readCamera(root["cameras"][i], {path, 0, fmt::format("cameras[{}]", i)}));
    return cameras;
}

}  // namespace vlf
