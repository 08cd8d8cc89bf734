#include "vlf/render/cpu/still.h"

#include "vlf/base/error.h"
#include "vlf/render/cpu/field_shader.h"
#include "vlf/render/cpu/supersample.h"
#include "vlf/render/cpu/wireframe.h"

#include <chrono>

namespace vlf {

namespace {

constexpr int kMaxAntialias = 16;

Image renderRadiance(const Scene& scene, const RayScene& rays, const LightField& field,
                     const StillParams& params, Progress& progress, std::uint64_t& traced) {
    const FieldShader shader(
        scene, rays, field,
        params.mode == DisplayMode::field ? MirrorMethod::lookedUp : MirrorMethod::traced,
        params.lookup, params.objects);
    return supersample(
        CameraRays(params.camera, params.width, params.height), params.width, params.height,
        params.antialias,
        [&](std::span<const Ray> r, int perPixel, std::span<Vec3> seen) {
            return shader.radiance(r, seen, perPixel);
        },
        progress, traced);
}

Image render(const Scene& scene, const RayScene& rays, const LightField& field,
             const StillParams& params, Progress& progress, std::uint64_t& traced) {
    switch (params.mode) {
        case DisplayMode::wireframe:
            return drawWireframe(scene, rays, params.camera, params.width, params.height,
                                 params.normals, progress, traced, params.objects);
        case DisplayMode::diagram:
            return drawDiagram(scene, rays, field, params.camera, params.width, params.height,
                               params.antialias, params.diagram, progress, traced, params.objects);
        default:
            return renderRadiance(scene, rays, field, params, progress, traced);
    }
}

}  // namespace

Image renderStill(const Scene& scene, const RayScene& rays, const LightField& field,
                  const StillParams& params, Progress& progress, StillReport* report) {
    using Clock = std::chrono::steady_clock;
    if (params.antialias < 1 || params.antialias > kMaxAntialias)
        throw InputError("antialias must lie between 1 and " + std::to_string(kMaxAntialias) +
                         " rays along a pixel's side");
    const Clock::time_point start = Clock::now();
    std::uint64_t traced = 0;
    progress.stage("rendering");
    Image image = render(scene, rays, field, params, progress, traced);
    progress.check();
    if (report) *report = {std::chrono::duration<double>(Clock::now() - start).count(), traced};
    return image;
}

}  // namespace vlf
