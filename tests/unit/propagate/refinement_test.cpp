// The estimated error against the true one, and refinement towards it.

#include "vlf/propagate/refinement.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/propagate/bake.h"
#include "vlf/propagate/error_estimate.h"
#include "vlf/scene/generate/generate.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>

namespace vlf::test {

namespace {

BakeParams cheap(double texels) {
    BakeParams p = presetParams("draft");
    p.texelBudget = texels;
    p.cells = 64;
    p.coarseCells = 64;
    p.radianceDirections = 0;
    p.glossDirections = 0;
    return p;
}

/// The same texels, a dozen times more exact.
BakeParams exact(BakeParams p) {
    p.directions = 8193;
    p.directSamples = 96;
    p.tolerance = 3e-4;
    p.settlingSweeps = 8;
    return p;
}

struct Solved {
    Solved(const Scene& sceneToSolve, const BakeParams& params)
        : scene(sceneToSolve), state(makeState(scene, params, progress)) {
        propagate(state, progress);
    }
    ErrorReport estimate() const { return reportError(state, estimateError(state)); }

    Scene scene;
    Progress progress;
    BakeState state;
};

/// Relative RMSE of what `value(state, texel)` tells, to all light of the truth.
template <class Value>
double trueError(const BakeState& state, const BakeState& truth, Value value) {
    EXPECT_EQ(state.unwrap.texels.size(), truth.unwrap.texels.size());
    double error = 0, light = 0;
    for (std::size_t i = 0; i < state.irradiance.size(); ++i) {
        if (maxComponent(state.reflectance[i]) <= 0) continue;
        const double area = state.unwrap.texelArea(i);
        const Vec3 difference = value(state, i) - value(truth, i);
        error += area * glm::dot(difference, difference);
        light += area * glm::dot(truth.irradiance[i], truth.irradiance[i]);
    }
    return std::sqrt(error / light);
}

double trueError(const BakeState& state, const BakeState& truth) {
    return trueError(state, truth,
                     [](const BakeState& s, std::size_t i) { return s.irradiance[i]; });
}

double trueErrorOfDirect(const BakeState& state, const BakeState& truth) {
    return trueError(state, truth,
                     [](const BakeState& s, std::size_t i) { return s.directIrradiance[i]; });
}

double trueErrorOfIndirect(const BakeState& state, const BakeState& truth) {
    return trueError(state, truth, [](const BakeState& s, std::size_t i) {
        return s.irradiance[i] - s.directIrradiance[i];
    });
}

void expectNear(double estimate, double truth) {
    EXPECT_LT(estimate, 1.5 * truth);
    EXPECT_GT(1.5 * estimate, truth);
}

Scene smallMirrorRoom() {
    SceneOptions options;
    options.triangles = 1000;
    return generateScene("mirror-room", options);
}

LightField baked(const Scene& scene, const BakeParams& params, BakeReport* report = nullptr) {
    Progress progress;
    return bake(scene, params, progress, report);
}

bool sameLight(const LightField& a, const LightField& b) {
    return a.atlas.irradiance.size() == b.atlas.irradiance.size() &&
           std::memcmp(a.atlas.irradiance.data(), b.atlas.irradiance.data(),
                       a.atlas.irradiance.size() * sizeof(Vec3)) == 0;
}

std::string refusal(const Scene& scene, const BakeParams& params) {
    try {
        baked(scene, params);
    } catch (const InputError& e) {
        return e.what();
    }
    return {};
}

}  // namespace

TEST(ErrorEstimate, IsNearTheTrueErrorOfCornell) {
    const Scene scene = generateScene("cornell");
    const Solved s(scene, cheap(6000)), truth(scene, exact(cheap(6000)));
    expectNear(s.estimate().ofTexels(), trueError(s.state, truth.state));
}

TEST(ErrorEstimate, IsNearTheTrueErrorOfARoomWithAMirror) {
    const Scene scene = smallMirrorRoom();
    const Solved s(scene, cheap(6000)), truth(scene, exact(cheap(6000)));
    expectNear(s.estimate().ofTexels(), trueError(s.state, truth.state));
}

TEST(ErrorEstimate, OfInterpolationIsNearWhatFinerTexelsTell) {
    const Scene scene = generateScene("cornell");
    Solved s(scene, exact(cheap(4000)));
    BakeParams fine = exact(cheap(64000));
    fine.directions = 2049;
    fine.cells = 256;
    const Solved truth(scene, fine);
    const LightField field = finish(s.state, s.progress);
    const Unwrap &u = s.state.unwrap, &v = truth.state.unwrap;
    double error = 0, light = 0;
    for (std::size_t i = 0; i < v.texels.size(); ++i) {
        const SurfacePoint& p = v.points.of(i)[v.points.of(i).size() / 2];
        const bool front = v.triangleCharts[p.triangle].front == v.texelChart[i];
        const TriangleCharts& charts = u.triangleCharts[p.triangle];
        const Chart& chart = u.charts[front ? charts.front : charts.back];
        const Vec3 at = positionAt(scene, p.triangle, p.barycentric);
        const Vec3 d =
            field.atlas.sample(chart, chart.texelCoordinates(at)) - truth.state.irradiance[i];
        if (maxComponent(truth.state.reflectance[i]) <= 0) continue;
        error += v.texelArea(i) * glm::dot(d, d);
        light += v.texelArea(i) * glm::dot(truth.state.irradiance[i], truth.state.irradiance[i]);
    }
    expectNear(s.estimate().interpolated(), std::sqrt(error / light));
}

TEST(ErrorEstimate, OfALitTexelIsNeverNone) {
    // Where light is even, second differences less noise are below zero as often as above.
    const Solved s(generateScene("cornell"), cheap(6000));
    const ErrorEstimate e = estimateError(s.state);
    for (std::size_t i = 0; i < e.total.size(); ++i) {
        if (maxComponent(s.state.irradiance[i]) <= 0) continue;
        ASSERT_GT(e.total[i], 0) << "texel " << i;
    }
}

TEST(ErrorEstimate, OfIndirectLightFallsWithTheSweepsAsTheTrueOneDoes) {
    const Scene scene = generateScene("cornell");
    const Solved truth(scene, exact(cheap(3000)));
    const auto square = [](double x) { return x * x; };
    // Means of squares: all texels share directions, so that one sweep tells little.
    double one = 0, four = 0, trueOne = 0, trueFour = 0;
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
        BakeParams p = cheap(3000);
        p.refinements = 1;
        p.seed = seed;
        Progress progress;
        Solved s(scene, p);
        // The accumulators are given up at the end: four sweeps anew, each on top of the last.
        s.state.refinement = {};
        refineOnce(s.state, 513, progress);
        one += square(s.estimate().indirect);
        trueOne += square(trueErrorOfIndirect(s.state, truth.state));
        for (int i = 0; i < 3; ++i) refineOnce(s.state, 513, progress);
        four += square(s.estimate().indirect);
        trueFour += square(trueErrorOfIndirect(s.state, truth.state));
        EXPECT_EQ(s.state.refinement.sweptLines, 4u * 513);
    }
    EXPECT_LT(four, 0.5 * one);
    EXPECT_NEAR(std::sqrt(four / one), std::sqrt(trueFour / trueOne), 0.1);
}

TEST(ErrorEstimate, OfDirectLightFallsWithItsSamples) {
    const Scene scene = generateScene("cornell");
    BakeParams few = cheap(3000), many = few;
    many.directSamples = 16 * few.directSamples;
    const Solved a(scene, few), b(scene, many), truth(scene, exact(few));
    const double fallen = b.estimate().direct / a.estimate().direct;
    EXPECT_LT(fallen, 0.25);
    expectNear(fallen,
               trueErrorOfDirect(b.state, truth.state) / trueErrorOfDirect(a.state, truth.state));
}

TEST(ErrorEstimate, OfNoLightIsNone) {
    SceneBuilder b;
    b.box(Vec3(-1), Vec3(1), true, b.material("wall", Vec3(0.5f)));
    const Solved s(b.scene(), cheap(500));
    EXPECT_EQ(s.estimate().interpolated(), 0);
    for (const float e : relativeErrors(s.state, estimateError(s.state))) EXPECT_EQ(e, 0);
}

TEST(DirectAllocation, ReachesItsTargetWithFewerSamplesThanEvenOnes) {
    const Scene scene = generateScene("cornell");
    const RayScene rays(scene);
    const Unwrap unwrap = vlf::unwrap(scene, rays, {.texelBudget = 4000});
    const LightSources sources = findLightSources(scene, unwrap);
    const DirectLightParams params{2, 1};
    Progress progress;
    DirectLight light;
    findDirectLight(scene, rays, unwrap, sources, params, light, progress);
    std::vector<float> areas(unwrap.texels.size());
    for (std::size_t i = 0; i < areas.size(); ++i) areas[i] = unwrap.texelArea(i);
    const auto square = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < areas.size(); ++i)
            sum += double{areas[i]} * light.estimates[i].squareError();
        return sum;
    };
    const auto samples = [&] {
        return std::accumulate(light.estimates.begin(), light.estimates.end(), 0.0,
                               [](double sum, const DirectEstimate& e) { return sum + e.samples; });
    };
    const double before = square(), samplesBefore = samples(), target = before / 8;
    refineDirectLight(scene, rays, unwrap, sources, params, areas, target, light, progress);
    EXPECT_LT(square(), 1.2 * target);
    EXPECT_LT(samples(), 8 * samplesBefore);
}

TEST(Refinement, EndsAtTheErrorAskedFor) {
    const Scene scene = generateScene("cornell");
    const Solved truth(scene, exact(cheap(6000)));
    for (const double error : {0.005, 0.0025}) {
        const BakeParams p = refiningParams(cheap(6000), error);
        const Solved s(scene, p);
        EXPECT_LE(s.estimate().ofTexels(), error);
        EXPECT_LT(trueError(s.state, truth.state), 1.5 * error);
        EXPECT_GT(s.estimate().ofTexels(), 0.4 * error) << "more than was asked for";
    }
}

TEST(Refinement, OfSoManyStepsIsTheSameAgainForAnyNumberOfThreads) {
    const Scene scene = smallCornell();
    BakeParams p = refiningParams(cheap(2000), 0);
    p.refinements = 6;
    BakeReport report;
    const LightField whole = baked(scene, p, &report);
    EXPECT_EQ(report.refinements, 6);
    const ThreadLimit limit(1);
    EXPECT_TRUE(sameLight(whole, baked(scene, p)));
}

TEST(Refinement, InTimeIsRepeatedByItsSteps) {
    const Scene scene = smallCornell();
    BakeParams p = refiningParams(cheap(2000), 0);
    BakeReport report;
    LightField inTime;
    // Slow machines take longer to the second step.
    for (p.seconds = 2; report.refinements <= 1 && p.seconds < 100; p.seconds *= 4)
        inTime = baked(scene, p, &report);
    ASSERT_GT(report.refinements, 1);
    p.seconds = 0;
    p.refinements = report.refinements;
    EXPECT_TRUE(sameLight(inTime, baked(scene, p)));
}

TEST(Refinement, OfAnErrorOutOfReachSaysWhatToChange) {
    const BakeParams p = refiningParams(cheap(1000), 1e-5);
    EXPECT_NE(refusal(smallCornell(), p).find("--texel"), std::string::npos);
}

TEST(Refinement, RefusesWhatNeverEnds) {
    BakeParams p = cheap(1000);
    p.error = -0.01;
    EXPECT_THROW(baked(smallCornell(), p), InputError);
}

TEST(DirectEstimate, OfNextToNoLightHasAFiniteError) {
    const DirectEstimate dark{.value = Vec3(1e-30f), .evenVariance = 1e-12f};
    EXPECT_TRUE(std::isfinite(dark.squareError()));
}

}  // namespace vlf::test
