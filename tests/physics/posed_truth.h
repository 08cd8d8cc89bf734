#pragma once
// Objects in baked rooms against the same scene path traced.

#include "unit/dynamic/baked_room.h"
#include "vlf/dynamic/coverage.h"
#include "vlf/dynamic/posed_scene.h"
#include "vlf/render/cpu/texel_reference.h"

#include <vector>

namespace vlf::test {

inline std::vector<DynamicObject> objectsOf(const DynamicRoom& room) {
    std::vector<DynamicObject> objects;
    for (std::size_t i = 0; i < room.size(); ++i) objects.push_back(room.object(i));
    return objects;
}

/// Mean irradiance, path traced, of the faces of the room's last object that look along `normals`.
inline std::vector<IrradianceEstimate> tracedFaces(const DynamicRoom& room,
                                                   const std::vector<Vec3>& normals, int samples) {
    const Scene scene = posedScene(room.scene(), objectsOf(room));
    const RayScene rays(scene);
    const LitObject& object = room.litObjects().back();
    const auto first =
        static_cast<std::uint32_t>(scene.triangles.size() - object.mesh->scene.triangles.size());
    std::vector<std::vector<SidePoint>> points(normals.size());
    forSurface(object, [&](std::uint32_t t, const Vec2& barycentric, float) {
        const Vec3 n = geometricNormal(scene, first + t);
        for (std::size_t i = 0; i < normals.size(); ++i)
            if (glm::dot(n, normals[i]) > 0.999f)
                points[i].push_back({first + t, barycentric, true});
    });
    const std::vector<TexelArea> areas(points.begin(), points.end());
    IrradianceParams params;
    params.samplesPerTexel = samples;
    Progress progress;
    const auto isOpen = [](std::uint32_t, bool front) { return front; };
    return estimateIrradiance(scene, rays, areas, isOpen, params, progress);
}

/// Flux that the room and its objects absorb, W.
inline Vec3 absorbedFlux(const DynamicRoom& room, const RoomTexels& texels) {
    Coverage coverage(texels);
    std::vector<Sphere> spheres;
    for (const std::size_t i : room.litNumbers()) {
        const DynamicObject& object = room.object(i);
        const Sphere& bounds = object.model->bounds();
        spheres.push_back({object.pose.point(bounds.centre), object.pose.scale * bounds.radius});
    }
    const RayScene rays(room.scene());
    coverage.find(room.scene(), rays, texels, room.rays(), room.litObjects(), spheres);
    glm::dvec3 sum(0);
    for (const std::uint32_t t : texels.unwrap.texels)
        sum += glm::dvec3(texels.area[t] * coverage.uncovered(t) * (1.0f - texels.reflectance[t]) *
                          room.irradiance().irradiance[t]);
    for (const LitObject& object : room.litObjects())
        forSurface(object, [&](std::uint32_t t, const Vec2& b, float area) {
            const Vec3 reflectance = object.mesh->scene.material(t).diffuse;
            sum += glm::dvec3(area * (1.0f - reflectance) * object.irradiance(t, b, true));
        });
    return Vec3(sum);
}

}  // namespace vlf::test
