#include "vlf/scene/scene.h"

#include <algorithm>
#include <limits>

namespace vlf {

namespace {

template <class T>
T interpolate(const std::vector<T>& values, const Triangle& t, const Vec2& b) {
    return (1 - b.x - b.y) * values[t.vertex[0]] + b.x * values[t.vertex[1]] +
           b.y * values[t.vertex[2]];
}

Vec3 textured(const Scene& scene, const Vec3& factor, int texture, const Vec2& uv) {
    return texture < 0 ? factor : factor * scene.textures[texture].sample(uv);
}

template <class T>
void extend(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

/// Whether `is` holds for the material of any triangle.
template <class Is>
bool hasMaterial(const Scene& scene, Is is) {
    return std::any_of(scene.triangles.begin(), scene.triangles.end(),
                       [&](const Triangle& t) { return is(scene.materials[t.material]); });
}

}  // namespace

Vec3 areaVector(const Scene& scene, std::uint32_t triangle) {
    const Vec3& a = scene.position(triangle, 0);
    return glm::cross(scene.position(triangle, 1) - a, scene.position(triangle, 2) - a);
}

Vec3 geometricNormal(const Scene& scene, std::uint32_t triangle) {
    return glm::normalize(areaVector(scene, triangle));
}

float area(const Scene& scene, std::uint32_t triangle) {
    return 0.5f * glm::length(areaVector(scene, triangle));
}

Vec3 positionAt(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric) {
    return interpolate(scene.positions, scene.triangles[triangle], barycentric);
}

Vec2 uvAt(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric) {
    return interpolate(scene.uvs, scene.triangles[triangle], barycentric);
}

Vec3 shadingNormalAt(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric) {
    const Vec3 n = interpolate(scene.normals, scene.triangles[triangle], barycentric);
    const float length = glm::length(n);
    return length > 1e-6f ? n / length : geometricNormal(scene, triangle);
}

Vec3 diffuseReflectance(const Scene& scene, const Material& material, const Vec2& uv) {
    return textured(scene, material.diffuse, material.diffuseTexture, uv);
}

Vec3 mirrorReflectance(const Scene& scene, const Material& material, const Vec2& uv) {
    return textured(scene, material.mirror, material.mirrorTexture, uv);
}

Vec3 emittedRadiance(const Scene& scene, const Material& material, const Vec2& uv) {
    return textured(scene, material.emission, material.emissionTexture, uv);
}

bool hasEmitter(const Scene& scene) {
    return hasMaterial(scene, [](const Material& m) { return m.isEmitter(); });
}

bool hasLight(const Scene& scene) {
    return hasEmitter(scene) || !scene.lights.empty() || !scene.environment.isBlack();
}

bool hasMirror(const Scene& scene, MirrorKind kind) {
    return hasMaterial(scene, [&](const Material& m) { return m.isMirror(kind); });
}

bool hasSpecular(const Scene& scene, MirrorKind kind) {
    return hasMaterial(scene, [&](const Material& m) { return m.isSpecular(kind); });
}

bool hasGlass(const Scene& scene) {
    return hasMaterial(scene, [](const Material& m) { return m.isGlass(); });
}

bool hasPane(const Scene& scene) {
    return hasMaterial(scene, [](const Material& m) { return m.isPane(); });
}

bool hasMirror(const Scene& scene) {
    return hasMirror(scene, MirrorKind::perfect) || hasMirror(scene, MirrorKind::rough);
}

bool makeGlossDiffuse(Scene& scene) {
    const auto mean = [&](int texture) {
        return texture < 0 ? Vec3(1) : scene.textures[texture].average();
    };
    bool any = false;
    for (Material& m : scene.materials) {
        if (!m.isGlossy()) continue;
        any = true;
        const Vec3 added =
            m.mirror * mean(m.mirrorTexture) / glm::max(mean(m.diffuseTexture), Vec3(1e-3f));
        m.diffuse = glm::max(m.diffuse, glm::min(Vec3(1), m.diffuse + added));
        m.mirror = Vec3(0);
        m.mirrorTexture = -1;
        m.roughness = 0;
    }
    return any;
}

bool dropGlass(Scene& scene) {
    if (!hasGlass(scene)) return false;
    std::vector<std::uint32_t> keptBefore{0};
    for (const Triangle& t : scene.triangles)
        keptBefore.push_back(keptBefore.back() + (scene.materials[t.material].isGlass() ? 0 : 1));
    for (Mesh& mesh : scene.meshes) {
        const std::uint32_t end = keptBefore[mesh.firstTriangle + mesh.triangleCount];
        mesh.firstTriangle = keptBefore[mesh.firstTriangle];
        mesh.triangleCount = end - mesh.firstTriangle;
    }
    std::erase_if(scene.triangles,
                  [&](const Triangle& t) { return scene.materials[t.material].isGlass(); });
    return true;
}

Bounds boundsOf(const Scene& scene) {
    Bounds bounds;
    for (const Vec3& p : scene.positions) bounds.add(p);
    return bounds;
}

Sphere boundingSphere(const Scene& scene) {
    Sphere sphere{boundsOf(scene).centre(), 0};
    for (const Vec3& p : scene.positions)
        sphere.radius = std::max(sphere.radius, glm::distance(p, sphere.centre));
    return sphere;
}

void append(Scene& scene, const Scene& other) {
    const auto vertices = static_cast<std::uint32_t>(scene.positions.size());
    const auto triangles = static_cast<std::uint32_t>(scene.triangles.size());
    const auto materials = static_cast<std::uint32_t>(scene.materials.size());
    const auto textures = static_cast<int>(scene.textures.size());
    extend(scene.positions, other.positions);
    extend(scene.normals, other.normals);
    extend(scene.uvs, other.uvs);
    extend(scene.textures, other.textures);
    extend(scene.cameras, other.cameras);
    extend(scene.lights, other.lights);
    for (Triangle t : other.triangles) {
        for (std::uint32_t& v : t.vertex) v += vertices;
        t.material += materials;
        scene.triangles.push_back(t);
    }
    for (Mesh m : other.meshes) {
        m.firstTriangle += triangles;
        scene.meshes.push_back(std::move(m));
    }
    for (Material m : other.materials) {
        for (int* t : {&m.diffuseTexture, &m.mirrorTexture, &m.emissionTexture})
            if (*t >= 0) *t += textures;
        scene.materials.push_back(std::move(m));
    }
}

Camera defaultCamera(const Scene& scene) {
    const Bounds bounds = boundsOf(scene);
    const Vec3 centre = bounds.centre();
    // Far from the origin floats are too coarse to tell eye and look of a small scene apart.
    const Vec3 coarse = 16 * std::numeric_limits<float>::epsilon() * glm::abs(centre);
    const Vec3 half = glm::max(0.5f * bounds.size(), coarse);
    return {"default",
            centre + 0.92f * half * Vec3(0.9f, 0.45f, 0.95f),
            centre - Vec3(0, 0.15f * half.y, 0),
            {0, 1, 0},
            65};
}

}  // namespace vlf
