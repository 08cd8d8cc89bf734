#include "vlf/render/cpu/texel_picture.h"

#include "vlf/base/parallel.h"
#include "vlf/image/heat_map.h"
#include "vlf/render/cpu/camera_rays.h"
#include "vlf/render/cpu/field_shader.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace vlf {

namespace {

constexpr Vec3 kNothing(0.2f);  // linear grey
constexpr Vec3 kEdge(0.35f);

/// What a pixel shows.
struct Seen {
    std::uint32_t chart = kNoChart;
    std::size_t texel = 0;
};

Seen seenBy(const Ray& ray, const Scene& scene, const RayScene& rays, const LightField& field) {
    const Hit hit = rays.closest(ray);
    if (!hit) return {};
    const bool front = glm::dot(geometricNormal(scene, hit.triangle), ray.direction) < 0;
    const std::uint32_t c = chartAt(field, {hit.triangle, hit.barycentric, front});
    if (c == kNoChart) return {};
    const Chart& chart = field.charts[c];
    const Vec2 at = chart.texelCoordinates(positionAt(scene, hit.triangle, hit.barycentric));
    const auto within = [](float coordinate, std::uint32_t count) {
        return static_cast<std::uint32_t>(
            std::clamp(coordinate, 0.0f, static_cast<float>(count) - 0.5f));
    };
    return {c, field.atlas.index(chart.x + within(at.x, chart.width),
                                 chart.y + within(at.y, chart.height))};
}

}  // namespace

Image drawTexelValues(const Scene& scene, const RayScene& rays, const LightField& field,
                      std::span<const float> values, float least, float most, const Camera& camera,
                      int width, int height, Progress& progress) {
    if (values.size() != field.atlas.irradiance.size() || !(least > 0) || !(least < most))
        throw std::logic_error("drawTexelValues needs one value per texel, and a scale");
    const CameraRays view(camera, width, height);
    std::vector<Seen> seen(static_cast<std::size_t>(width) * height);
    ProgressCounter counter(progress, static_cast<std::size_t>(height));
    parallelFor(static_cast<std::size_t>(height), [&](std::size_t y) {
        for (int x = 0; x < width; ++x)
            seen[y * width + x] = seenBy(view.ray(x + 0.5f, y + 0.5f), scene, rays, field);
        counter.step();
    });
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * width + x;
            const bool edge = (x + 1 < width && seen[i + 1].chart != seen[i].chart) ||
                              (y + 1 < height && seen[i + width].chart != seen[i].chart);
            const float value = std::max(values[seen[i].texel], least);
            const float t = std::log(value / least) / std::log(most / least);
            image.at(x, y) = edge ? kEdge : seen[i].chart == kNoChart ? kNothing : heatColor(t);
        }
    return image;
}

}  // namespace vlf
