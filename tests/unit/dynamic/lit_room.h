#pragma once
// A scene with its texels, every one of which reflects the same radiance.

#include "vlf/dynamic/room_texels.h"
#include "vlf/unwrap/unwrap.h"

#include <utility>
#include <vector>

namespace vlf::test {

struct LitRoom {
    Scene scene;
    RayScene rays;
    LightField field;
    RoomTexels texels;
    std::vector<Vec3> radiance;

    LitRoom(Scene s, const Vec3& reflected)
        : scene(std::move(s)),
          rays(scene),
          field(charts(scene, rays)),
          texels(makeRoomTexels(scene, rays, field)),
          radiance(texels.unwrap.atlasSize(), reflected) {}

  private:
    static LightField charts(const Scene& scene, const RayScene& rays) {
        UnwrapParams params;
        params.texelBudget = 2000;
        const Unwrap unwrapped = unwrap(scene, rays, params);
        LightField field;
        field.charts = unwrapped.charts;
        field.triangleCharts = unwrapped.triangleCharts;
        field.atlas = {unwrapped.atlasWidth, unwrapped.atlasHeight,
                       std::vector<Vec3>(unwrapped.atlasSize(), Vec3(0))};
        const Sphere sphere = boundingSphere(scene);
        field.frame = {sphere.centre, sphere.radius};
        field.record.directions = 129;
        field.record.cells = 64;
        return field;
    }
};

}  // namespace vlf::test
