#include "vlf/scene/generate/scene_builder.h"

#include "vlf/math/frame.h"

#include <utility>

#include <glm/gtc/matrix_transform.hpp>

namespace vlf {

namespace {

/// Corners of a box face, counter-clockwise seen from outside; faces count as in BoxMaterials.
std::array<Vec3, 4> boxFaceCorners(const Vec3& lower, const Vec3& upper, int face) {
    const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const bool positive = face % 2 == 1;
    std::array<Vec3, 4> corners;
    for (int i = 0; i < 4; ++i) {
        const bool alongU = i == 1 || i == 2, alongV = i >= 2;
        Vec3& c = corners[positive ? i : 3 - i];
        c[axis] = positive ? upper[axis] : lower[axis];
        c[u] = alongU ? upper[u] : lower[u];
        c[v] = alongV ? upper[v] : lower[v];
    }
    return corners;
}

Vec3 boxFaceNormal(int face) {
    Vec3 normal(0);
    normal[face / 2] = face % 2 == 1 ? 1.0f : -1.0f;
    return normal;
}

/// Texture coordinates in metres: z and y on sides, x and y on fronts, x and z on floors.
Vec2 planarUv(const Vec3& p, int face) {
    if (face / 2 == 0) return {p.z, p.y};
    return face / 2 == 1 ? Vec2(p.x, p.z) : Vec2(p.x, p.y);
}

}  // namespace

Mat4 axisFrame(const Vec3& from, const Vec3& to) {
    const Frame f = frameFromNormal(glm::normalize(to - from));
    return Mat4(Vec4(f.bitangent, 0), Vec4(f.normal, 0), Vec4(f.tangent, 0), Vec4(from, 1));
}

int SceneBuilder::addTexture(Texture texture) {
    scene_.textures.push_back(std::move(texture));
    return static_cast<int>(scene_.textures.size()) - 1;
}

MaterialId SceneBuilder::addMaterial(const std::string& name, const Vec3& diffuse,
                                     const Vec3& mirror) {
    scene_.materials.push_back({.name = name, .diffuse = diffuse, .mirror = mirror});
    return static_cast<MaterialId>(scene_.materials.size()) - 1;
}

MaterialId SceneBuilder::addGlass(const std::string& name, const Vec3& transmission, float ior,
                                  bool thin) {
    const MaterialId id = addMaterial(name, Vec3(0));
    scene_.materials[id].transmission = transmission;
    scene_.materials[id].ior = ior;
    scene_.materials[id].thin = thin;
    return id;
}

MaterialId SceneBuilder::addRoughMirror(const std::string& name, const Vec3& diffuse,
                                        const Vec3& mirror, float roughness) {
    const MaterialId id = addMaterial(name, diffuse, mirror);
    scene_.materials[id].roughness = roughness;
    return id;
}

MaterialId SceneBuilder::addMaterial(const std::string& name, Texture diffuse) {
    const MaterialId id = addMaterial(name, Vec3(1));
    scene_.materials[id].diffuseTexture = addTexture(std::move(diffuse));
    return id;
}

MaterialId SceneBuilder::addEmitter(const std::string& name, const Vec3& radiance) {
    const MaterialId id = addMaterial(name, Vec3(0));
    scene_.materials[id].emission = radiance;
    return id;
}

MaterialId SceneBuilder::addEmitter(const std::string& name, const Vec3& radiance,
                                    Texture texture) {
    const MaterialId id = addEmitter(name, radiance);
    scene_.materials[id].emissionTexture = addTexture(std::move(texture));
    return id;
}

void SceneBuilder::addCamera(const std::string& name, const Vec3& eye, const Vec3& look,
                             float verticalFov) {
    scene_.cameras.push_back({name, eye, look, {0, 1, 0}, verticalFov});
}

void SceneBuilder::endMesh() {
    if (scene_.meshes.empty()) return;
    Mesh& mesh = scene_.meshes.back();
    mesh.triangleCount = static_cast<std::uint32_t>(scene_.triangles.size()) - mesh.firstTriangle;
}

void SceneBuilder::beginMesh(const std::string& name) {
    endMesh();
    scene_.meshes.push_back({name, static_cast<std::uint32_t>(scene_.triangles.size()), 0});
}

void SceneBuilder::place(const Vec3& origin, float degreesAboutY) {
    worldFromLocal_ =
        glm::rotate(glm::translate(Mat4(1), origin), glm::radians(degreesAboutY), Vec3(0, 1, 0));
}

std::uint32_t SceneBuilder::addVertex(const Vec3& position, const Vec3& normal, const Vec2& uv) {
    scene_.positions.emplace_back(worldFromLocal_ * Vec4(position, 1));
    scene_.normals.push_back(glm::normalize(Mat3(worldFromLocal_) * normal));
    scene_.uvs.push_back(uv);
    return static_cast<std::uint32_t>(scene_.positions.size()) - 1;
}

void SceneBuilder::addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                               MaterialId material) {
    scene_.triangles.push_back({{a, b, c}, material});
}

void SceneBuilder::addPolygon(std::span<const Vec3> corners, MaterialId material,
                              std::span<const Vec2> uvs) {
    const Vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    std::uint32_t first = 0, previous = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint32_t v = addVertex(corners[i], normal, uvs.empty() ? Vec2(0) : uvs[i]);
        if (i == 0) first = v;
        if (i >= 2) addTriangle(first, previous, v, material);
        previous = v;
    }
}

void SceneBuilder::addQuad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                           MaterialId material) {
    const std::array<Vec3, 4> corners{a, b, c, d};
    const std::array<Vec2, 4> uvs{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    addPolygon(corners, material, uvs);
}

void SceneBuilder::addBoxFace(const Vec3& lower, const Vec3& upper, int face, MaterialId material,
                              bool inward) {
    std::array<Vec3, 4> corners = boxFaceCorners(lower, upper, face);
    if (inward) std::swap(corners[1], corners[3]);
    std::array<Vec2, 4> uvs;
    for (int i = 0; i < 4; ++i) uvs[i] = planarUv(corners[i], face) / textureSize_;
    addPolygon(corners, material, uvs);
}

void SceneBuilder::addBox(const Vec3& lower, const Vec3& upper, const BoxMaterials& materials) {
    for (int face = 0; face < 6; ++face)
        if (materials[face] != kLeaveOut) addBoxFace(lower, upper, face, materials[face], false);
}

void SceneBuilder::addBox(const Vec3& lower, const Vec3& upper, MaterialId material,
                          unsigned omit) {
    BoxMaterials materials;
    for (int face = 0; face < 6; ++face) materials[face] = omit >> face & 1 ? kLeaveOut : material;
    addBox(lower, upper, materials);
}

void SceneBuilder::addRoom(const Vec3& lower, const Vec3& upper, const BoxMaterials& materials) {
    for (int face = 0; face < 6; ++face)
        if (materials[face] != kLeaveOut) addBoxFace(lower, upper, face, materials[face], true);
}

void SceneBuilder::addCellFaces(const CellGrid& grid, const CellTest& inside,
                                const FaceMaterial& material, bool inward) {
    const std::array<int, 3> n{static_cast<int>(grid.x.size()) - 1,
                               static_cast<int>(grid.y.size()) - 1,
                               static_cast<int>(grid.z.size()) - 1};
    const auto isInside = [&](int i, int j, int k) {
        return i >= 0 && j >= 0 && k >= 0 && i < n[0] && j < n[1] && k < n[2] && inside(i, j, k);
    };
    const auto addFace = [&](int i, int j, int k, int face) {
        const Vec3 normal = boxFaceNormal(face);
        if (isInside(i + static_cast<int>(normal.x), j + static_cast<int>(normal.y),
                     k + static_cast<int>(normal.z)))
            return;
        const Vec3 lower(grid.x[i], grid.y[j], grid.z[k]);
        const Vec3 upper(grid.x[i + 1], grid.y[j + 1], grid.z[k + 1]);
        const Vec3 faceCentre = 0.5f * (lower + upper + normal * (upper - lower));
        const MaterialId m = material(faceCentre, normal);
        if (m != kLeaveOut) addBoxFace(lower, upper, face, m, inward);
    };
    for (int i = 0; i < n[0]; ++i)
        for (int j = 0; j < n[1]; ++j)
            for (int k = 0; k < n[2]; ++k)
                for (int face = 0; face < 6; ++face)
                    if (inside(i, j, k)) addFace(i, j, k, face);
}

void SceneBuilder::addCells(const CellGrid& grid, const CellTest& inside,
                            const FaceMaterial& material) {
    addCellFaces(grid, inside, material, false);
}

void SceneBuilder::addCells(const CellGrid& grid, const CellTest& inside, MaterialId material) {
    addCellFaces(grid, inside, [&](const Vec3&, const Vec3&) { return material; }, false);
}

void SceneBuilder::addCellRoom(const CellGrid& grid, const CellTest& inside,
                               const FaceMaterial& material) {
    addCellFaces(grid, inside, material, true);
}

void SceneBuilder::addLatheBand(const Vec2& from, const Vec2& to, int segments,
                                MaterialId material) {
    const Vec2 slope = to - from;
    const auto first = static_cast<std::uint32_t>(scene_.positions.size());
    for (int i = 0; i <= segments; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(segments);
        const float angle =
            2 * kPi * static_cast<float>(i % segments) / static_cast<float>(segments);
        const Vec3 out(std::sin(angle), 0, std::cos(angle));
        const Vec3 normal = slope.y * out - Vec3(0, slope.x, 0);
        addVertex(from.x * out + Vec3(0, from.y, 0), normal, {t, 0});
        addVertex(to.x * out + Vec3(0, to.y, 0), normal, {t, 1});
    }
    for (int i = 0; i < segments; ++i) {
        const std::uint32_t a = first + 2 * i;
        if (from.x > 0) addTriangle(a, a + 2, a + 1, material);
        if (to.x > 0) addTriangle(a + 2, a + 3, a + 1, material);
    }
}

void SceneBuilder::addLathe(std::span<const Vec2> profile, int segments, MaterialId material) {
    for (std::size_t i = 0; i + 1 < profile.size(); ++i)
        addLatheBand(profile[i], profile[i + 1], segments, material);
}

void SceneBuilder::addBall(const Vec3& centre, float radius, int rings, MaterialId material) {
    std::vector<Vec2> profile;
    for (int i = 0; i <= rings; ++i) {
        const float angle = kPi * static_cast<float>(i) / static_cast<float>(rings);
        const bool pole = i == 0 || i == rings;
        profile.push_back(centre.y * Vec2(0, 1) +
                          radius * Vec2(pole ? 0 : std::sin(angle), -std::cos(angle)));
    }
    const Mat4 outer = std::exchange(worldFromLocal_,
                                     glm::translate(worldFromLocal_, Vec3(centre.x, 0, centre.z)));
    const std::size_t first = scene_.positions.size();
    addLathe(profile, 2 * rings, material);
    const Vec3 middle(worldFromLocal_ * Vec4(0, centre.y, 0, 1));
    for (std::size_t v = first; v < scene_.positions.size(); ++v)
        scene_.normals[v] = glm::normalize(scene_.positions[v] - middle);
    worldFromLocal_ = outer;
}

void SceneBuilder::addCylinder(const Vec3& from, const Vec3& to, float radius, int segments,
                               MaterialId material) {
    const Mat4 outer = std::exchange(worldFromLocal_, worldFromLocal_ * axisFrame(from, to));
    const float height = glm::distance(from, to);
    const std::array<Vec2, 4> profile{Vec2(0, 0), Vec2(radius, 0), Vec2(radius, height),
                                      Vec2(0, height)};
    addLathe(profile, segments, material);
    worldFromLocal_ = outer;
}

void SceneBuilder::addTorus(int nu, int nv, const std::function<Vec3(float u, float v)>& position,
                            MaterialId material) {
    const auto at = [&](int i, int j) {
        return position(static_cast<float>((i + nu) % nu) / static_cast<float>(nu),
                        static_cast<float>((j + nv) % nv) / static_cast<float>(nv));
    };
    const auto first = static_cast<std::uint32_t>(scene_.positions.size());
    for (int i = 0; i <= nu; ++i) {
        for (int j = 0; j <= nv; ++j) {
            const Vec3 normal =
                glm::cross(at(i + 1, j) - at(i - 1, j), at(i, j + 1) - at(i, j - 1));
            addVertex(at(i, j), normal,
                      {static_cast<float>(i) / static_cast<float>(nu),
                       static_cast<float>(j) / static_cast<float>(nv)});
        }
    }
    for (int i = 0; i < nu; ++i) {
        for (int j = 0; j < nv; ++j) {
            const std::uint32_t a = first + i * (nv + 1) + j, b = a + nv + 1;
            addTriangle(a, b, b + 1, material);
            addTriangle(a, b + 1, a + 1, material);
        }
    }
}

Scene SceneBuilder::finish() {
    endMesh();
    return std::move(scene_);
}

}  // namespace vlf
