#include "vlf/trace/bvh.h"

#include "vlf/base/parallel.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/scene/generate/generate.h"
#include "vlf/trace/ray_scene.h"

#include "support/analytic_scenes.h"
#include "support/bvh_search.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>

namespace vlf {
namespace {

constexpr int kRays = 20000;

/// A scene of loose triangles, three vertices each.
Scene looseTriangles(const std::vector<Vec3>& vertices) {
    Scene scene;
    scene.positions = vertices;
    scene.normals.assign(vertices.size(), {0, 0, 1});
    scene.uvs.assign(vertices.size(), Vec2(0));
    scene.materials.resize(1);
    for (std::uint32_t i = 0; i + 2 < vertices.size(); i += 3)
        scene.triangles.push_back({{i, i + 1, i + 2}, 0});
    return scene;
}

Scene copies(int count) {
    std::vector<Vec3> vertices;
    for (int i = 0; i < count; ++i)
        vertices.insert(vertices.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    return looseTriangles(vertices);
}

/// Triangles whose size and distance from the origin halve from one to the next: splits by surface
/// area take off a few at a time.
Scene shrinkingTriangles(int sizes, int copiesOfEach) {
    std::vector<Vec3> vertices;
    for (int i = 0; i < sizes; ++i)
        for (int k = 0; k < copiesOfEach; ++k) {
            const float s = std::ldexp(1.0f, sizes / 2 - i);
            vertices.insert(vertices.end(), {{s, 0, 0}, {s, s / 4, 0}, {s, 0, s / 4}});
        }
    return looseTriangles(vertices);
}

Ray randomRay(const Bounds& bounds, RandomStream& random) {
    Ray ray;
    const Vec3 u(random.next(), random.next(), random.next());
    ray.origin = bounds.lower + u * bounds.size();
    ray.direction = sampleUniformSphere(random.next2());
    return ray;
}

/// The hits may be of two triangles only where both are met at the same distance. `epsilon` is how
/// well a place in the scene is known: within it, distances differ by the rounding of coordinates.
bool agree(const Hit& a, const Hit& b, float epsilon) {
    if (!a || !b) return !a && !b;
    return std::abs(a.t - b.t) <= epsilon + 1e-5f * std::max(a.t, b.t);
}

template <typename T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

void expectEachTriangleOnce(const Bvh& bvh, const Scene& scene) {
    std::vector<int> seen(scene.triangles.size());
    std::uint32_t next = 0;
    for (const BvhNode& node : bvh.nodes) {
        if (node.count() == 0) continue;
        EXPECT_EQ(node.first(), next);
        EXPECT_LE(node.count(), Bvh::kMaxLeafSize);
        next += node.count();
    }
    EXPECT_EQ(next, bvh.triangles.size());
    for (const BvhTriangle& triangle : bvh.triangles) ++seen.at(triangle.sceneTriangle());
    EXPECT_EQ(seen, std::vector<int>(seen.size(), 1));
}

bool holds(const BvhNode& box, const Vec3& lower, const Vec3& upper) {
    return glm::min(lower, box.lower) == box.lower && glm::max(upper, box.upper) == box.upper;
}

/// Expects the nodes [begin, end), side by side or below each other, to lie in their parents' boxes
/// and to name the next one rightly; returns the number of levels.
int expectNested(const Bvh& bvh, std::uint32_t begin, std::uint32_t end, const BvhNode* parent) {
    int levels = 0;
    std::uint32_t at = begin;
    for (; at < end; at = bvh.nodes[at].next()) {
        const BvhNode& node = bvh.nodes[at];
        EXPECT_TRUE(!parent || holds(*parent, node.lower, node.upper)) << at;
        if (node.next() <= at || node.next() > end) {
            ADD_FAILURE() << at << " goes on with " << node.next();
            return levels;
        }
        EXPECT_TRUE(node.count() == 0 || node.next() == at + 1) << at;
        levels = std::max(levels, 1 + expectNested(bvh, at + 1, node.next(), &node));
    }
    EXPECT_EQ(at, end);
    return levels;
}

void expectTrianglesInBoxes(const Bvh& bvh, const Scene& scene) {
    for (const BvhNode& node : bvh.nodes)
        for (std::uint32_t i = 0; i < node.count(); ++i) {
            const BvhTriangle& triangle = bvh.triangles[node.first() + i];
            for (int corner = 0; corner < 3; ++corner) {
                const Vec3& v = scene.position(triangle.sceneTriangle(), corner);
                EXPECT_TRUE(holds(node, v, v));
            }
        }
}

/// Returns the number of levels.
int expectSound(const Bvh& bvh, const Scene& scene) {
    expectEachTriangleOnce(bvh, scene);
    expectTrianglesInBoxes(bvh, scene);
    return expectNested(bvh, 0, static_cast<std::uint32_t>(bvh.nodes.size()), nullptr);
}

class BvhOfScene : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Generated, BvhOfScene,
                         testing::Values("cornell", "mirror-room", "gallery", "office"),
                         [](const auto& instance) {
                             std::string name = instance.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST_P(BvhOfScene, HoldsEveryTriangleOnceWithinItsBoxes) {
    const Scene scene = generateScene(GetParam());
    expectSound(buildBvh(scene), scene);
}

TEST_P(BvhOfScene, GivesTheHitsOfTheRayTracingKernels) {
    const Scene scene = generateScene(GetParam());
    const Bvh bvh = buildBvh(scene);
    const RayScene kernels(scene);
    const Bounds bounds = boundsOf(scene);
    RandomStream random(1, 0);
    int different = 0, otherTriangle = 0;
    for (int i = 0; i < kRays; ++i) {
        const Ray ray = randomRay(bounds, random);
        const Hit hit = test::closest(bvh, ray), expected = kernels.closest(ray);
        different += !agree(hit, expected, kernels.epsilon());
        otherTriangle += hit.triangle != expected.triangle;
    }
    EXPECT_EQ(different, 0);
    EXPECT_LE(otherTriangle, kRays / 1000);
}

TEST_P(BvhOfScene, SearchesLittleOfTheScene) {
    const Scene scene = generateScene(GetParam());
    const Bvh bvh = buildBvh(scene);
    RandomStream random(2, 0);
    test::SearchCost cost;
    for (int i = 0; i < kRays; ++i) test::closest(bvh, randomRay(boundsOf(scene), random), &cost);
    EXPECT_LE(cost.boxes, 40 * kRays);
    EXPECT_LE(cost.triangles, 8 * kRays);
}

TEST_P(BvhOfScene, IsTheSameForAnyNumberOfThreads) {
    const Scene scene = generateScene(GetParam());
    const Bvh first = buildBvh(scene);
    for (int threads : {1, 2, 3, 8}) {
        const ThreadLimit limit(threads);
        const Bvh again = buildBvh(scene);
        EXPECT_TRUE(sameBits(first.nodes, again.nodes)) << threads;
        EXPECT_TRUE(sameBits(first.triangles, again.triangles)) << threads;
    }
}

TEST(Bvh, OfManyTrianglesInOnePlaceIsShallow) {
    const Scene scene = copies(10000);
    const Bvh bvh = buildBvh(scene);
    EXPECT_LE(expectSound(bvh, scene), 16);
    EXPECT_FLOAT_EQ(test::closest(bvh, {{0.2f, 0.2f, 2}, {0, 0, -1}}).t, 2);
}

TEST(Bvh, OfManyTrianglesInOnePlaceIsTheSameForAnyNumberOfThreads) {
    const Scene scene = copies(10000);
    const Bvh first = buildBvh(scene);
    for (int threads : {1, 2, 8}) {
        const ThreadLimit limit(threads);
        EXPECT_TRUE(sameBits(first.triangles, buildBvh(scene).triangles)) << threads;
    }
}

TEST(Bvh, IsSoundWhereSplitsTakeOffFewTriangles) {
    const Scene scene = shrinkingTriangles(110, 100);
    EXPECT_LE(expectSound(buildBvh(scene), scene), 100);
}

TEST(Bvh, OfOneTriangleHitsItAndMissesBesideIt) {
    const Scene scene = copies(1);
    const Bvh bvh = buildBvh(scene);
    expectSound(bvh, scene);
    const Hit hit = test::closest(bvh, {{0.25f, 0.5f, 1}, {0, 0, -2}});
    EXPECT_EQ(hit.triangle, 0u);
    EXPECT_FLOAT_EQ(hit.t, 0.5f);
    EXPECT_FLOAT_EQ(hit.barycentric.x, 0.25f);
    EXPECT_FLOAT_EQ(hit.barycentric.y, 0.5f);
    EXPECT_FALSE(test::closest(bvh, {{0.75f, 0.5f, 1}, {0, 0, -1}}));
    EXPECT_FALSE(test::closest(bvh, {{0.25f, 0.5f, 1}, {0, 0, 1}}));
}

TEST(Bvh, IsNotHitInTrianglesThatAreAPointOrALine) {
    const Scene scene = looseTriangles({{0, 0, 0},
                                        {0, 0, 0},
                                        {0, 0, 0},  //
                                        {0, 0, 0},
                                        {1, 0, 0},
                                        {2, 0, 0}});
    const Bvh bvh = buildBvh(scene);
    expectSound(bvh, scene);
    EXPECT_FALSE(test::closest(bvh, {{0, 0, 1}, {0, 0, -1}}));
    EXPECT_FALSE(test::closest(bvh, {{-1, 0, 0}, {1, 0, 0}}));
    EXPECT_FALSE(test::closest(bvh, {{0.5f, 0.5f, 0}, {0, -1, 0}}));
}

TEST(Bvh, LetsNoRayThroughAnEdge) {
    const Scene scene = test::furnaceSphere(Vec3(0), Vec3(0), 3);
    const Bvh bvh = buildBvh(scene);
    RandomStream random(4, 0);
    int missed = 0;
    for (int i = 0; i < 5 * kRays; ++i) {
        const auto triangle = static_cast<std::uint32_t>(i) % scene.triangles.size();
        const float at = random.next();
        const Vec3 target =
            glm::mix(scene.position(triangle, i % 3), scene.position(triangle, (i + 1) % 3), at);
        const Vec3 origin = 0.5f * sampleUniformSphere(random.next2());
        missed += !test::closest(bvh, {origin, target - origin});
    }
    EXPECT_EQ(missed, 0);
}

TEST(Bvh, OfNothingMissesEverything) {
    const Bvh bvh = buildBvh(Scene{});
    EXPECT_TRUE(bvh.nodes.empty());
    EXPECT_TRUE(bvh.triangles.empty());
    RandomStream random(3, 0);
    for (int i = 0; i < 100; ++i)
        EXPECT_FALSE(test::closest(bvh, randomRay({Vec3(-1), Vec3(1)}, random)));
}

}  // namespace
}  // namespace vlf
