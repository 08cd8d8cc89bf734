#include "vlf/render/cpu/diagram.h"

#include "vlf/base/error.h"
#include "vlf/field/direction_set.h"
#include "vlf/image/heat_map.h"
#include "vlf/image/tone_map.h"
#include "vlf/render/cpu/field_shader.h"
#include "vlf/render/cpu/subfield_diagram.h"
#include "vlf/render/cpu/supersample.h"
#include "vlf/render/drawing/direction_ball.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace vlf {

namespace {

/// The room in display-linear colours, dark enough to draw on.
class DimmedRoom {
  public:
    DimmedRoom(const FieldShader& shader, const Camera& camera, int width, int height,
               Progress& progress)
        : shader_(shader) {
        const int w = std::max(width / 8, 1), h = std::max(height / 8, 1);
        std::uint64_t ignored = 0;
        const Image preview = supersample(
            CameraRays(camera, w, h), w, h, 1,
            [&](std::span<const Ray> r, int, std::span<Vec3> seen) {
                return shader.radiance(r, seen);
            },
            progress, ignored);
        gain_ = std::exp2(autoExposure(preview));
    }

    std::uint64_t shade(std::span<const Ray> rays, int perPixel, std::span<Vec3> colors) const {
        const std::uint64_t traced = shader_.radiance(rays, colors, perPixel);
        for (Vec3& c : colors) c = kDimmed * toneMap(gain_ * c, ToneCurve::filmic);
        return traced;
    }

  private:
    const FieldShader& shader_;
    float gain_ = 1;
};

/// Unit vector from the centre of a ball to where a unit-length ray first meets it.
std::optional<Vec3> meet(const Sphere& ball, const Ray& ray) {
    const Vec3 toCentre = ball.centre - ray.origin;
    const float along = glm::dot(toCentre, ray.direction);
    const float gap2 = glm::dot(toCentre, toCentre) - along * along;
    if (along < 0 || gap2 > ball.radius * ball.radius) return std::nullopt;
    const float t = along - std::sqrt(ball.radius * ball.radius - gap2);
    return (ray.origin + t * ray.direction - ball.centre) / ball.radius;
}

Image drawDirections(const DimmedRoom& room, const DirectionSet& set, const Camera& camera,
                     int width, int height, int antialias, Progress& progress,
                     std::uint64_t& traced) {
    const Sphere sphere = ballBefore(camera, width, height, 1);
    const auto shade = [&](std::span<const Ray> rays, int perPixel, std::span<Vec3> colors) {
        const std::uint64_t count = room.shade(rays, perPixel, colors);
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (const std::optional<Vec3> d = meet(sphere, rays[i]))
                colors[i] =
                    directionColor(set, *d) *
                    (ball::kOutlineShade - ball::kFacingShade * glm::dot(*d, rays[i].direction));
        return count;
    };
    return supersample(CameraRays(camera, width, height), width, height, antialias, shade, progress,
                       traced);
}

std::uint32_t chartInTheMiddle(const Scene& scene, const RayScene& rays, const LightField& field,
                               const Camera& camera) {
    const Ray ray = CameraRays(camera, 1, 1).ray(0.5f, 0.5f);
    const Hit hit = rays.closest(ray);
    const std::uint32_t chart =
        hit ? chartAt(field, pointFacing(scene, hit, ray.direction)) : kNoChart;
    if (chart == kNoChart)
        throw InputError("there is no chart in the middle of the picture: give its number");
    return chart;
}

/// The texel around a point of the chart, with a darker rim.
Vec3 texelColor(const IrradianceAtlas& atlas, const Chart& chart, const Vec3& p, float brightest) {
    const Vec2 size(chart.width, chart.height);
    const Vec2 t = glm::clamp(chart.texelCoordinates(p), Vec2(0), size - 0.001f);
    const Vec2 texel = glm::floor(t), within = t - texel;
    const Vec3& irradiance = atlas.at(chart.x + static_cast<std::uint32_t>(texel.x),
                                      chart.y + static_cast<std::uint32_t>(texel.y));
    const float toRim =
        std::min(std::min(within.x, 1 - within.x), std::min(within.y, 1 - within.y));
    const Vec3 color = heatColor(brightest > 0 ? luminance(irradiance) / brightest : 0);
    return toRim < kTexelRim ? kTexelRimShade * color + kTexelRimLight : color;
}

Image drawChart(const Scene& scene, const RayScene& rays, const LightField& field,
                const DimmedRoom& room, std::uint32_t selected, const Camera& camera, int width,
                int height, int antialias, Progress& progress, std::uint64_t& traced,
                const DynamicRoom* objects) {
    const Chart& chart = field.charts[selected];
    const float brightest = brightestTexel(field.atlas, chart);
    const auto shade = [&](std::span<const Ray> r, int perPixel, std::span<Vec3> colors) {
        const std::uint64_t count = room.shade(r, perPixel, colors);
        std::vector<Hit> hits(r.size());
        rays.closest(r, hits);
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (!hits[i]) continue;
            const SidePoint point = pointFacing(scene, hits[i], r[i].direction);
            if (chartAt(field, point) != selected) continue;
            if (objects && objects->rays().occluded({r[i].origin, r[i].direction, 0, hits[i].t}))
                continue;
            const Vec3 p = positionAt(scene, point.triangle, point.barycentric);
            colors[i] = texelColor(field.atlas, chart, p, brightest);
        }
        return count + hits.size();
    };
    return supersample(CameraRays(camera, width, height), width, height, antialias, shade, progress,
                       traced);
}

}  // namespace

std::uint32_t chooseChart(const Scene& scene, const RayScene& rays, const LightField& field,
                          const DiagramParams& params, const Camera& camera) {
    const std::uint32_t chart =
        params.chart ? *params.chart : chartInTheMiddle(scene, rays, field, camera);
    if (chart < field.charts.size()) return chart;
    throw InputError("no chart " + std::to_string(chart) + ": the light field has " +
                     std::to_string(field.charts.size()));
}

float brightestTexel(const IrradianceAtlas& atlas, const Chart& chart) {
    float brightest = 0;
    for (std::uint32_t y = 0; y < chart.height; ++y)
        for (std::uint32_t x = 0; x < chart.width; ++x)
            brightest = std::max(brightest, luminance(atlas.at(chart.x + x, chart.y + y)));
    return brightest;
}

Image drawDiagram(const Scene& scene, const RayScene& rays, const LightField& field,
                  const Camera& camera, int width, int height, int antialias,
                  const DiagramParams& params, Progress& progress, std::uint64_t& traced,
                  const DynamicRoom* objects) {
    const CameraRays requireView(camera, width, height);
    const FieldShader shader(scene, rays, field, MirrorMethod::traced, LookupKind::depthCorrected,
                             objects);
    if (params.kind == DiagramKind::subfield || params.kind == DiagramKind::tile)
        return drawSubfieldDiagram(scene, rays, field, camera, width, height, antialias, params,
                                   progress, traced);
    if (params.kind == DiagramKind::directions) {
        const DirectionSet set(field.record.directions);
        const DimmedRoom room(shader, camera, width, height, progress);
        return drawDirections(room, set, camera, width, height, antialias, progress, traced);
    }
    const std::uint32_t chart = chooseChart(scene, rays, field, params, camera);
    const DimmedRoom room(shader, camera, width, height, progress);
    return drawChart(scene, rays, field, room, chart, camera, width, height, antialias, progress,
                     traced, objects);
}

}  // namespace vlf
