// Parameters, convergence, reports and the memory a bake needs.

#include "vlf/propagate/bake.h"

#include "vlf/base/error.h"
#include "vlf/propagate/memory.h"
#include "vlf/propagate/radiance_bake.h"
#include "vlf/scene/generate/generate.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <limits>

namespace vlf::test {

namespace {

BakeParams quick() {
    BakeParams p = presetParams("draft");
    p.texelBudget = 3000;
    p.cells = 64;
    p.coarseCells = 64;
    p.radianceDirections = 0;
    return p;
}

LightField bakeQuick(const Scene& scene, const BakeParams& params, BakeReport* report = nullptr) {
    Progress progress;
    return bake(scene, params, progress, report);
}

void expectRefused(void (*change)(BakeParams&)) {
    BakeParams p = quick();
    change(p);
    EXPECT_THROW(bakeQuick(smallCornell(), p), InputError);
}

std::string memoryAdvice(const Scene& scene, const BakeParams& params, std::uint64_t bytes) {
    try {
        requireMemory(scene, params, bytes);
    } catch (const InputError& e) {
        return e.what();
    }
    return {};
}

}  // namespace

TEST(PresetParams, RiseInQuality) {
    const BakeParams draft = presetParams("draft"), standard = presetParams("standard"),
                     high = presetParams("high");
    EXPECT_LT(draft.directions, standard.directions);
    EXPECT_LT(standard.directions, high.directions);
    EXPECT_LT(draft.texelBudget, standard.texelBudget);
    EXPECT_LT(standard.texelBudget, high.texelBudget);
    EXPECT_GT(draft.tolerance, standard.tolerance);
    EXPECT_GT(standard.tolerance, high.tolerance);
    EXPECT_EQ(draft.preset, "draft");
}

TEST(PresetParams, RefuseAnUnknownNameAndSayWhichThereAre) {
    try {
        presetParams("best");
        FAIL() << "no exception";
    } catch (const InputError& e) {
        const std::string what = e.what();
        for (const char* word : {"best", "draft", "standard", "high"})
            EXPECT_NE(what.find(word), std::string::npos) << what;
    }
}

TEST(Bake, RefusesParametersOutOfRange) {
    expectRefused([](BakeParams& p) { p.cells = 15; });
    expectRefused([](BakeParams& p) { p.cells = 8193; });
    expectRefused([](BakeParams& p) { p.cells = -1; });
    expectRefused([](BakeParams& p) { p.directions = 100; });
    expectRefused([](BakeParams& p) { p.directions = 0; });
    expectRefused([](BakeParams& p) { p.directSamples = 0; });
    expectRefused([](BakeParams& p) { p.texelSize = -1; });
    expectRefused([](BakeParams& p) { p.texelSize = 1e-9f; });
}

TEST(Bake, StopsAfterTheBouncesAskedFor) {
    BakeParams p = quick();
    p.maxBounces = 3;
    BakeReport report;
    const LightField field = bakeQuick(smallCornell(), p, &report);
    EXPECT_EQ(report.sweeps, 4);  // and the fine one
    EXPECT_EQ(field.record.bounces, 4);
}

TEST(Bake, ConvergesToItsTolerance) {
    for (const double tolerance : {1e-2, 1e-3}) {
        BakeParams p = quick();
        p.tolerance = tolerance;
        BakeReport report;
        bakeQuick(smallCornell(), p, &report);
        EXPECT_LT(report.residual, tolerance);
        EXPECT_LT(report.sweeps, 100);
    }
}

TEST(Bake, RecordsHowItWasMade) {
    BakeParams p = quick();
    p.seed = 42;
    BakeReport report;
    const LightField field = bakeQuick(smallCornell(), p, &report);
    EXPECT_EQ(field.record.preset, "draft");
    EXPECT_EQ(field.record.seed, 42u);
    EXPECT_EQ(field.record.cells, p.cells);
    EXPECT_EQ(field.record.directions, p.directions);
    EXPECT_EQ(field.record.instructionSet, currentInstructionSet());
    EXPECT_GT(field.record.texelSize, 0);
    EXPECT_GT(report.exchanges, 0u);
    EXPECT_GT(report.texels, 2000u);
    EXPECT_GE(report.stages.size(), 3u);
}

TEST(Bake, OfASceneWithoutLightIsBlack) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1), true, b.material("wall", Vec3(0.5f)));
    for (const Vec3& e : bakeQuick(b.scene(), quick()).atlas.irradiance) EXPECT_EQ(e, Vec3(0));
}

TEST(Bake, OfASceneWithoutLightDoesNotLookForIt) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1), true, b.material("mirror", Vec3(0), Vec3(0), Vec3(1)));
    Progress progress;
    BakeReport report;
    BakeParams params = quick();
    params.error = 0.01;
    bake(b.scene(), params, progress, &report);
    EXPECT_EQ(report.exchanges, 0u);
    EXPECT_EQ(report.residual, 0);
    EXPECT_EQ(report.error.interpolated(), 0);
}

TEST(Bake, OfOneTriangleWorks) {
    SceneBuilder b;
    b.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, b.material("lamp", Vec3(0.5f), Vec3(1)));
    const LightField field = bakeQuick(b.scene(), quick());
    EXPECT_GT(field.atlas.irradiance.size(), 100u);
    for (const Vec3& e : field.atlas.irradiance) EXPECT_EQ(e, Vec3(0));
}

TEST(Bake, OfNothingIsRefused) {
    EXPECT_THROW(bakeQuick(Scene{}, quick()), InputError);
}

TEST(Bake, CanBeCancelledAtAnyStage) {
    struct CancelAt : Progress {
        explicit CancelAt(std::string name) : wanted(std::move(name)) {}
        void stage(const std::string& name) override {
            if (name == wanted) cancel();
        }
        std::string wanted;
    };
    const Scene scene = smallCornell();
    for (const char* stage : {"charts", "direct light", "bounces"}) {
        CancelAt progress(stage);
        EXPECT_THROW(bake(scene, quick(), progress), Cancelled) << stage;
    }
}

TEST(Bake, DependsOnItsSeed) {
    BakeParams p = quick();
    const LightField a = bakeQuick(smallCornell(), p);
    p.seed = 1;
    const LightField b = bakeQuick(smallCornell(), p);
    ASSERT_EQ(a.atlas.irradiance.size(), b.atlas.irradiance.size());
    EXPECT_NE(a.atlas.irradiance, b.atlas.irradiance);
}

TEST(MemoryNeed, IsNearWhatABakeTakes) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "a sanitizer takes memory of its own";
#endif
    BakeParams p = quick();
    p.texelBudget = 200000;
    const Scene scene = smallCornell();
    rusage before{}, after{};
    getrusage(RUSAGE_SELF, &before);
    bakeQuick(scene, p);
    getrusage(RUSAGE_SELF, &after);
    const double taken = 1024.0 * static_cast<double>(after.ru_maxrss - before.ru_maxrss);
    const auto predicted = static_cast<double>(predictMemory(scene, p).transport);
    EXPECT_NEAR(predicted / taken, 1, 0.25);
}

TEST(MemoryNeed, OfMirrorsIsKnownWithTheCharts) {
    Progress progress;
    for (const char* name : {"mirror-room", "gloss"}) {
        const Scene scene = generateScene(name);
        BakeParams p = quick();
        p.radianceDirections = p.glossDirections = 513;
        p.radianceCells = p.glossCells = 64;
        const BakeState state = makeState(scene, p, progress);
        double exact = 0;
        for (const RadianceParams& params : radianceParams(p))
            exact += static_cast<double>(radianceSize(scene, unlitField(state), params).bytes);
        const auto predicted = static_cast<double>(predictMemory(state).radiance);
        EXPECT_NEAR(predicted / exact, 1, 0.1) << name;
    }
}

TEST(RequireMemory, CountsTheTilesOfSmallMirrors) {
    SceneBuilder b;
    b.box(Vec3(-1), Vec3(1), true, b.material("wall", Vec3(0.5f)));
    const auto mirror = b.material("mirror", Vec3(0), Vec3(0), Vec3(0.9f));
    for (int i = 0; i < 100; ++i)
        b.quad({-0.9f + 0.18f * static_cast<float>(i % 10), 0.1f * static_cast<float>(i / 10), 0},
               {0.002f, 0, 0}, {0, 0.002f, 0}, mirror);
    BakeParams p = quick();
    p.radianceDirections = 513;
    p.radianceCells = 256;
    Progress progress;
    const BakeState state = makeState(b.scene(), p, progress);
    const std::uint64_t byArea = predictMemory(b.scene(), p).total();
    EXPECT_GT(predictMemory(state).total(), byArea + 5'000'000);
    EXPECT_NO_THROW(requireMemory(b.scene(), p, byArea + 1'000'000));
    EXPECT_THROW(requireMemory(state, byArea + 1'000'000), InputError);
}

TEST(RequireMemory, LeavesLargeMirrorsToFiles) {
    const Scene scene = generateScene("mirror-room", {1000});
    BakeParams p = quick();
    p.radianceDirections = 513;
    p.radianceCells = 256;
    const ScratchPlace scratch{testing::TempDir(), 1'000'000};
    BakeState state(scene, p, solutionIn(scratch));
    const MemoryNeed inMemory = predictMemory(scene, p),
                     inFiles = predictMemory(scene, p, &scratch);
    EXPECT_GT(inMemory.radiance, 5'000'000u);
    EXPECT_EQ(inFiles.radiance, 0u);
    EXPECT_EQ(inFiles.scratch, inMemory.radiance);
    EXPECT_THROW(requireMemory(scene, p, inFiles.total() + 1000), InputError);
    EXPECT_NO_THROW(requireMemory(scene, p, inFiles.total() + 1000, &scratch));
    Progress progress;
    state.unwrap = makeState(scene, p, progress).unwrap;
    EXPECT_EQ(predictMemory(state).radiance, 0u);
    EXPECT_GT(predictMemory(state).scratch, 5'000'000u);
}

TEST(MemoryNeed, OfLargeMirrorsIsExpectedFromTheirArea) {
    const Scene scene = generateScene("mirror-room", {1000});
    Progress progress;
    BakeParams p = quick();
    p.radianceDirections = 513;
    p.radianceCells = 128;
    const auto expected = static_cast<double>(predictMemory(scene, p).radiance);
    const BakeState state = makeState(scene, p, progress);
    const double known = static_cast<double>(predictMemory(state).radiance);
    EXPECT_NEAR(expected / known, 1, 0.3);
}

TEST(MemoryNeed, GrowsWithTheTexels) {
    const Scene scene = smallCornell();
    BakeParams coarse = quick(), fine = quick();
    coarse.texelSize = 0.01f;
    fine.texelSize = 0.005f;
    EXPECT_GT(predictMemory(scene, fine).total(), 2 * predictMemory(scene, coarse).total());
}

TEST(RequireMemory, SaysWhatToChangeWhenThereIsTooLittle) {
    BakeParams p = quick();
    p.texelSize = 0.002f;
    const std::string advice = memoryAdvice(smallCornell(), p, 300'000'000);
    EXPECT_NE(advice.find("--texel"), std::string::npos) << advice;
    EXPECT_EQ(memoryAdvice(smallCornell(), p, 64'000'000'000), "");
}

TEST(RequireMemory, NamesTheMirrorsSettingWhereTheyAreTheReason) {
    BakeParams p = presetParams("high");
    const std::string advice = memoryAdvice(generateScene("mirror-room"), p, 500'000'000);
    EXPECT_NE(advice.find("--radiance-cells"), std::string::npos) << advice;
}

}  // namespace vlf::test
