#include "vlf/scene/generate/primitives.h"

#include "vlf/base/error.h"
#include "vlf/scene/generate/fixtures.h"

#include <array>
#include <cmath>

namespace vlf {

namespace {

constexpr int kRings = 16, kSegments = 32;  // of the sphere
constexpr int kKnotTriangles = 4000;

void addSphere(SceneBuilder& builder, MaterialId material) {
    std::array<Vec2, kRings + 1> profile;
    for (int i = 0; i <= kRings; ++i) {
        const float angle = kPi * static_cast<float>(i) / kRings;
        profile[i] = {0.5f * std::sin(angle), -0.5f * std::cos(angle)};
    }
    profile.front().x = profile.back().x = 0;
    builder.addLathe(profile, kSegments, material);
}

/// Centred, and its longest side one metre.
void fitToUnit(Scene& scene) {
    const Bounds bounds = boundsOf(scene);
    const float scale = 1 / maxComponent(bounds.size());
    for (Vec3& p : scene.positions) p = scale * (p - bounds.centre());
}

}  // namespace

const std::vector<std::string>& primitiveNames() {
    static const std::vector<std::string> names{"cube", "sphere", "knot"};
    return names;
}

Scene makePrimitive(const std::string& name, const Material& material) {
    SceneBuilder builder;
    const MaterialId id = builder.addMaterial(material.name, material.diffuse, material.mirror);
    builder.beginMesh(name);
    if (name == "cube")
        builder.addBox(Vec3(-0.5f), Vec3(0.5f), id);
    else if (name == "sphere")
        addSphere(builder, id);
    else if (name == "knot")
        addKnot(builder, kKnotTriangles, id);
    else
        throw InputError("there is no body '" + name + "': cube, sphere or knot");
    Scene scene = builder.finish();
    scene.materials[id] = material;
    if (name == "sphere")
        for (std::size_t i = 0; i < scene.normals.size(); ++i)
            scene.normals[i] = glm::normalize(scene.positions[i]);
    fitToUnit(scene);
    return scene;
}

}  // namespace vlf
