#include "vlf/render/cpu/texel_reference.h"

#include "support/analytic_scenes.h"
#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/math/sampling.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

using namespace test;

const auto kAllOpen = [](std::uint32_t, bool) { return true; };

/// Evenly spread points over the front (or back) of a mesh, `perTriangle` on each triangle.
std::vector<SidePoint> pointsOn(const Mesh& mesh, bool front = true,
                                std::uint32_t perTriangle = 1024) {
    std::vector<SidePoint> points;
    for (std::uint32_t t = 0; t < mesh.triangleCount; ++t)
        for (std::uint32_t i = 0; i < perTriangle; ++i)
            points.push_back(
                {mesh.firstTriangle + t, sampleUniformTriangle(r2Point(i, Vec2(0.5f))), front});
    return points;
}

IrradianceEstimate estimate(const Scene& scene, TexelArea texel, int samples,
                            const SideIsOpen& isOpen = kAllOpen, const PathOptions& paths = {}) {
    Progress progress;
    return estimateIrradiance(scene, RayScene(scene), std::vector{texel}, isOpen,
                              {samples, 1, paths}, progress)[0];
}

/// The estimate lies within four standard errors of `truth`, which are at most `accuracy` of it.
void expectIrradiance(const IrradianceEstimate& e, double truth, double accuracy) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(e.mean[c], truth, 4 * e.standardError[c] + 1e-6 * truth);
        EXPECT_LE(e.standardError[c], accuracy * truth);
    }
}

TEST(TexelReference, ParallelPlates) {
    for (const float distance : {0.25f, 1.0f, 3.0f}) {
        const Scene scene = parallelPlates(1, distance, 2);
        expectIrradiance(estimate(scene, pointsOn(scene.meshes[0]), 100000),
                         std::numbers::pi * 2 * parallelFormFactor(1 / distance), 0.003);
    }
}

TEST(TexelReference, PerpendicularPlates) {
    ASSERT_NEAR(perpendicularFormFactor(), 0.20004, 1e-5);
    const Scene scene = perpendicularPlates(2);
    expectIrradiance(estimate(scene, pointsOn(scene.meshes[0]), 200000),
                     std::numbers::pi * 2 * perpendicularFormFactor(), 0.01);
}

TEST(TexelReference, PointUnderTheCornerOfARectangle) {
    const Scene scene = parallelPlates(2, 0.7f, 3);
    const std::vector<SidePoint> corner = {{0, {0, 0}, true}};
    expectIrradiance(estimate(scene, corner, 50000),
                     std::numbers::pi * 3 * pointToRectangleFormFactor(2, 2, 0.7), 0.01);
}

TEST(TexelReference, FindingEmittersByChanceGivesTheSame) {
    const Scene scene = parallelPlates(1, 1, 2);
    expectIrradiance(estimate(scene, pointsOn(scene.meshes[0]), 200000, kAllOpen, {0, false}),
                     std::numbers::pi * 2 * parallelFormFactor(1), 0.01);
}

TEST(TexelReference, WhiteFurnace) {
    const Vec3 albedo(0.6f), emission(1);
    for (const Scene& scene : {furnaceBox(albedo, emission), furnaceSphere(albedo, emission, 1)})
        expectIrradiance(estimate(scene, pointsOn(scene.meshes[0]), 50000),
                         std::numbers::pi * furnaceRadiance(albedo, emission).x, 0.005);
}

TEST(TexelReference, TheBackOfAPlateSeesNothing) {
    const Scene scene = parallelPlates(1, 1, 2);
    EXPECT_EQ(estimate(scene, pointsOn(scene.meshes[0], false), 1000).mean, Vec3(0));
}

TEST(TexelReference, DepthOneIsDirectLight) {
    const Scene scene = furnaceBox(Vec3(0.6f), Vec3(1));
    expectIrradiance(estimate(scene, pointsOn(scene.meshes[0]), 20000, kAllOpen, {1, true}),
                     std::numbers::pi, 0.02);
}

/// Floor under a lamp, with a solid box standing on half of it; mesh 0 is the floor.
struct HalfCovered {
    Scene scene;
    std::uint32_t boxBegin = 0, boxEnd = 0;

    HalfCovered() {
        SceneBuilder b;
        const std::uint32_t white = b.material("white", Vec3(0.5f));
        b.quad(Vec3(0), {0, 0, 1}, {2, 0, 0}, white);
        b.quad({0, 1, 0}, {2, 0, 0}, {0, 0, 1}, b.material("lamp", Vec3(0), Vec3(1)));
        boxBegin = static_cast<std::uint32_t>(b.scene().triangles.size());
        b.box({1, -0.1f, -0.1f}, {2.1f, 0.3f, 1.1f}, false, white);
        boxEnd = static_cast<std::uint32_t>(b.scene().triangles.size());
        scene = b.scene();
    }

    SideIsOpen sides() const {
        return [begin = boxBegin, end = boxEnd](std::uint32_t t, bool front) {
            return front || t < begin || t >= end;
        };
    }

    std::vector<SidePoint> floor(bool covered) const {
        std::vector<SidePoint> kept;
        for (const SidePoint& p : pointsOn(scene.meshes[0]))
            if ((positionAt(scene, p.triangle, p.barycentric).x > 1) == covered) kept.push_back(p);
        return kept;
    }
};

TEST(TexelReference, BuriedPointsHaveNoSay) {
    const HalfCovered room;
    const std::vector<SidePoint> open = room.floor(false), buried = room.floor(true);
    std::vector<SidePoint> both = open;
    both.insert(both.end(), buried.begin(), buried.end());
    const IrradianceEstimate alone = estimate(room.scene, open, 50000, room.sides());
    const IrradianceEstimate mixed = estimate(room.scene, both, 100000, room.sides());
    EXPECT_NEAR(mixed.samples, 50000, 1000);
    const float error = glm::length(Vec2(alone.standardError.x, mixed.standardError.x));
    EXPECT_NEAR(alone.mean.x, mixed.mean.x, 4 * error);
    EXPECT_GT(alone.mean.x, 0.5);
    EXPECT_EQ(estimate(room.scene, buried, 1000, room.sides()).samples, 0u);
}

TEST(TexelReference, ResultDoesNotDependOnThreadsOrNeighbours) {
    const Scene scene = smallCornell();
    const RayScene rays(scene);
    const std::vector<SidePoint> a = pointsOn(scene.meshes[0]), b = pointsOn(scene.meshes[2]);
    const std::vector<TexelArea> texels = {a, b, {}, a};
    const auto run = [&](int threads, std::size_t count) {
        const ThreadLimit limit(threads);
        Progress progress;
        return estimateIrradiance(scene, rays, std::span(texels).first(count), kAllOpen,
                                  {100, 1, {}}, progress);
    };
    const std::vector<IrradianceEstimate> reference = run(1, 4);
    EXPECT_EQ(reference[2].samples, 0u);
    EXPECT_NE(reference[0].mean, reference[3].mean);
    for (const int threads : {2, 7})
        for (const std::size_t count : {2, 4})
            for (std::size_t i = 0; i < count; ++i)
                EXPECT_EQ(run(threads, count)[i].mean, reference[i].mean);
}

TEST(TexelReference, RefusesNonsense) {
    const Scene scene = parallelPlates(1, 1, 2);
    EXPECT_THROW(estimate(scene, pointsOn(scene.meshes[0]), 0), InputError);
    const std::vector<SidePoint> outside = {{1234, {0, 0}, true}};
    EXPECT_THROW(estimate(scene, outside, 10), InputError);
}

TEST(TexelReference, CanBeCancelled) {
    const Scene scene = parallelPlates(1, 1, 2);
    const std::vector<SidePoint> points = pointsOn(scene.meshes[0]);
    Progress progress;
    progress.cancel();
    EXPECT_THROW(estimateIrradiance(scene, RayScene(scene), std::vector{TexelArea(points)},
                                    kAllOpen, {100, 1, {}}, progress),
                 Cancelled);
}

}  // namespace
}  // namespace vlf
