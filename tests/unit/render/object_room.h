#pragma once
// Baked rooms with objects in them, for tests of what is shown of these.

#include "baked_scene.h"
#include "support/analytic_scenes.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/propagate/bake.h"
#include "vlf/scene/generate/primitives.h"

#include <memory>
#include <string>

namespace vlf::test {

inline Material plain(const Vec3& diffuse, const Vec3& mirror = Vec3(0),
                      const Vec3& emission = Vec3(0)) {
    Material material;
    material.diffuse = diffuse;
    material.mirror = mirror;
    material.emission = emission;
    return material;
}

/// Lit by the room's mean irradiance, and without a shadow.
inline DynamicObject flatObject(const std::string& primitive, const Material& material,
                                const Vec3& place, float size) {
    DynamicObject object;
    object.name = primitive;
    object.model = std::make_shared<ObjectModel>(makePrimitive(primitive, material));
    object.pose.translation = place;
    object.pose.scale = size;
    object.settings.shading = Shading::flat;
    object.settings.shadow = ShadowKind::none;
    return object;
}

struct ObjectRoom {
    const BakedScene& baked;
    DynamicRoom objects;

    ObjectRoom(const BakedScene& room, std::initializer_list<DynamicObject> inIt)
        : baked(room), objects(room.scene, room.rays, room.field) {
        for (const DynamicObject& object : inIt) objects.add(object);
        objects.update();
    }

    Image picture(int width, int height, DisplayMode mode = DisplayMode::raytraced) const {
        StillParams params = stillParams(baked.scene.cameras.front(), width, height, mode);
        params.antialias = 1;
        params.objects = &objects;
        return render(baked, params);
    }
};

/// A scene with a coarse light field, radiance of mirrors included.
inline BakedScene bakedCoarsely(Scene scene, double texels = 2000) {
    BakedScene result(std::move(scene));
    BakeParams params = presetParams("draft");
    params.texelBudget = texels;
    params.directions = params.radianceDirections = 129;
    params.radianceCells = 128;
    Progress progress;
    result.field = bake(result.scene, params, progress);
    return result;
}

}  // namespace vlf::test
