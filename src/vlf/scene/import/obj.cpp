// Wavefront OBJ to Scene: triangulation, missing normals, one index per vertex.

#include "vlf/scene/import/alpha_mask.h"
#include "vlf/scene/import/camera_file.h"
#include "vlf/scene/import/file_bytes.h"
#include "vlf/scene/import/import.h"
#include "vlf/scene/import/limits.h"
#include "vlf/scene/import/obj_file.h"
#include "vlf/scene/import/obj_material.h"
#include "vlf/scene/import/polygon.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>

#include <filesystem>
#include <unordered_map>

namespace vlf {

namespace {

std::vector<Vec3> cornerPositions(const ObjFile& file, const ObjFace& face) {
    std::vector<Vec3> positions(face.cornerCount);
    for (std::uint32_t i = 0; i < face.cornerCount; ++i)
        positions[i] = file.positions[file.corners[face.firstCorner + i].position];
    return positions;
}

std::uint64_t pairKey(std::uint32_t a, std::uint32_t b) {
    return (static_cast<std::uint64_t>(a) << 32) | b;
}

/// Gives every corner without a normal one: the face's own, or inside a smoothing group the
/// area-weighted mean of the group's faces around the vertex.
void addMissingNormals(ObjFile& file) {
    std::unordered_map<std::uint64_t, int> smooth;  // (vertex, group) -> normal
    std::vector<glm::dvec3> sums;
    const auto firstNew = static_cast<int>(file.normals.size());
    const auto newSum = [&] {
        sums.emplace_back(0);
        return firstNew + static_cast<int>(sums.size()) - 1;
    };
    for (const ObjFace& face : file.faces) {
        const glm::dvec3 areaNormal = polygonAreaVector(cornerPositions(file, face));
        int flat = -1;
        for (std::uint32_t i = 0; i < face.cornerCount; ++i) {
            ObjCorner& corner = file.corners[face.firstCorner + i];
            if (corner.normal >= 0) continue;
            if (face.smoothing > 0) {
                const auto [entry, isNew] =
                    smooth.try_emplace(pairKey(corner.position, face.smoothing), 0);
                if (isNew) entry->second = newSum();
                corner.normal = entry->second;
                sums[corner.normal - firstNew] += areaNormal;
            } else {
                if (flat < 0) sums[(flat = newSum()) - firstNew] = areaNormal;
                corner.normal = flat;
            }
        }
    }
    for (const glm::dvec3& sum : sums) {
        const double length = glm::length(sum);
        file.normals.push_back(length > 0 ? Vec3(sum / length) : Vec3(0));
    }
}

struct CornerHash {
    std::size_t operator()(const ObjCorner& c) const {
        std::uint64_t h = pairKey(c.position, c.uv) * 0x9e3779b97f4a7c15ull;
        h ^= (h >> 32) + static_cast<std::uint32_t>(c.normal) * 0xd1342543de82ef95ull;
        return static_cast<std::size_t>(h ^ (h >> 29));
    }
};

struct SameCorner {
    bool operator()(const ObjCorner& a, const ObjCorner& b) const {
        return a.position == b.position && a.uv == b.uv && a.normal == b.normal;
    }
};

/// Turns corners into vertices of the scene, equal corners into one.
class VertexTable {
  public:
    VertexTable(Scene& scene, ObjFile& file) : scene_(scene), file_(file) {
        vertices_.reserve(file.corners.size());
    }

    std::uint32_t vertex(ObjCorner corner, int materialSlot, const ObjMaterial& material) {
        if (corner.uv >= 0 && (material.uvScale != Vec2(1) || material.uvOffset != Vec2(0)))
            corner.uv = transformedUv(corner.uv, materialSlot, material);
        const auto [entry, isNew] =
            vertices_.try_emplace(corner, static_cast<std::uint32_t>(scene_.positions.size()));
        if (isNew) {
            scene_.positions.push_back(file_.positions[corner.position]);
            scene_.normals.push_back(file_.normals[corner.normal]);
            scene_.uvs.push_back(corner.uv < 0 ? Vec2(0) : file_.uvs[corner.uv]);
        }
        return entry->second;
    }

  private:
    int transformedUv(int uv, int materialSlot, const ObjMaterial& material) {
        const auto [entry, isNew] =
            transformed_.try_emplace(pairKey(uv, materialSlot), static_cast<int>(file_.uvs.size()));
        if (isNew) file_.uvs.push_back(material.uvScale * file_.uvs[uv] + material.uvOffset);
        return entry->second;
    }

    Scene& scene_;
    ObjFile& file_;
    std::unordered_map<ObjCorner, std::uint32_t, CornerHash, SameCorner> vertices_;
    std::unordered_map<std::uint64_t, int> transformed_;
};

/// Triangles that follow in the part of the OBJ file called `name` go into one mesh.
void startMesh(Scene& scene, const std::string& name) {
    scene.meshes.push_back({name, static_cast<std::uint32_t>(scene.triangles.size()), 0});
}

void addTriangles(Scene& scene, ObjFile& file, const std::vector<ObjMaterial>& materials) {
    VertexTable table(scene, file);
    int part = -1;
    for (const ObjFace& face : file.faces) {
        const int slot =
            face.material >= 0 ? face.material : static_cast<int>(materials.size()) - 1;
        if (!materials[slot].index) continue;
        checkTriangleCount(scene.triangles.size() + face.cornerCount - 2, file.path);
        if (face.part != part) startMesh(scene, file.parts[part = face.part].name);
        for (const auto& corners : triangulatePolygon(cornerPositions(file, face))) {
            Triangle triangle{{}, *materials[slot].index};
            for (int k = 0; k < 3; ++k)
                triangle.vertex[k] = table.vertex(file.corners[face.firstCorner + corners[k]], slot,
                                                  materials[slot]);
            scene.triangles.push_back(triangle);
            ++scene.meshes.back().triangleCount;
        }
    }
}

}  // namespace

ImportedScene importObj(const std::string& path, ImportReport& report) {
    noteFile(report, path);
    ObjFile file = parseObj(path, readFileText(path), report);
    const std::string stem = std::filesystem::path(path).stem().string();
    for (ObjName& part : file.parts)
        if (part.name.empty()) part.name = stem;
    ImportedScene imported;
    Scene& scene = imported.scene;
    const std::vector<ObjMaterial> materials = addObjMaterials(imported, file, report);
    addMissingNormals(file);
    addTriangles(scene, file, materials);
    scene.cameras = readCameraSidecar(path, report);
    return imported;
}

}  // namespace vlf
