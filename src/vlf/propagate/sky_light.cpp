#include "vlf/propagate/sky_light.h"

#include "vlf/base/parallel.h"
#include "vlf/math/random.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

namespace vlf {

namespace {

constexpr int kGridWidth = 512, kGridHeight = 256;
constexpr float kLeastShare = 0.02f;  // of the flux that a normal may get unnoticed by the shares

/// Solid angle of the cells of a row.
double cellAngle(const Sky::Grid& grid, std::size_t row) {
    const double step = std::numbers::pi / grid.height;
    const double from = static_cast<double>(row) * step;
    return 2 * std::numbers::pi / grid.width * (std::cos(from) - std::cos(from + step));
}

Vec3 meanOf(const Sky::Grid& grid) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < grid.radiance.size(); ++i)
        sum += cellAngle(grid, i / static_cast<std::size_t>(grid.width)) *
               glm::dvec3(grid.radiance[i]);
    return Vec3(sum / (4 * std::numbers::pi));
}

}  // namespace

float SkyLight::irradiance(const Vec3& normal) const {
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    if (cosine > 0 && glm::dot(normal, axis) < -sine) return 0;
    float sum = 0;
    for (const Vec3& share : shares) sum += std::max(0.0f, glm::dot(normal, share));
    return flux * std::max(sum / kShares, kLeastShare);
}

SkyLight makeSkyLight(const Environment& environment) {
    SkyLight light;
    if (environment.isBlack()) return light;
    light.sky = Sky(environment, smoothCap(environment));
    light.smooth = light.sky.smoothGrid(kGridWidth, kGridHeight);
    light.smoothMean = environment.isUniform() ? environment.radiance : meanOf(light.smooth);
    if (!light.sky.hasBright()) return light;
    Vec3 sum(0);
    for (std::size_t i = 0; i < light.shares.size(); ++i) {
        light.shares[i] =
            light.sky.sample(r2Point(static_cast<std::uint32_t>(i), Vec2(0.5f))).direction;
        sum += light.shares[i];
    }
    light.flux = luminance(light.sky.brightFlux());
    const float length = glm::length(sum);
    if (length > 0) light.axis = sum / length;
    light.cosine = light.sky.brightCosine(light.axis);
    return light;
}

std::vector<Vec3> outsideViews(const SkyLight& light, const DirectionSet& directions,
                               const Mat3& turn) {
    const auto count = static_cast<std::size_t>(directions.directionCount());
    std::vector<Vec3> views(count, light.smoothMean);
    const Sky::Grid& grid = light.smooth;
    if (grid.radiance.empty() || light.sky.isBlack()) return views;
    const auto width = static_cast<std::size_t>(grid.width);
    const Mat3 back = glm::transpose(turn);
    std::vector<std::uint32_t> nearest(grid.radiance.size());
    parallelFor(static_cast<std::size_t>(grid.height), 8, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            const Vec2 place((static_cast<float>(x) + 0.5f) / static_cast<float>(grid.width),
                             (static_cast<float>(y) + 0.5f) / static_cast<float>(grid.height));
            nearest[y * width + x] =
                directions.nearest(glm::normalize(back * light.sky.direction(place)));
        }
    });
    std::vector<glm::dvec3> sums(count, glm::dvec3(0));
    for (std::size_t i = 0; i < nearest.size(); ++i)
        sums[nearest[i]] += cellAngle(grid, i / width) *
                            (glm::dvec3(grid.radiance[i]) - glm::dvec3(light.smoothMean));
    const double mean = 4 * std::numbers::pi / static_cast<double>(count);
    for (std::size_t d = 0; d < count; ++d)
        views[d] = glm::max(light.smoothMean + Vec3(sums[d] / mean), Vec3(0));
    return views;
}

}  // namespace vlf
