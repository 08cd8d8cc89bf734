#include "vlf/trace/ray_instances.h"

#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/scene/generate/primitives.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace vlf {
namespace {

struct Model {
    Scene scene;
    RayScene rays;
    explicit Model(const std::string& name) : scene(makePrimitive(name, {})), rays(scene) {}
};

/// The same triangles as instances and as one scene.
struct Posed {
    std::vector<RayInstance> instances;
    Scene scene;
    std::vector<std::uint32_t> firstTriangle;  ///< by instance

    void add(const Model& model, const Pose& pose) {
        instances.push_back({&model.rays, pose});
        firstTriangle.push_back(static_cast<std::uint32_t>(scene.triangles.size()));
        Scene copy = model.scene;
        for (Vec3& p : copy.positions) p = pose.point(p);
        for (Vec3& n : copy.normals) n = pose.direction(n);
        append(scene, copy);
    }
};

const std::vector<Model>& models() {
    static const std::vector<Model> all = [] {
        std::vector<Model> made;
        for (const char* name : {"cube", "sphere", "knot"}) made.emplace_back(name);
        return made;
    }();
    return all;
}

/// `count` bodies about the origin, turned anyhow and 0.16 to 2.5 times `scale` large.
Posed someBodies(int count, float scale, std::uint64_t seed) {
    Posed posed;
    RandomStream random(seed, 0);
    for (int i = 0; i < count; ++i) {
        Pose pose;
        for (int axis = 0; axis < 3; ++axis)
            pose.translation[axis] = 3 * scale * (random.next() - 0.5f);
        const Mat3 turn = sampleUniformRotation(Vec3(random.next2(), random.next()));
        pose.rotation = glm::normalize(glm::quat_cast(turn));
        pose.scale = scale * std::pow(10.0f, 1.2f * random.next() - 0.8f);
        posed.add(models()[static_cast<std::size_t>(i) % models().size()], pose);
    }
    return posed;
}

std::vector<Ray> someRays(int count, float scale, std::uint64_t seed) {
    std::vector<Ray> rays;
    RandomStream random(seed, 1);
    for (int i = 0; i < count; ++i) {
        Ray ray;
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = 8 * scale * (random.next() - 0.5f);
            ray.direction[axis] = 4 * scale * (random.next() - 0.5f) - ray.origin[axis];
        }
        ray.direction = glm::normalize(ray.direction);
        if (i % 3 == 0) ray.tMax = 4 * scale * random.next();
        if (i % 5 == 0) ray.tMin = scale * random.next();
        rays.push_back(ray);
    }
    return rays;
}

void expectSameHits(const RayInstances& found, const Posed& posed, const std::vector<Ray>& rays,
                    float scale) {
    const RayScene truth(posed.scene);
    std::vector<InstanceHit> hits(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    found.closest(rays, hits);
    found.occluded(rays, blocked);
    int others = 0, met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit hit = truth.closest(rays[i]);
        met += static_cast<bool>(hit);
        // Rays that graze an edge may go either way.
        others += static_cast<bool>(hit) != static_cast<bool>(hits[i]) ||
                  truth.occluded(rays[i]) != static_cast<bool>(blocked[i]);
        if (!hit || !hits[i]) continue;
        others += posed.firstTriangle[hits[i].instance] + hits[i].hit.triangle != hit.triangle;
        if (std::abs(hits[i].hit.t - hit.t) > 1e-4f * (scale + hit.t)) ++others;
        const InstanceHit single = found.closest(rays[i]);
        others += single.hit.triangle != hits[i].hit.triangle ||
                  found.occluded(rays[i]) != static_cast<bool>(blocked[i]);
    }
    EXPECT_GT(met, static_cast<int>(rays.size()) / 100);
    EXPECT_LE(others, static_cast<int>(rays.size()) / 500);
}

TEST(RayInstances, AreMetAsTheirTrianglesWouldBe) {
    for (const float scale : {1.0f, 1e-3f, 1e3f}) {
        SCOPED_TRACE(scale);
        const Posed posed = someBodies(7, scale, 3);
        RayInstances instances;
        instances.place(posed.instances);
        EXPECT_FALSE(instances.empty());
        expectSameHits(instances, posed, someRays(2000, scale, 4), scale);
    }
}

TEST(RayInstances, AreMetWhereTheyWereLastPlaced) {
    RayInstances instances;
    // The same number of the same bodies elsewhere, fewer, more, and in another order.
    for (const auto& [count, seed] : {std::pair{6, 1}, {6, 2}, {2, 3}, {7, 4}}) {
        SCOPED_TRACE(seed);
        const Posed posed = someBodies(count, 1, static_cast<std::uint64_t>(seed));
        instances.place(posed.instances);
        expectSameHits(instances, posed, someRays(1000, 1, 5), 1);
    }
    Posed turned;
    const Posed before = someBodies(3, 1, 6);
    for (int i = 2; i >= 0; --i)
        turned.add(models()[static_cast<std::size_t>(i)],
                   before.instances[static_cast<std::size_t>(i)].pose);
    instances.place(before.instances);
    instances.place(turned.instances);
    expectSameHits(instances, turned, someRays(1000, 1, 7), 1);
}

TEST(RayInstances, AllButOneAreMetAsIfItWereNotThere) {
    const Posed all = someBodies(6, 1, 10);
    RayInstances instances, others;
    instances.place(all.instances);
    const std::vector<Ray> rays = someRays(4000, 1, 11);
    int passed = 0;
    std::vector<InstanceHit> found(rays.size()), expected(rays.size()), any(rays.size());
    instances.closest(rays, any);
    for (const std::uint32_t excluded : {0u, 2u, 5u}) {
        std::vector<RayInstance> rest = all.instances;
        rest.erase(rest.begin() + excluded);
        others.place(rest);
        others.closest(rays, expected);
        instances.closestBut(excluded, rays, found);
        int different = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const std::uint32_t number =
                expected[i].instance + (expected[i].instance >= excluded ? 1 : 0);
            different += static_cast<bool>(found[i]) != static_cast<bool>(expected[i]) ||
                         (found[i] && found[i].instance != number);
            passed += found[i] && any[i].instance == excluded;
        }
        EXPECT_EQ(different, 0);
    }
    EXPECT_GT(passed, 10);
}

TEST(RayInstances, NoneAreMetByNothing) {
    RayInstances instances;
    const std::vector<Ray> rays = someRays(10, 1, 8);
    const auto expectNothing = [&] {
        std::vector<InstanceHit> hits(rays.size());
        std::vector<std::uint8_t> blocked(rays.size(), 1);
        instances.closest(rays, hits);
        instances.occluded(rays, blocked);
        EXPECT_TRUE(instances.empty());
        for (std::size_t i = 0; i < rays.size(); ++i) {
            EXPECT_FALSE(hits[i]);
            EXPECT_FALSE(blocked[i]);
            EXPECT_FALSE(instances.closest(rays[i]));
            EXPECT_FALSE(instances.occluded(rays[i]));
        }
    };
    expectNothing();
    instances.place(someBodies(3, 1, 9).instances);
    instances.place({});
    expectNothing();
}

}  // namespace
}  // namespace vlf
