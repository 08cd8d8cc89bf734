// Which sides of the surfaces get charts: those that light can reach.

#include "unwrapped_scene.h"

#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/scene/generate/generate.h"

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

constexpr UnwrapParams kCoarse{0, 4000};

/// Share of what random walks from the emitters hit that has no chart.
double chartlessShare(const UnwrappedScene& s, int walks) {
    std::vector<std::uint32_t> emitters;
    for (std::uint32_t t = 0; t < s.scene.triangles.size(); ++t)
        if (s.scene.material(t).isEmitter()) emitters.push_back(t);
    int missing = 0, all = 0;
    for (int i = 0; i < walks; ++i) {
        RandomStream random(77, i);
        const std::uint32_t start = emitters[i % emitters.size()];
        Vec3 p = positionAt(s.scene, start, sampleUniformTriangle(random.next2()));
        Vec3 n = geometricNormal(s.scene, start);
        for (int bounce = 0; bounce < 6; ++bounce) {
            const Vec3 d = frameFromNormal(n).toWorld(sampleCosineHemisphere(random.next2()));
            const Hit hit = s.rays.closest({p + s.rays.epsilon() * n, d});
            if (!hit) break;
            n = geometricNormal(s.scene, hit.triangle);
            const bool front = glm::dot(n, d) < 0;
            if (!front) n = -n;
            const TriangleCharts& charts = s.unwrap.triangleCharts[hit.triangle];
            missing += (front ? charts.front : charts.back) == kNoChart;
            ++all;
            p = positionAt(s.scene, hit.triangle, hit.barycentric);
        }
    }
    return static_cast<double>(missing) / all;
}

}  // namespace

TEST(OpenSides, WhateverLightHitsHasAChart) {
    for (const char* name : {"cornell", "two-rooms", "mirror-room", "office"}) {
        const UnwrappedScene room(generateScene(name, {}), {0, 20000});
        EXPECT_LT(chartlessShare(room, 20000), 2e-4) << name;
    }
}

TEST(OpenSides, TheInsideOfAClosedBoxHasNone) {
    SceneBuilder b = litRoom();
    b.box({1, 0, 1}, {2, 1, 2}, false, b.material("box", Vec3(0.5f)));
    const UnwrappedScene room(b.scene(), kCoarse);
    for (std::uint32_t t = 14; t < room.scene.triangles.size(); ++t)
        EXPECT_EQ(room.unwrap.triangleCharts[t].back, kNoChart) << "triangle " << t;
}

TEST(OpenSides, TheOutsideOfAClosedRoomHasNone) {
    const UnwrappedScene room(litRoom().scene(), kCoarse);
    for (std::uint32_t t = 0; t < 12; ++t) {
        EXPECT_NE(room.unwrap.triangleCharts[t].front, kNoChart);
        EXPECT_EQ(room.unwrap.triangleCharts[t].back, kNoChart);
    }
}

TEST(OpenSides, ARoomWithFlippedWindingsHasChartsInside) {
    const UnwrappedScene room(litRoom(false).scene(), kCoarse);
    for (std::uint32_t t = 0; t < 12; ++t) {
        const TriangleCharts& charts = room.unwrap.triangleCharts[t];
        ASSERT_NE(charts.back, kNoChart) << "triangle " << t;
        EXPECT_EQ(charts.front, kNoChart) << "triangle " << t;
        const Vec3 inwards = Vec3(2, 1.5f, 2) - room.scene.position(t, 0);
        EXPECT_GT(glm::dot(room.unwrap.charts[charts.back].normal, inwards), 0);
    }
}

TEST(OpenSides, AThinPanelHasAChartOnEachSide) {
    SceneBuilder b = litRoom();
    b.quad({1, 1, 1}, {1, 0, 0}, {0, 1, 0}, b.material("panel", Vec3(0.5f)));
    const UnwrappedScene room(b.scene(), kCoarse);
    const auto [first, last] = lastMesh(room.scene);
    const TriangleCharts charts = room.unwrap.triangleCharts[first];
    ASSERT_NE(charts.front, kNoChart);
    ASSERT_NE(charts.back, kNoChart);
    EXPECT_NE(charts.front, charts.back);
    EXPECT_EQ(room.unwrap.charts[charts.front].normal, -room.unwrap.charts[charts.back].normal);
    for (std::uint32_t t = first; t < last; ++t) {
        EXPECT_EQ(room.unwrap.triangleCharts[t].front, charts.front);
        EXPECT_EQ(room.unwrap.triangleCharts[t].back, charts.back);
    }
}

TEST(OpenSides, AGapThatLittleLightSlipsIntoIsClosedWhateverTheSeed) {
    // The lamp is a millimetre below the ceiling.
    const Scene scene = generateScene("cornell", {});
    for (std::uint64_t seed = 0; seed < 16; ++seed) {
        const UnwrappedScene room(scene, {.texelBudget = 500, .seed = seed});
        for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
            if (!scene.material(t).isEmitter()) continue;
            EXPECT_EQ(room.unwrap.triangleCharts[t].back, kNoChart) << "seed " << seed;
        }
    }
}

TEST(OpenSides, ASceneWithoutLightHasItsFronts) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1), true, b.material("wall", Vec3(0.5f)));
    const UnwrappedScene room(b.scene(), kCoarse);
    for (const TriangleCharts& c : room.unwrap.triangleCharts) EXPECT_NE(c.front, kNoChart);
}

}  // namespace vlf::test
