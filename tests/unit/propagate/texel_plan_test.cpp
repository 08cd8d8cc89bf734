#include "vlf/propagate/texel_plan.h"

#include "vlf/base/error.h"
#include "vlf/propagate/fill_atlas.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace vlf::test {

namespace {

constexpr double kBudget = 30000;

/// A room of 4 x 3 x 4 m with a small lamp under its ceiling and a panel that hangs over one corner
/// of the floor.
Scene roomWithPanel() {
    SceneBuilder b;
    b.box(Vec3(0), {4, 3, 4}, true, b.material("wall", Vec3(0.5f)));
    b.quad({1.9f, 2.9f, 1.9f}, {0.2f, 0, 0}, {0, 0, 0.2f}, b.material("lamp", Vec3(0), Vec3(100)));
    b.box({2.6f, 0.6f, 2.6f}, {3.1f, 0.65f, 3.1f}, false, b.material("panel", Vec3(0.5f)));
    return b.scene();
}

BakeParams params(double budget = kBudget) {
    BakeParams p = presetParams("draft");
    p.directSamples = 8;
    p.texelBudget = budget;
    p.radianceDirections = p.glossDirections = 0;
    return p;
}

struct Baked {
    Baked(Scene sceneToBake, const BakeParams& p, bool adaptive) : scene(std::move(sceneToBake)) {
        BakeParams planned = p;
        if (adaptive) planned.pieces = planTexels(scene, p, progress);
        pieces = planned.pieces;
        state.emplace(makeState(scene, planned, progress));
        propagate(*state, progress);
        atlas = fillAtlas(*state);
    }
    Baked(const Baked&) = delete;
    Baked& operator=(const Baked&) = delete;

    /// What is shown on the side of a surface that faces `normal`.
    std::optional<Vec3> irradianceAt(const Vec3& p, const Vec3& normal) const {
        const Hit hit = state->rays.closest({p + 1e-3f * normal, -normal, 0, 2e-3f});
        if (!hit) return std::nullopt;
        const bool front = glm::dot(geometricNormal(scene, hit.triangle), normal) > 0;
        const TriangleCharts& c = state->unwrap.triangleCharts[hit.triangle];
        const Chart& chart = state->unwrap.charts[front ? c.front : c.back];
        return atlas.sample(chart, chart.texelCoordinates(p));
    }

    Progress progress;
    Scene scene;
    TexelPieces pieces;
    std::optional<BakeState> state;
    IrradianceAtlas atlas;
};

/// Relative RMSE of what is shown on the floor.
double floorError(const Baked& baked, const Baked& truth) {
    double squares = 0, light = 0;
    constexpr int kSteps = 400;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const Vec3 p(4 * (i + 0.5f) / kSteps, 0, 4 * (j + 0.5f) / kSteps), up(0, 1, 0);
            const auto shown = baked.irradianceAt(p, up), right = truth.irradianceAt(p, up);
            if (!shown || !right) continue;
            squares += glm::dot(*shown - *right, *shown - *right);
            light += glm::dot(*right, *right);
        }
    return std::sqrt(squares / light);
}

class PlannedRoom : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        even = new Baked(roomWithPanel(), params(), false);
        adaptive = new Baked(roomWithPanel(), params(), true);
    }
    static void TearDownTestSuite() {
        delete even;
        delete adaptive;
    }

    static float scaleAt(const Vec3& floor) {
        const Hit hit = adaptive->state->rays.closest({floor + Vec3(0, 0.1f, 0), {0, -1, 0}});
        return adaptive->pieces[hit.triangle].scale;
    }

    static inline Baked *even = nullptr, *adaptive = nullptr;
};

}  // namespace

TEST_F(PlannedRoom, HasFinerTexelsAtTheShadowAndCoarserOnesElsewhere) {
    ASSERT_FALSE(adaptive->pieces.empty());
    float finest = 2;
    for (float x = 2.4f; x < 3.6f; x += 0.1f) finest = std::min(finest, scaleAt({x, 0, x}));
    EXPECT_LE(finest, 0.5f);
    EXPECT_EQ(scaleAt({0.8f, 0, 2}), 2);
}

TEST_F(PlannedRoom, HasLessErrorOfNoMoreTexels) {
    const std::size_t texels = adaptive->state->unwrap.texels.size();
    EXPECT_LE(texels, 1.05 * static_cast<double>(even->state->unwrap.texels.size()));
    const Baked truth(roomWithPanel(), params(6 * kBudget), false);
    const double before = floorError(*even, truth), after = floorError(*adaptive, truth);
    RecordProperty("even", std::to_string(before));
    RecordProperty("adaptive", std::to_string(after));
    EXPECT_LT(after, 0.6 * before);
}

TEST_F(PlannedRoom, ShowsNoSeamBetweenPieces) {
    const Unwrap& u = adaptive->state->unwrap;
    double worst = 0, steps = 0;
    int crossings = 0;
    for (float z = 0.05f; z < 4; z += 0.1f)
        for (float x = 0.1f; x < 3.9f; x += 0.001f) {
            const Vec3 p(x, 0, z), up(0, 1, 0);
            const Hit a = adaptive->state->rays.closest({p + 1e-3f * up, -up, 0, 2e-3f});
            const Hit b =
                adaptive->state->rays.closest({p + Vec3(0.001f, 0, 0) + 1e-3f * up, -up, 0, 2e-3f});
            if (!a || !b ||
                u.triangleCharts[a.triangle].front == u.triangleCharts[b.triangle].front)
                continue;
            const float left = luminance(*adaptive->irradianceAt(p, up));
            const float right = luminance(*adaptive->irradianceAt(p + Vec3(0.001f, 0, 0), up));
            const double step = std::abs(left - right) / std::max(left, right);
            worst = std::max(worst, step);
            steps += step;
            ++crossings;
        }
    ASSERT_GT(crossings, 20);
    EXPECT_LT(worst, 0.05);
    EXPECT_LT(steps / crossings, 0.01);
}

TEST_F(PlannedRoom, TellsItsTexelsByTheirSize) {
    std::size_t sum = 0;
    for (const BakeReport::TexelScale& s : adaptive->state->report.texelScales) sum += s.texels;
    EXPECT_EQ(sum, adaptive->state->unwrap.texels.size());
    EXPECT_GE(adaptive->state->report.texelScales.size(), 3u);
    ASSERT_EQ(even->state->report.texelScales.size(), 1u);
    EXPECT_EQ(even->state->report.texelScales[0].scale, 1);
}

TEST(TexelPlan, OfAFurnaceIsEven) {
    Scene scene = furnaceBox(Vec3(0.5f), Vec3(1));
    const std::size_t triangles = scene.triangles.size();
    Progress progress;
    EXPECT_TRUE(planTexels(scene, params(), progress).empty());
    EXPECT_EQ(scene.triangles.size(), triangles);
}

TEST(TexelPlan, OfADarkSceneIsEven) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1), true, b.material("wall", Vec3(0.5f)));
    Scene scene = b.scene();
    Progress progress;
    EXPECT_TRUE(planTexels(scene, params(), progress).empty());
}

TEST(TexelPlan, IsCancelledWithTheBake) {
    Scene scene = roomWithPanel();
    Progress progress;
    progress.cancel();
    EXPECT_THROW(planTexels(scene, params(), progress), Cancelled);
}

TEST(TexelPlan, DoesNotWaitForAPauseThatNobodyTakes) {
    struct AlwaysDue : Progress {
        bool pauseDue() const override { return true; }
    } progress;
    Scene scene = roomWithPanel();
    EXPECT_FALSE(planTexels(scene, params(), progress).empty());
}

TEST(TexelPieces, LeaveAWhiteFurnaceExact) {
    Scene scene = furnaceBox(Vec3(0.5f), Vec3(1));
    BakeParams p = params(2000);
    p.cells = p.coarseCells = 128;
    p.tolerance = 1e-6;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        p.pieces.push_back({t / 2, t / 2 % 3 == 0 ? 0.25f : t / 2 % 3 == 1 ? 1.0f : 2.0f});
    Progress progress;
    BakeState state = makeState(scene, p, progress);
    propagate(state, progress);
    double flux = 0, area = 0;
    for (std::size_t i = 0; i < state.irradiance.size(); ++i) {
        const double e = luminance(state.irradiance[i]) / (2 * kPi);
        EXPECT_NEAR(e, 1, 5e-3);  // of a texel of a few samples
        flux += e * state.unwrap.texelArea(i);
        area += state.unwrap.texelArea(i);
    }
    EXPECT_NEAR(flux / area, 1, 1e-4);
}

TEST(TexelPieces, OfAnotherSceneAreRefused) {
    const Scene scene = furnaceBox(Vec3(0.5f), Vec3(1));
    BakeParams p = params(1000);
    p.pieces.resize(3);
    Progress progress;
    EXPECT_THROW(makeState(scene, p, progress), InputError);
}

}  // namespace vlf::test
