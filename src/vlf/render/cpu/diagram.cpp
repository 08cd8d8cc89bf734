#include "vlf/render/cpu/diagram.h"

#include "vlf/base/error.h"
#include "vlf/field/direction_set.h"
#include "vlf/image/heat_map.h"
#include "vlf/image/tone_map.h"
#include "vlf/render/cpu/field_shader.h"
#include "vlf/render/cpu/subfield_diagram.h"
#include "vlf/render/cpu/supersample.h"
#include "vlf/render/cpu/wireframe.h"

#include <algorithm>
#include <string>
#include <vector>

namespace vlf {

namespace {

constexpr float kDimmed = 0.3f;

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
            [&](std::span<const Ray> r, std::span<Vec3> seen) { return shader.radiance(r, seen); },
            progress, ignored);
        gain_ = std::exp2(autoExposure(preview));
    }

    std::uint64_t shade(std::span<const Ray> rays, std::span<Vec3> colors) const {
        const std::uint64_t traced = shader_.radiance(rays, colors);
        for (Vec3& c : colors) c = kDimmed * toneMap(gain_ * c, ToneCurve::filmic);
        return traced;
    }

  private:
    const FieldShader& shader_;
    float gain_ = 1;
};

struct Ball {
    Vec3 centre{0};
    float radius = 1;

    /// Unit vector from the centre to where a unit-length ray first meets the ball.
    std::optional<Vec3> meet(const Ray& ray) const {
        const Vec3 toCentre = centre - ray.origin;
        const float along = glm::dot(toCentre, ray.direction);
        const float gap2 = glm::dot(toCentre, toCentre) - along * along;
        if (along < 0 || gap2 > radius * radius) return std::nullopt;
        const float t = along - std::sqrt(radius * radius - gap2);
        return (ray.origin + t * ray.direction - centre) / radius;
    }
};

/// In the middle of the picture, three quarters of its smaller side wide.
Ball ballBefore(const Camera& camera, int width, int height) {
    const float tangent = std::tan(0.5f * camera.verticalFov * (kPi / 180)) *
                          std::min(1.0f, static_cast<float>(width) / height);
    const float sine = std::sin(std::atan(0.75f * tangent));
    return {camera.eye + glm::normalize(camera.look - camera.eye), sine};
}

/// White at the mean solid angle, blue below and red above, full at a tenth off the mean.
Vec3 weightColor(float relativeToMean) {
    const float t = std::clamp((relativeToMean - 1) / 0.1f, -1.0f, 1.0f);
    const Vec3 end = t < 0 ? Vec3(0.03f, 0.14f, 0.6f) : Vec3(0.6f, 0.05f, 0.03f);
    return glm::mix(Vec3(0.85f), end, std::abs(t));
}

Vec3 directionColor(const DirectionSet& set, const Vec3& d) {
    const float mean = 4 * kPi / static_cast<float>(set.directionCount());
    const std::uint32_t nearest = set.nearest(d);
    const float offCentre = glm::distance(d, set.direction(nearest)) / std::sqrt(mean);
    if (offCentre < 0.11f)
        return nearest < static_cast<std::uint32_t>(set.lineCount()) ? kInk : Vec3(0.35f);
    const Vec3 weights = set.triple(d).weight;
    const Vec3 cell = weightColor(set.weight(nearest) / mean);
    return std::min({weights.x, weights.y, weights.z}) < 0.025f ? 0.3f * cell : cell;
}

Image drawDirections(const DimmedRoom& room, const DirectionSet& set, const Camera& camera,
                     int width, int height, int antialias, Progress& progress,
                     std::uint64_t& traced) {
    const Ball ball = ballBefore(camera, width, height);
    const auto shade = [&](std::span<const Ray> rays, std::span<Vec3> colors) {
        const std::uint64_t count = room.shade(rays, colors);
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (const std::optional<Vec3> d = ball.meet(rays[i]))
                colors[i] =
                    directionColor(set, *d) * (0.4f - 0.6f * glm::dot(*d, rays[i].direction));
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

/// Luminance of the brightest texel of a chart.
float brightestTexel(const IrradianceAtlas& atlas, const Chart& chart) {
    float brightest = 0;
    for (std::uint32_t y = 0; y < chart.height; ++y)
        for (std::uint32_t x = 0; x < chart.width; ++x)
            brightest = std::max(brightest, luminance(atlas.at(chart.x + x, chart.y + y)));
    return brightest;
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
    return toRim < 0.05f ? 0.35f * color + 0.03f : color;
}

Image drawChart(const Scene& scene, const RayScene& rays, const LightField& field,
                const DimmedRoom& room, std::uint32_t selected, const Camera& camera, int width,
                int height, int antialias, Progress& progress, std::uint64_t& traced) {
    const Chart& chart = field.charts[selected];
    const float brightest = brightestTexel(field.atlas, chart);
    const auto shade = [&](std::span<const Ray> r, std::span<Vec3> colors) {
        const std::uint64_t count = room.shade(r, colors);
        std::vector<Hit> hits(r.size());
        rays.closest(r, hits);
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (!hits[i]) continue;
            const SidePoint point = pointFacing(scene, hits[i], r[i].direction);
            if (chartAt(field, point) != selected) continue;
            const Vec3 p = positionAt(scene, point.triangle, point.barycentric);
            colors[i] = texelColor(field.atlas, chart, p, brightest);
        }
        return count + hits.size();
    };
    return supersample(CameraRays(camera, width, height), width, height, antialias, shade, progress,
                       traced);
}

}  // namespace

Image drawDiagram(const Scene& scene, const RayScene& rays, const LightField& field,
                  const Camera& camera, int width, int height, int antialias,
                  const DiagramParams& params, Progress& progress, std::uint64_t& traced) {
    const CameraRays requireView(camera, width, height);
    const FieldShader shader(scene, rays, field);
    if (params.kind == DiagramKind::subfield || params.kind == DiagramKind::tile)
        return drawSubfieldDiagram(scene, rays, field, camera, width, height, antialias, params,
                                   progress, traced);
    if (params.kind == DiagramKind::directions) {
        const DirectionSet set(field.record.directions);
        const DimmedRoom room(shader, camera, width, height, progress);
        return drawDirections(room, set, camera, width, height, antialias, progress, traced);
    }
    const std::uint32_t chart =
        params.chart ? *params.chart : chartInTheMiddle(scene, rays, field, camera);
    if (chart >= field.charts.size())
        throw InputError("no chart " + std::to_string(chart) + ": the light field has " +
                         std::to_string(field.charts.size()));
    const DimmedRoom room(shader, camera, width, height, progress);
    return drawChart(scene, rays, field, room, chart, camera, width, height, antialias, progress,
                     traced);
}

}  // namespace vlf
