#include "gathered.h"
#include "support/analytic_scenes.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

/// A closed room of 4 x 4 x 4 m about the origin, of which everything sends the same radiance.
const Vec3 kRadiance(0.5f, 1, 2);

const LitRoom& furnace() {
    static const LitRoom room(
        [] {
            SceneBuilder b;
            b.box(Vec3(-2), Vec3(2), true, b.material("wall", Vec3(0.5f)));
            return b.scene();
        }(),
        kRadiance);
    return room;
}

Pose aslant(const Vec3& at, float scale) {
    return {at, glm::normalize(Quat(0.8f, 0.3f, -0.2f, 0.4f)), scale};
}

GatherSettings few(GatherPoints points = GatherPoints::texels, int subdivision = 0) {
    GatherSettings settings;
    settings.points = points;
    settings.subdivision = subdivision;
    settings.lines = 129;
    return settings;
}

float deviation(const Vec3& irradiance) {
    return maxComponent(glm::abs(irradiance / (kPi * kRadiance) - 1.0f));
}

float worst(const Gathered& gathered) {
    float found = 0;
    for (const Vec3& e : gathered.irradiance) {
        if (!isFinite(e)) return INFINITY;
        found = std::max(found, deviation(e));
    }
    return found;
}

TEST(Gather, WhiteBodiesInAFurnaceGatherPiTimesItsRadiance) {
    for (const char* name : {"cube", "sphere", "knot"})
        for (const float cellsAcross : {0.0f, 4.0f}) {
            const ObjectModel model = bodyOf(name, Vec3(1));
            for (const GatherPoints points : {GatherPoints::texels, GatherPoints::vertices}) {
                const Gathered g(furnace(), model, few(points), cellsAcross,
                                 aslant({0.3f, -0.2f, 0.5f}, 1));
                // Of the light between parts of the knot the seventh bounce is missing.
                EXPECT_LT(worst(g), model.scene().triangles.size() > 12 ? 0.015f : 1e-5f)
                    << name << ", " << cellsAcross << " cells, "
                    << (points == GatherPoints::texels ? "texels" : "vertices");
            }
        }
}

TEST(Gather, AtVerticesOfEverySubdivision) {
    const ObjectModel model = bodyOf("cube", Vec3(1));
    std::size_t before = 0;
    for (int subdivision = 0; subdivision <= ObjectModel::kMaxSubdivision; ++subdivision) {
        const Gathered g(furnace(), model, few(GatherPoints::vertices, subdivision), 4,
                         aslant(Vec3(0), 1));
        EXPECT_LT(worst(g), 1e-5f) << subdivision;
        EXPECT_GT(g.irradiance.size(), before);
        before = g.irradiance.size();
    }
}

TEST(Gather, WhatABlackBodyHidesFromItselfIsMissing) {
    const Gathered convex(furnace(), bodyOf("sphere", Vec3(0)), few(), 4, aslant(Vec3(0), 1));
    EXPECT_LT(worst(convex), 0.02f);  // facets of the sphere see a little of their neighbours
    const Gathered knot(furnace(), bodyOf("knot", Vec3(0)), few(), 4, aslant(Vec3(0), 1));
    float least = 1;
    for (const Vec3& e : knot.irradiance) {
        EXPECT_LT(e.x, kPi * kRadiance.x * 1.00001f);
        least = std::min(least, e.x / (kPi * kRadiance.x));
    }
    EXPECT_LT(least, 0.5f);
}

TEST(Gather, ABodyHalfInAWallIsLitRightOutside) {
    for (const char* name : {"cube", "sphere"})
        for (const Pose& pose : {aslant({0, -2, 0}, 1), aslant({2, -2, 2}, 1)}) {
            const Gathered g(furnace(), bodyOf(name, Vec3(1)), few(), 0, pose);
            int within = 0;
            for (std::size_t r = 0; r < g.irradiance.size(); ++r) {
                ASSERT_TRUE(isFinite(g.irradiance[r]));
                const Vec3 p = pose.point(g.receivers->position[r]);
                if (maxComponent(glm::abs(p)) > 1.999f) continue;
                ++within;
                EXPECT_LT(deviation(g.irradiance[r]), 1e-5f) << name << " " << r;
            }
            EXPECT_GT(within, 10);
        }
}

TEST(Gather, ABodyThatStandsOnTheFloorIsLitToItsFoot) {
    Pose pose;
    pose.translation = {0, -1.5f, 0};
    const Gathered g(furnace(), bodyOf("cube", Vec3(1)), few(), 4, pose);
    for (std::size_t r = 0; r < g.irradiance.size(); ++r) {
        if (g.receivers->geometric[r].y > -0.5f) {
            EXPECT_LT(deviation(g.irradiance[r]), 1e-5f) << r;
        }
    }
}

/// A room with a bright ceiling, the rest black: light that varies.
const LitRoom& skylit() {
    static const LitRoom room = [] {
        LitRoom made(furnace().scene, Vec3(0));
        for (const std::uint32_t t : made.texels.unwrap.texels) made.radiance[t] = Vec3(0);
        const Unwrap& unwrap = made.texels.unwrap;
        for (std::size_t i = 0; i < unwrap.texels.size(); ++i)
            if (unwrap.charts[unwrap.texelChart[i]].normal.y < -0.9f)
                made.radiance[unwrap.texels[i]] = Vec3(1);
        return made;
    }();
    return room;
}

TEST(Gather, UnderABrightCeilingIsItsFormFactor) {
    Pose pose;
    pose.scale = 0.02f;
    GatherSettings settings = few();
    settings.lines = 513;
    const Gathered g(skylit(), bodyOf("cube", Vec3(1)), settings, 4, pose);
    const double up = kPi * 4 * pointToRectangleFormFactor(2, 2, 2);
    Vec3 sum(0);
    int count = 0;
    for (std::size_t r = 0; r < g.irradiance.size(); ++r) {
        if (g.receivers->geometric[r].y > 0.9f) sum += g.irradiance[r], ++count;
        if (g.receivers->geometric[r].y < -0.9f) {
            EXPECT_EQ(g.irradiance[r], Vec3(0));
        }
    }
    ASSERT_GT(count, 0);
    EXPECT_NEAR(sum.x / static_cast<float>(count) / up, 1, 0.02);
}

double meanDifference(const Gathered& a, const Gathered& b) {
    double difference = 0, sum = 0;
    for (std::size_t r = 0; r < a.irradiance.size(); ++r) {
        difference += std::abs(a.irradiance[r].x - b.irradiance[r].x);
        sum += a.irradiance[r].x;
    }
    return difference / sum;
}

TEST(Gather, SharedRaysAndFewerDirectionsStayNearToAll) {
    const ObjectModel model = bodyOf("knot", Vec3(0));
    GatherSettings all = few();
    all.lines = 513;
    GatherSettings half = all;
    half.step = 2;
    GatherSettings important = all;
    important.importanceSamples = 256;
    const Pose pose = aslant({0.2f, -0.3f, 0.1f}, 0.5f);
    const Gathered exact(skylit(), model, all, 0, pose);
    const double shared = meanDifference(exact, Gathered(skylit(), model, all, 4, pose));
    const double stepped = meanDifference(exact, Gathered(skylit(), model, half, 0, pose));
    const double picked = meanDifference(exact, Gathered(skylit(), model, important, 0, pose));
    for (const double difference : {shared, stepped, picked}) {
        EXPECT_LT(difference, 0.05);
        EXPECT_GT(difference, 0);
    }
}

/// A room with a floor that is bright but for a dark strip along the middle, the rest black.
const LitRoom& striped() {
    static const LitRoom room = [] {
        LitRoom made(furnace().scene, Vec3(0));
        for (const std::uint32_t t : made.texels.unwrap.texels)
            if (made.texels.place[t].y < -1.99f && std::abs(made.texels.place[t].z) > 0.6f)
                made.radiance[t] = Vec3(1);
        return made;
    }();
    return room;
}

TEST(Gather, PatchesSeeTheFloorThatTheyStandOnFromEachOfTheirPlaces) {
    const ObjectModel model = bodyOf("cube", Vec3(0));
    GatherSettings settings = few();
    settings.lines = 513;
    const Pose pose{{0, -1.5f, 0}, Quat(1, 0, 0, 0), 1};
    const Gathered exact(striped(), model, settings, 0, pose);
    const Gathered shared(striped(), model, settings, 4, pose);
    EXPECT_LT(meanDifference(exact, shared), 0.06);
}

}  // namespace
}  // namespace vlf::test
