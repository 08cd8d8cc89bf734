// The machinery of the path tracer: noise estimates, limits, determinism.

#include "vlf/render/cpu/path_tracer.h"

#include "picture_statistics.h"
#include "support/analytic_scenes.h"
#include "vlf/base/error.h"
#include "vlf/base/parallel.h"

#include <cstring>

#include <gtest/gtest.h>

namespace vlf {
namespace {

using namespace test;

bool sameBits(const Image& a, const Image& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Vec3)) == 0;
}

PathTraceParams smallParams(const Scene& scene) {
    PathTraceParams params;
    params.camera = scene.cameras.front();
    params.width = 40;
    params.height = 24;
    params.samplesPerPixel = 8;
    return params;
}

TEST(PathTracer, PictureIsTheSameForAnyNumberOfThreads) {
    const Scene scene = smallCornell();
    const PathTraceResult reference = trace(scene, 50, 37, 8);
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        const PathTraceResult picture = trace(scene, 50, 37, 8);
        EXPECT_TRUE(sameBits(reference.image, picture.image)) << threads;
        EXPECT_TRUE(sameBits(reference.variance, picture.variance)) << threads;
    }
}

TEST(PathTracer, SeedChangesThePicture) {
    const Scene scene = smallCornell();
    EXPECT_FALSE(
        sameBits(trace(scene, 16, 16, 4, {}, 1).image, trace(scene, 16, 16, 4, {}, 2).image));
}

TEST(PathTracer, SamplesInTwoStepsAreTheSamplesOfOne) {
    const Scene scene = smallCornell();
    const RayScene rays(scene);
    const PathIntegrator integrator(scene, rays);
    const PathTraceParams params = smallParams(scene);
    Progress progress;
    PathTraceState once = makePathTraceState(params.width, params.height);
    traceSamples(once, integrator, params, 5, progress);
    PathTraceState twice = makePathTraceState(params.width, params.height);
    traceSamples(twice, integrator, params, 2, progress);
    traceSamples(twice, integrator, params, 3, progress);
    EXPECT_TRUE(sameBits(meanImage(once), meanImage(twice)));
    EXPECT_TRUE(sameBits(varianceOfMean(once), varianceOfMean(twice)));
}

/// Mean of a per-pixel quantity's red channel.
double meanRed(const std::vector<Vec3>& pixels) {
    double sum = 0;
    for (const Vec3& p : pixels) sum += p.x;
    return sum / static_cast<double>(pixels.size());
}

TEST(PathTracer, VarianceImagePredictsTheErrorOfThePixels) {
    const Vec3 albedo(0.5f), emission(1);
    for (const int samples : {2, 16, 64}) {
        const PathTraceResult picture = trace(furnaceBox(albedo, emission), 48, 48, samples);
        std::vector<Vec3> squaredErrors;
        for (const Vec3& p : picture.image.pixels) {
            const Vec3 error = p - furnaceRadiance(albedo, emission);
            squaredErrors.push_back(error * error);
        }
        EXPECT_NEAR(meanRed(squaredErrors) / meanRed(picture.variance.pixels), 1, 0.15) << samples;
    }
}

TEST(PathTracer, RelativeErrorIsThatAgainstTheTruth) {
    const Vec3 albedo(0.5f), emission(1);
    const PathTraceResult picture = trace(furnaceBox(albedo, emission), 48, 48, 64);
    const double truth = furnaceRadiance(albedo, emission).x;
    double sum = 0;
    for (const Vec3& p : picture.image.pixels) sum += (p.x - truth) * (p.x - truth);
    const double relMse =
        sum / static_cast<double>(picture.image.pixels.size()) / (truth * truth + 0.01);
    EXPECT_NEAR(picture.relativeError / std::sqrt(relMse), 1, 0.1);
}

TEST(PathTracer, StopsAtTheWantedError) {
    const Scene scene = furnaceBox(Vec3(0.5f), Vec3(1));
    PathTraceParams params = smallParams(scene);
    params.samplesPerPixel = 0;
    params.targetError = 0.05;
    Progress progress;
    const PathTraceResult picture = pathTrace(scene, RayScene(scene), params, progress);
    EXPECT_EQ(picture.stop, PathTraceStop::error);
    EXPECT_LE(picture.relativeError, 0.05);
    EXPECT_GT(picture.relativeError, 0.025);
}

TEST(PathTracer, StopsAfterTheGivenTime) {
    const Scene scene = smallCornell();
    PathTraceParams params = smallParams(scene);
    params.samplesPerPixel = 0;
    params.maxSeconds = 0.05;
    Progress progress;
    const PathTraceResult picture = pathTrace(scene, RayScene(scene), params, progress);
    EXPECT_EQ(picture.stop, PathTraceStop::time);
    EXPECT_GE(picture.seconds, 0.05);
    EXPECT_GT(picture.samplesPerPixel, 0);
}

/// Cancels itself at the first report of progress that has samples to show.
class CancelAfterFirstPass : public Progress {
  public:
    void update(double fraction) override {
        if (fraction > 0) cancel();
    }
};

TEST(PathTracer, CancellingReturnsWhatThereIs) {
    const Scene scene = smallCornell();
    PathTraceParams params = smallParams(scene);
    params.samplesPerPixel = 1000000;
    CancelAfterFirstPass progress;
    const PathTraceResult picture = pathTrace(scene, RayScene(scene), params, progress);
    EXPECT_EQ(picture.stop, PathTraceStop::cancelled);
    EXPECT_EQ(picture.samplesPerPixel, 1);
    EXPECT_GT(pictureMean(picture).mean.x, 0);
}

TEST(PathTracer, PixelsLeftOutByAnInterruptionAreBlackAndHaveNoVariance) {
    const PathTraceState state = makePathTraceState(3, 2);
    EXPECT_EQ(meanImage(state).at(2, 1), Vec3(0));
    EXPECT_EQ(varianceOfMean(state).at(2, 1), Vec3(0));
    EXPECT_TRUE(std::isinf(relativeError(state)));
}

TEST(PathTracer, RefusesToRunWithoutLimitOrView) {
    const Scene scene = smallCornell();
    const RayScene rays(scene);
    Progress progress;
    PathTraceParams params = smallParams(scene);
    params.samplesPerPixel = 0;
    EXPECT_THROW(pathTrace(scene, rays, params, progress), InputError);
    params.samplesPerPixel = -1;
    EXPECT_THROW(pathTrace(scene, rays, params, progress), InputError);
    params = smallParams(scene);
    params.targetError = std::nan("");
    EXPECT_THROW(pathTrace(scene, rays, params, progress), InputError);
    params = smallParams(scene);
    params.width = 0;
    EXPECT_THROW(pathTrace(scene, rays, params, progress), InputError);
    params = smallParams(scene);
    params.camera.look = params.camera.eye;
    EXPECT_THROW(pathTrace(scene, rays, params, progress), InputError);
}

TEST(PathTracer, AnEmptySceneIsBlack) {
    Scene scene;
    scene.cameras.push_back({});
    EXPECT_EQ(pictureMean(trace(scene, 4, 4, 2)).mean, glm::dvec3(0));
}

}  // namespace
}  // namespace vlf
