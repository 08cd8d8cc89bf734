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
        const ShadowCaster caster = casterOf(model, pose);
        candidates = texelsInShadow(plates().scene, plates().rays, plates().texels, {&caster, 1});
        SoftShadows shadows(plates().scene, plates().rays, plates().texels);
        loss = shadows.find(Coverage(plates().texels), instances, {&caster, 1}, samples, 0);
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

/// Of one of the plates' texels, W.
float fluxOf(const LitRoom& room, const TexelLoss& loss) {
    float flux = 0;
    for (std::size_t i = 0; i < loss.entries.size(); ++i)
        flux += room.texels.area[room.texels.unwrap.texels[loss.entries[i]]] * loss.loss[i].x;
    for (std::size_t i = 0; i < loss.groups.size(); ++i)
        flux += room.texels.groups[loss.groups[i]].area * loss.groupLoss[i].x;
    return flux;
}

/// Of a ball of 0.2 m; errors of `slight` do not matter.
TexelLoss ofABall(const LitRoom& room, const Vec3& at, float slight) {
    const ObjectModel model(makePrimitive("sphere", {}));
    const Pose pose{at, {1, 0, 0, 0}, 0.2f};
    const RayInstance instance{&model.mesh().rays, pose};
    RayInstances instances;
    instances.place({&instance, 1});
    const ShadowCaster caster = casterOf(model, pose);
    SoftShadows shadows(room.scene, room.rays, room.texels);
    return shadows.find(Coverage(room.texels), instances, {&caster, 1}, 64, slight);
}

TEST(WeakShadow, IsSpreadOverSquaresOfTexels) {
    const TexelLoss every = ofABall(plates(), {0, 1.5f, 0}, 0);
    const TexelLoss weak = ofABall(plates(), {0, 1.5f, 0}, 0.02f);
    EXPECT_TRUE(every.groups.empty());
    EXPECT_FALSE(weak.groups.empty());
    EXPECT_LT(weak.entries.size(), every.entries.size());
    EXPECT_NEAR(fluxOf(plates(), weak) / fluxOf(plates(), every), 1, 0.1);
}

/// The plates with a mirror along x = 2.
const LitRoom& platesBesideAMirror() {
    static const LitRoom room(
        [] {
            SceneBuilder b;
            b.quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, b.material("floor", Vec3(0)));
            b.quad({-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1},
                   b.material("lamp", Vec3(0), Vec3(kRadiance)));
            b.quad({2, 0, -2}, {0, 0, 4}, {0, 2, 0},
                   b.material("mirror", Vec3(0), Vec3(0), Vec3(0.9f)));
            return b.scene();
        }(),
        Vec3(0));
    return room;
}

TEST(ShadowBesideAMirror, IsWhatShadowRaysAreBlockedByTheObject) {
    const LitRoom& room = platesBesideAMirror();
    ASSERT_EQ(room.texels.sources.images.size(), 2u);
    const Vec3 at(1.2f, 1, 0);
    const TexelLoss loss = ofABall(room, at, 0);
    const ObjectModel model(makePrimitive("sphere", {}));
    const RayInstance instance{&model.mesh().rays, {at, {1, 0, 0, 0}, 0.2f}};
    RayInstances instances;
    instances.place({&instance, 1});
    LightGatherer gatherer(room.scene, room.rays, room.texels.unwrap, room.texels.sources, 0);
    gatherer.setExtraOccluder(occluderOf(instances));
    const std::vector<std::uint8_t> mirrored{0, 1};
    float all = 0, inMirror = 0;
    for (std::size_t i = 0; i < room.texels.unwrap.texels.size(); ++i) {
        const LightReceiver texel = texelReceiver(room.scene, room.texels.unwrap, i);
        const float area = room.texels.area[room.texels.unwrap.texels[i]];
        gatherer.setImages({});
        all += area * gatherer.irradianceBlocked(texel, 256).x;
        gatherer.setImages(mirrored);
        inMirror += area * gatherer.irradianceBlocked(texel, 256).x;
    }
    EXPECT_GT(inMirror, 0.1f * all);
    EXPECT_NEAR(fluxOf(room, loss) / all, 1, 0.03);
}

}  // namespace
}  // namespace vlf::test
