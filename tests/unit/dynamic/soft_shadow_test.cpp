#include "vlf/dynamic/soft_shadow.h"
#include "lit_room.h"
#include "support/analytic_scenes.h"
#include "vlf/dynamic/object_light.h"
#include "vlf/scene/generate/primitives.h"

#include <cmath>
#include <string>

#include <algorithm>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

constexpr float kRadiance = 4;

/// A floor of 4 x 4 m about the origin, and 2 m above it a lamp of 1 x 1 m; all black.
const LitRoom& plates() {
    static const LitRoom room(
        [] {
            SceneBuilder b;
            b.quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, b.material("floor", Vec3(0)));
            b.quad({-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1},
                   b.material("lamp", Vec3(0), Vec3(kRadiance)));
            return b.scene();
        }(),
        Vec3(0));
    return room;
}

/// Irradiance on the floor by a lamp |x|, |z| <= half at height h.
float lampOnFloor(const Vec3& p, float half, float h) {
    double sum = 0;
    for (const float sx : {-1.0f, 1.0f})
        for (const float sz : {-1.0f, 1.0f}) {
            // Of the rectangle between p and a corner, signed.
            const float a = half + sx * p.x, b = half + sz * p.z;
            const double f = pointToRectangleFormFactor(std::abs(a), std::abs(b), h);
            sum += (a < 0) != (b < 0) ? -f : f;
        }
    return static_cast<float>(kPi * kRadiance * sum);
}

class SoftShadow : public testing::Test {
  protected:
    TexelLoss loss;
    std::vector<std::uint32_t> candidates;

    void cast(const Scene& body, const Pose& pose, int samples = 64) {
        const ObjectModel model(body);
        const RayInstance instance{&model.mesh().rays, pose};
        RayInstances instances;
        instances.place({&instance, 1});
        const Sphere sphere{pose.point(model.bounds().centre), pose.scale * model.bounds().radius};
        candidates = texelsInShadow(plates().scene, plates().texels, {&sphere, 1});
        SoftShadows shadows;
        loss = shadows.find(plates().scene, plates().rays, plates().texels,
                               Coverage(plates().texels), instances, {&sphere, 1}, samples, 0);
    }

    Vec3 centre(std::uint32_t entry) const {
        return texelReceiver(plates().scene, plates().texels.unwrap, entry).centre;
    }
    bool isFloor(std::uint32_t entry) const { return centre(entry).y < 0.1f; }

    float lossAt(std::size_t i) const { return loss.loss[i].x; }
};

/// A black square |x|, |z| <= half.
Scene sheet(float half) {
    SceneBuilder b;
    b.quad({-half, 0, -half}, {2 * half, 0, 0}, {0, 0, 2 * half}, b.material("sheet", Vec3(0)));
    return b.scene();
}

TEST_F(SoftShadow, OfASheetHalfWayIsWhatItHidesOfTheLamp) {
    // From the floor, a square of half the lamp's size half way up hides the lamp just so from
    // the middle; away from it, the lamp is hidden where its projection overlaps.
    cast(sheet(0.25f), {{0, 1, 0}, {1, 0, 0, 0}, 1});
    double off = 0, bias = 0, all = 0;
    int seen = 0;
    for (std::size_t i = 0; i < loss.entries.size(); ++i) {
        if (!isFloor(loss.entries[i])) continue;
        const Vec3 p = centre(loss.entries[i]);
        // The sheet's projection on the lamp's plane is |x + px|, |z + pz| <= 0.5.
        const float x0 = std::max(-0.5f, -0.5f - p.x), x1 = std::min(0.5f, 0.5f - p.x);
        const float z0 = std::max(-0.5f, -0.5f - p.z), z1 = std::min(0.5f, 0.5f - p.z);
        float expected = 0;
        constexpr int kSteps = 40;
        for (int u = 0; u < kSteps && x1 > x0 && z1 > z0; ++u)
            for (int v = 0; v < kSteps; ++v) {
                const Vec3 q(x0 + (x1 - x0) * (u + 0.5f) / kSteps, 2,
                             z0 + (z1 - z0) * (v + 0.5f) / kSteps);
                const float d2 = glm::dot(q - p, q - p);
                expected += kRadiance * 4 / (d2 * d2) * (x1 - x0) * (z1 - z0) / (kSteps * kSteps);
            }
        off += std::abs(lossAt(i) - expected);
        bias += lossAt(i) - expected;
        all += expected;
        EXPECT_NEAR(lossAt(i), expected, 0.15f * lampOnFloor(p, 0.5f, 2));
        ++seen;
    }
    EXPECT_GT(seen, 100);
    EXPECT_LT(off / all, 0.08);  // by chance
    EXPECT_LT(std::abs(bias / all), 0.015);
}

TEST_F(SoftShadow, OfASheetBeforeAllOfTheLampIsAllItsLight) {
    cast(sheet(0.6f), {{0, 1.9f, 0}, {1, 0, 0, 0}, 1});
    int seen = 0;
    for (std::size_t i = 0; i < loss.entries.size(); ++i) {
        const Vec3 p = centre(loss.entries[i]);
        if (!isFloor(loss.entries[i]) || glm::length(p) > 1) continue;
        EXPECT_NEAR(lossAt(i) / lampOnFloor(p, 0.5f, 2), 1, 0.05f);
        ++seen;
    }
    EXPECT_GT(seen, 100);
}

TEST_F(SoftShadow, FallsOnlyWhereTheObjectMayHideTheLamp) {
    cast(makePrimitive("sphere", {}), {{0, 0.3f, 0}, {1, 0, 0, 0}, 0.4f});
    for (const std::uint32_t entry : loss.entries)
        EXPECT_NE(std::find(candidates.begin(), candidates.end(), entry), candidates.end());
    float farthest = 0;
    for (std::size_t i = 0; i < loss.entries.size(); ++i) {
        EXPECT_GE(lossAt(i), 0);
        if (isFloor(loss.entries[i]) && lossAt(i) > 0)
            farthest = std::max(farthest, glm::length(centre(loss.entries[i])));
    }
    EXPECT_GT(farthest, 0.2f);
    EXPECT_LT(farthest, 0.6f);
    EXPECT_LT(candidates.size(), plates().texels.unwrap.texels.size() / 4);
}

TEST_F(SoftShadow, IsNoneOfWhatIsBehindTheLampOrBesideIt) {
    for (const Vec3& place : {Vec3(0, 3, 0), Vec3(0, -1, 0), Vec3(8, 1, 0)}) {
        cast(makePrimitive("sphere", {}), {place, {1, 0, 0, 0}, 0.4f});
        for (std::size_t i = 0; i < loss.entries.size(); ++i) EXPECT_EQ(loss.loss[i], Vec3(0));
    }
}

}  // namespace
}  // namespace vlf::test
