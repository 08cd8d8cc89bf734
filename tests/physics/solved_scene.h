#pragma once
// A scene whose light has been solved, at settings that are quick rather than fine.

#include "vlf/propagate/bake.h"

#include <utility>

namespace vlf::test {

inline BakeParams quickParams(double texels) {
    BakeParams p = presetParams("draft");
    p.texelBudget = texels;
    p.radianceDirections = 0;
    return p;
}

struct SolvedScene {
    SolvedScene(Scene sceneToSolve, const BakeParams& params)
        : scene(std::move(sceneToSolve)), state(makeState(scene, params, progress)) {
        propagate(state, progress);
        field = finish(state, progress);
    }
    SolvedScene(const SolvedScene&) = delete;
    SolvedScene& operator=(const SolvedScene&) = delete;

    Vec3 centre(std::size_t texel) const {
        const auto points = state.unwrap.points.of(texel);
        Vec3 sum(0);
        for (const SurfacePoint& p : points) sum += positionAt(scene, p.triangle, p.barycentric);
        return sum / static_cast<float>(points.size());
    }

    /// Mean luminance of the irradiance over the texels that `wanted(texel)` picks, by area.
    template <class Wanted>
    double meanIrradiance(Wanted wanted) const {
        double sum = 0, area = 0;
        for (std::size_t i = 0; i < state.irradiance.size(); ++i) {
            if (!wanted(i)) continue;
            const double a = state.unwrap.texelArea(i);
            sum += a * luminance(state.irradiance[i]);
            area += a;
        }
        return sum / area;
    }
    /// The same over the front of a triangle's chart.
    double meanIrradianceOfChart(std::uint32_t triangle) const {
        const std::uint32_t chart = state.unwrap.triangleCharts[triangle].front;
        return meanIrradiance([&](std::size_t i) { return state.unwrap.texelChart[i] == chart; });
    }

    Scene scene;
    Progress progress;
    BakeState state;
    LightField field;
};

}  // namespace vlf::test
