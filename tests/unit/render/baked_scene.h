#pragma once
// Scenes together with a light field, for tests of what is shown of it.

#include "vlf/base/progress.h"
#include "vlf/render/cpu/still.h"
#include "vlf/unwrap/unwrap.h"

#include <utility>

namespace vlf::test {

struct BakedScene {
    Scene scene;
    RayScene rays;
    LightField field;

    explicit BakedScene(Scene s) : scene(std::move(s)), rays(scene) {}
};

/// The scene with the same irradiance on every texel: what is seen is emission + ρE/π exactly.
inline BakedScene evenlyLit(Scene scene, const Vec3& irradiance) {
    BakedScene baked(std::move(scene));
    UnwrapParams params;
    params.texelBudget = 2000;
    const Unwrap charts = unwrap(baked.scene, baked.rays, params);
    LightField& field = baked.field;
    field.charts = charts.charts;
    field.triangleCharts = charts.triangleCharts;
    field.atlas = {charts.atlasWidth, charts.atlasHeight,
                   std::vector<Vec3>(charts.atlasSize(), irradiance)};
    const Sphere sphere = boundingSphere(baked.scene);
    field.frame = {sphere.centre, sphere.radius};
    field.record.directions = 129;
    field.record.cells = 64;
    field.record.tileSize = 8;
    return baked;
}

inline StillParams stillParams(const Camera& camera, int width, int height,
                               DisplayMode mode = DisplayMode::raytraced) {
    StillParams params;
    params.camera = camera;
    params.width = width;
    params.height = height;
    params.mode = mode;
    return params;
}

inline Image render(const BakedScene& baked, const StillParams& params) {
    Progress progress;
    return renderStill(baked.scene, baked.rays, baked.field, params, progress);
}

/// From the scene's first camera.
inline Image render(const BakedScene& baked, int width, int height,
                    DisplayMode mode = DisplayMode::raytraced) {
    return render(baked, stillParams(baked.scene.cameras.front(), width, height, mode));
}

}  // namespace vlf::test
