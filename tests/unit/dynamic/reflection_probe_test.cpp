#include "vlf/dynamic/reflection_probe.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace vlf {
namespace {

/// The distance along a ray to the inside of a box of 4 x 2 x 6 m about the origin.
float toBox(const Ray& ray) {
    const Vec3 half(2, 1, 3);
    float t = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis)
        if (ray.direction[axis] != 0)
            t = std::min(t, (std::copysign(half[axis], ray.direction[axis]) - ray.origin[axis]) /
                                ray.direction[axis]);
    return t;
}

/// Its walls show where one is.
Vec3 colour(const Vec3& p) {
    return 0.5f + 0.1f * p;
}

ReflectionProbe boxProbe(int size) {
    ReflectionProbe probe;
    fillProbe(probe, {0.5f, -0.2f, 0.8f}, size,
              [](std::span<const Ray> rays, std::span<Vec3> radiance, std::span<float> from) {
                  for (std::size_t i = 0; i < rays.size(); ++i) {
                      from[i] = toBox(rays[i]);
                      radiance[i] = colour(rays[i].origin + from[i] * rays[i].direction);
                  }
              });
    return probe;
}

TEST(ReflectionProbe, TexelsAreLookedUpWhereTheyLie) {
    const ReflectionProbe probe = boxProbe(8);
    for (std::size_t i = 0; i < probe.texelCount(); ++i) {
        const ProbeView view = lookUp(probe, probe.centre, probe.direction(i));
        EXPECT_LT(maxComponent(glm::abs(view.radiance - probe.radiance[i])), 1e-5f) << i;
        EXPECT_NEAR(view.distance * probe.inverseDistance[i], 1, 1e-4f) << i;
    }
}

TEST(ReflectionProbe, RaysFromBesideTheCentreSeeWhatTheyMeet) {
    const ReflectionProbe probe = boxProbe(64);
    std::vector<Vec3> directions;
    for (std::size_t i = 0; i < probe.texelCount(); i += 37)
        directions.push_back(probe.direction(i));
    for (const Vec3& offset : {Vec3(0.3f, 0.2f, -0.1f), Vec3(-0.4f, -0.3f, 0.5f), Vec3(0)})
        for (const Vec3& d : directions) {
            const Ray ray{probe.centre + offset, d};
            const ProbeView view = lookUp(probe, ray.origin, d);
            const float distance = toBox(ray);
            EXPECT_NEAR(view.distance, distance, 0.03f * (1 + distance));
            const Vec3 off = view.radiance - colour(ray.origin + distance * d);
            EXPECT_LT(maxComponent(glm::abs(off)), 0.02f);
        }
}

TEST(ReflectionProbe, NothingIsFarAway) {
    ReflectionProbe probe;
    fillProbe(probe, Vec3(0), 4,
              [](std::span<const Ray> rays, std::span<Vec3> radiance, std::span<float> from) {
                  for (std::size_t i = 0; i < rays.size(); ++i) {
                      radiance[i] = Vec3(0);
                      from[i] = std::numeric_limits<float>::infinity();
                  }
              });
    for (const Vec3& origin : {Vec3(0), Vec3(0.1f, 0, 0.2f)}) {
        const ProbeView view = lookUp(probe, origin, {0, 0, 1});
        EXPECT_GT(view.distance, 50);
        EXPECT_EQ(view.radiance, Vec3(0));
    }
}

}  // namespace
}  // namespace vlf
