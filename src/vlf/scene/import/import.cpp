#include "vlf/scene/import/import.h"

#include "vlf/scene/import/cut_masks.h"
#include "vlf/scene/import/glass_bodies.h"
#include "vlf/scene/import/limits.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace vlf {

namespace {

/// Distance from the origin, in sizes of the scene, from which on single precision shows.
constexpr float kFarAway = 1000;

ImportedScene readSceneFile(const std::string& path, ImportReport& report) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".obj") return importObj(path, report);
    if (extension == ".gltf" || extension == ".glb") return importGltf(path, report);
    throw InputError({path, 0, ""},
                     fmt::format("unknown scene format '{}'; use .obj, .gltf or .glb", extension));
}

/// With holes where masks are transparent, and glass told apart.
Scene importFile(const std::string& path, ImportReport& report) {
    ImportedScene imported = readSceneFile(path, report);
    cutMasks(imported.scene, imported.masked, path, report);
    sortGlass(imported.scene, imported.glass);
    return std::move(imported.scene);
}

std::string joined(const std::vector<std::string>& paths) {
    std::string all;
    for (const std::string& path : paths) all += (all.empty() ? "" : ", ") + path;
    return all;
}

void warnOfDropped(ImportReport& report, const SourceLocation& where) {
    if (report.degenerateTriangles > 0)
        warn(report, where,
             fmt::format("{} triangles without area are dropped", report.degenerateTriangles));
    if (report.duplicateTriangles > 0)
        warn(report, where,
             fmt::format("{} triangles that repeat others are dropped", report.duplicateTriangles));
}

}  // namespace

Scene importScene(const std::vector<std::string>& paths, ImportReport& report) {
    Scene scene;
    for (const std::string& path : paths) {
        const Scene part = importFile(path, report);
        checkTriangleCount(scene.triangles.size() + part.triangles.size(), path);
        append(scene, part);
    }
    cleanScene(scene, report);
    warnOfDropped(report, {joined(paths), 0, ""});
    if (scene.triangles.empty())
        throw InputError({joined(paths), 0, ""},
                         "no triangle with an area, so there is nothing to light");
    const Bounds bounds = boundsOf(scene);
    if (maxComponent(glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper))) > kMaxCoordinate)
        throw InputError({joined(paths), 0, ""},
                         fmt::format("coordinates beyond {:g} m; scale the scene or remove them",
                                     kMaxCoordinate));
    if (glm::length(bounds.centre()) > kFarAway * glm::length(bounds.size()))
        warn(report, {joined(paths), 0, ""},
             "the scene lies far from the origin; move it there to keep its precision");
    return scene;
}

}  // namespace vlf
