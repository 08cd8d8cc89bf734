#include "fuzz/readers.h"
#include "fuzz/require.h"
#include "fuzz/scratch.h"
#include "fuzz/seeds.h"

#include "vlf/io/validate.h"
#include "vlf/scene/import/import.h"

#include <cmath>
#include <string>

namespace vlf::fuzz {

namespace {

bool isUnit(const Vec3& v) {
    return std::abs(glm::length(v) - 1) < 1e-3f;
}

void requireSoundTriangle(const Scene& scene, std::uint32_t t) {
    const Vec2 middle(1.0f / 3);
    require(isUnit(geometricNormal(scene, t)), "with a normal");
    require(isUnit(shadingNormalAt(scene, t, middle)), "with a shading normal");
    const Material& material = scene.material(t);
    const Vec2 uv = uvAt(scene, t, middle);
    require(isFinite(diffuseReflectance(scene, material, uv)), "of finite reflectance");
    require(isFinite(mirrorReflectance(scene, material, uv)), "of finite reflectance");
    require(isFinite(emittedRadiance(scene, material, uv)), "of finite emission");
}

void requireSoundCamera(const Camera& camera) {
    const Vec3 forward = glm::normalize(camera.look - camera.eye);
    require(isUnit(forward), "with a direction to look");
    require(isFinite(glm::normalize(glm::cross(forward, camera.up))), "with an upright camera");
}

/// What scene.h says of a scene, of one that importScene returned.
void requireSound(const Scene& scene) {
    requireAccepted([&] { checkScene(scene, "scene"); });
    for (const Vec3& normal : scene.normals) require(isUnit(normal), "of unit normals");
    for (const Material& m : scene.materials)
        require(maxComponent(m.diffuse + m.mirror) <= 1 + 1e-4f, "of reflectances up to 1");
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) requireSoundTriangle(scene, t);
    for (const Camera& camera : scene.cameras) requireSoundCamera(camera);
}

bool import(const std::string& path) {
    return isAccepted([&] {
        ImportReport report;
        requireSound(importScene({path}, report));
    });
}

}  // namespace

bool readObj(Bytes bytes) {
    static const bool ready = (putSceneFiles(), true);
    return ready && import(putFile("input.obj", bytes));
}

bool readMtl(Bytes bytes) {
    static const std::string obj = (putSceneFiles(), putFile("mtl.obj", objOfMaterials()));
    putFile("input.mtl", bytes);
    return import(obj);
}

bool readCameras(Bytes bytes) {
    static const std::string obj =
        putFile("cameras.obj", toBlob("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    putFile("cameras.cameras.json", bytes);
    return import(obj);
}

bool readGltf(Bytes bytes) {
    static const bool ready = (putSceneFiles(), true);
    return ready && import(putFile("input.gltf", bytes));
}

}  // namespace vlf::fuzz
