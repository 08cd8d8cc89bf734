#include "vlf/propagate/error_estimate.h"

#include "vlf/base/parallel.h"
#include "vlf/propagate/bake.h"
#include "vlf/propagate/texel_neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf {

namespace {

constexpr std::size_t kBlock = 1024;

// Mean square of what bilinear interpolation misses, to the sum of the squared second differences
// along both axes: 0.017 where light bends evenly, 0.09 at an edge of shadow, which is what counts.
// As it fits cornell and two-rooms (bench/texel_table).
constexpr float kBend = 0.1f;

// Light that is lost or won where texels are too large for it, to what interpolation misses;
// measured.
constexpr double kLost = 0.06;

constexpr double kDark = 0.1;  // of the room's light, to which errors of darker texels are held

float squared(const Vec3& v) {
    return glm::dot(v, v);
}

bool scatters(const BakeState& state, std::size_t i) {
    return maxComponent(state.reflectance[i]) > 0;
}

/// Of the texels that scatter.
struct RoomLight {
    double squares = 0, area = 0;  // of irradiance, times area
};

RoomLight lightOf(const BakeState& state) {
    RoomLight light;
    for (std::size_t i = 0; i < state.irradiance.size(); ++i) {
        if (!scatters(state, i)) continue;
        const double area = state.unwrap.texelArea(i);
        light.squares += area * squared(state.irradiance[i]);
        light.area += area;
    }
    return light;
}

/// Second differences of irradiance along the chart's axes, less what is noise of them.
float bend(const BakeState& state, const TexelNeighbours& neighbours,
           const std::vector<float>& noise, std::size_t i) {
    constexpr std::array<std::array<int, 2>, 2> kAxes{{{1, 0}, {0, 1}}};
    const std::vector<Vec3>& e = state.irradiance;
    float sum = 0;
    for (const auto& [dx, dy] : kAxes) {
        const std::uint32_t a = neighbours.beside(i, dx, dy), b = neighbours.beside(i, -dx, -dy);
        if (a == TexelNeighbours::kNone || b == TexelNeighbours::kNone) continue;
        sum += squared(e[a] + e[b] - 2.0f * e[i]) - (noise[a] + noise[b] + 4 * noise[i]);
    }
    return sum;
}

/// Means over the texel and its neighbours, not below 0.
std::vector<float> smoothed(const std::vector<float>& values, const TexelNeighbours& neighbours) {
    std::vector<float> result(values.size());
    parallelFor(values.size(), kBlock, [&](std::size_t i) {
        float sum = 0, count = 0;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const std::uint32_t n = neighbours.beside(i, dx, dy);
                    n != TexelNeighbours::kNone) {
                    sum += values[n];
                    count += 1;
                }
        result[i] = std::max(0.0f, sum / count);
    });
    return result;
}

}  // namespace

double ErrorReport::ofTexels() const {
    return std::sqrt(direct * direct + indirect * indirect + missing * missing);
}

double ErrorReport::interpolated() const {
    return std::hypot(ofTexels(), texelSize);
}

ErrorEstimate estimateError(const BakeState& state) {
    const std::size_t texels = state.irradiance.size();
    ErrorEstimate e;
    if (state.indirectVariance.size() != texels) return e;
    const double coarse = kCoarseSweepNoise / std::sqrt(std::max(1, state.params.settlingSweeps));
    const auto missing =
        static_cast<float>(state.report.residual * state.report.residual + coarse * coarse);
    e.direct.resize(texels);
    e.missing.resize(texels);
    e.texelSize.resize(texels);
    e.indirect = state.indirectVariance;
    std::vector<float> noise(texels);
    for (std::size_t i = 0; i < texels; ++i) {
        e.direct[i] = state.directVariance[i];
        e.missing[i] = missing * squared(state.irradiance[i]);
        noise[i] = e.direct[i] + e.indirect[i];
    }
    const TexelNeighbours neighbours(state.unwrap);
    parallelFor(texels, kBlock,
                [&](std::size_t i) { e.texelSize[i] = kBend * bend(state, neighbours, noise, i); });
    for (std::size_t i = 0; i < texels; ++i) noise[i] += e.missing[i];
    e.total = smoothed(noise, neighbours);
    // Noise that neighbours share bends less than it is taken to: that is no less noise.
    const std::vector<float> texelSize = smoothed(e.texelSize, neighbours);
    for (std::size_t i = 0; i < texels; ++i) e.total[i] += texelSize[i];
    return e;
}

ErrorReport reportError(const BakeState& state, const ErrorEstimate& estimate) {
    const double squares = lightOf(state).squares;
    if (squares <= 0) return {};
    const auto relative = [&](const std::vector<float>& values) {
        double sum = 0;
        for (std::size_t i = 0; i < values.size(); ++i)
            if (scatters(state, i)) sum += double{state.unwrap.texelArea(i)} * values[i];
        return std::sqrt(std::max(0.0, sum) / squares);
    };
    const double texelSize = relative(estimate.texelSize);
    return {relative(estimate.direct), relative(estimate.indirect),
            std::hypot(relative(estimate.missing), kLost * texelSize), texelSize};
}

std::vector<float> relativeErrors(const BakeState& state, const ErrorEstimate& estimate) {
    std::vector<float> errors(state.unwrap.atlasSize(), 0);
    const RoomLight light = lightOf(state);
    if (light.squares <= 0) return errors;
    const auto dark = static_cast<float>(kDark * kDark * light.squares / light.area);
    for (std::size_t i = 0; i < estimate.total.size(); ++i)
        errors[state.unwrap.texels[i]] =
            std::sqrt(estimate.total[i] / std::max(squared(state.irradiance[i]), dark));
    return errors;
}

}  // namespace vlf
