#pragma once
// Small baked rooms to put objects into.

#include "support/analytic_scenes.h"
#include "support/baked_example.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/dynamic/room_texels.h"
#include "vlf/scene/generate/primitives.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace vlf::test {

struct BakedRoom {
    Scene scene;
    RayScene rays;
    LightField field;

    explicit BakedRoom(Scene s, double texelBudget = 2000)
        : scene(std::move(s)), rays(scene), field(bakeCoarsely(scene, texelBudget)) {}
    BakedRoom(const BakedRoom&) = delete;
    BakedRoom& operator=(const BakedRoom&) = delete;

  private:
    static LightField bakeCoarsely(const Scene& scene, double texelBudget) {
        BakeParams params = presetParams("draft");
        params.texelBudget = texelBudget;
        params.directions = 513;
        params.radianceDirections = 0;
        params.directSamples = 8;
        Progress progress;
        return bake(scene, params, progress);
    }
};

/// A closed room of 2 x 2 x 2 `size` whose corner is the origin. A lamp of radiance 10 hangs 1 % of
/// `size` below the middle of the ceiling, 0.6 x 0.6; everything else is as grey as `albedo`, but
/// the wall x = 0, which is as `wall` says.
inline Scene lampRoom(float size = 1, float albedo = 0.5f, const Vec3& wall = Vec3(0.5f)) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(2 * size), true, b.material("grey", Vec3(albedo)));
    const std::uint32_t other = b.material("wall", wall);
    for (int i = 0; i < 2; ++i) b.scene().triangles[i].material = other;
    b.quad(size * Vec3(0.7f, 1.99f, 0.7f), {0.6f * size, 0, 0}, {0, 0, 0.6f * size},
           b.material("lamp", Vec3(0), Vec3(10)));
    return b.scene();
}

inline DynamicObject bodyAt(const std::string& primitive, const Vec3& place, float scale,
                            const Vec3& diffuse = Vec3(0.7f), const Vec3& emission = Vec3(0)) {
    Material material;
    material.diffuse = diffuse;
    material.emission = emission;
    DynamicObject object;
    object.name = primitive;
    object.model = std::make_shared<ObjectModel>(makePrimitive(primitive, material));
    object.pose.translation = place;
    object.pose.scale = scale;
    object.settings.gather.lines = 129;
    return object;
}

/// The room with objects, updated.
struct FilledRoom {
    DynamicRoom room;

    FilledRoom(const BakedRoom& baked, std::initializer_list<DynamicObject> objects)
        : room(baked.scene, baked.rays, baked.field) {
        for (const DynamicObject& object : objects) room.add(object);
        room.update();
    }
};

inline bool isLight(const Vec3& e) {
    return isFinite(e) && e.x >= 0 && e.y >= 0 && e.z >= 0;
}

/// Whether all light of the room and on its objects is finite and none negative.
inline bool isAllLight(const DynamicRoom& room) {
    for (const Vec3& e : room.irradiance().irradiance)
        if (!isLight(e)) return false;
    for (const LitObject& object : room.litObjects()) {
        for (const Vec3& e : object.vertexIrradiance)
            if (!isLight(e)) return false;
        if (!object.texels) continue;
        for (const Vec3& e : object.atlas->irradiance)
            if (!isLight(e)) return false;
    }
    return true;
}

/// Calls visit(triangle, barycentric, area in the world, m²) for points evenly over the object.
template <class Visit>
void forSurface(const LitObject& object, const Visit& visit) {
    constexpr int kSide = 8;
    const Scene& scene = object.mesh->scene;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const float area = 0.5f * glm::length(areaVector(scene, t)) * object.pose.scale *
                           object.pose.scale / (kSide * kSide);
        for (int i = 0; i < kSide; ++i)
            for (int j = 0; j < kSide; ++j) {
                const float r = std::sqrt((i + 0.5f) / kSide), s = (j + 0.5f) / kSide;
                visit(t, Vec2(r * (1 - s), r * s), area);
            }
    }
}

/// Mean irradiance of the faces that look along `normal` (unit, of the world).
inline Vec3 meanIrradiance(const LitObject& object, const Vec3& normal) {
    Vec3 sum(0);
    float all = 0;
    forSurface(object, [&](std::uint32_t t, const Vec2& b, float area) {
        const Vec3 n = object.pose.direction(geometricNormal(object.mesh->scene, t));
        if (glm::dot(n, normal) < 0.999f) return;
        sum += area * object.irradiance(t, b, true);
        all += area;
    });
    return sum / all;
}

/// Of the room's texels by area, W·m⁻².
inline Vec3 meanIrradiance(const RoomTexels& texels, const IrradianceAtlas& atlas) {
    Vec3 sum(0);
    for (const std::uint32_t t : texels.unwrap.texels) sum += texels.area[t] * atlas.irradiance[t];
    return sum / texels.totalArea;
}

}  // namespace vlf::test
