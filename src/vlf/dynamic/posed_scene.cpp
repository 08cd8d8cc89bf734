#include "vlf/dynamic/posed_scene.h"

namespace vlf {

Scene posedScene(const Scene& room, std::span<const DynamicObject> objects) {
    Scene posed = room;
    for (const DynamicObject& object : objects) {
        if (!object.visible) continue;
        Scene copy = object.model->scene();
        for (Vec3& p : copy.positions) p = object.pose.point(p);
        for (Vec3& n : copy.normals) n = object.pose.direction(n);
        copy.cameras.clear();
        copy.lights.clear();  // an object has none
        append(posed, copy);
    }
    return posed;
}

}  // namespace vlf
