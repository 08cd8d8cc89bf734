#include "vlf/math/glass.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vlf {
namespace {

constexpr float kIors[] = {1.0f, 1.33f, 1.5f, 2.4f};

TEST(Fresnel, ReflectsTheKnownShareAtNormalIncidence) {
    for (const float n : kIors)
        EXPECT_NEAR(fresnelReflectance(1, n), std::pow((n - 1) / (n + 1), 2), 1e-6);
    EXPECT_NEAR(fresnelReflectance(1, 1 / 1.5f), 0.04f, 1e-6);
}

TEST(Fresnel, ReflectsHalfTheCrossPolarisedLightAtBrewstersAngle) {
    const double n = 1.5, angle = std::atan(n);
    const double beyond = std::asin(std::sin(angle) / n);
    const double across = std::pow(std::sin(angle - beyond) / std::sin(angle + beyond), 2);
    EXPECT_NEAR(fresnelReflectance(static_cast<float>(std::cos(angle)), 1.5f), 0.5 * across, 1e-6);
}

TEST(Fresnel, ReflectsAllBeyondTheCriticalAngleAndAtGrazingAngles) {
    const double critical = std::asin(1 / 1.5);
    EXPECT_EQ(fresnelReflectance(static_cast<float>(std::cos(critical + 0.001)), 1 / 1.5f), 1);
    EXPECT_LT(fresnelReflectance(static_cast<float>(std::cos(critical - 0.02)), 1 / 1.5f), 0.6f);
    EXPECT_NEAR(fresnelReflectance(0, 1.5f), 1, 1e-6);
}

TEST(Fresnel, IsTheSameFromEitherSide) {
    for (const float n : kIors)
        for (float c = 0.05f; c <= 1; c += 0.05f) {
            const float beyond = std::sqrt(1 - (1 - c * c) / (n * n));
            EXPECT_NEAR(fresnelReflectance(c, n), fresnelReflectance(beyond, 1 / n), 2e-5) << n;
        }
}

TEST(PaneReflectance, IsTheSumOfAllReflections) {
    for (const float c : {0.1f, 0.5f, 1.0f}) {
        const double r = fresnelReflectance(c, 1.5f), t = 1 - r;
        double sum = r, within = t * r * t;
        for (int i = 0; i < 200; ++i, within *= r * r) sum += within;
        EXPECT_NEAR(paneReflectance(c, 1.5f), sum, 1e-6);
    }
}

class GlassSplits : public testing::Test {
  protected:
    /// Calls check(split, incoming, normal, outside) for random rays and shading normals.
    template <class Check>
    void forRandomRays(const GlassMedium& medium, Check check) {
        RandomStream random(1, 2);
        for (int i = 0; i < 2000; ++i) {
            const Vec3 normal = sampleUniformSphere(random.next2());
            Vec3 incoming = sampleUniformSphere(random.next2());
            if (glm::dot(incoming, normal) > 0) incoming = -incoming;
            Vec3 shading = glm::normalize(normal + 0.3f * sampleUniformSphere(random.next2()));
            const bool outside = random.next() < 0.5f;
            check(splitAtGlass(medium, incoming, shading, normal, outside), incoming, normal,
                  outside);
        }
    }
};

TEST_F(GlassSplits, KeepTheEnergyAndTheSides) {
    for (const bool thin : {true, false})
        forRandomRays({1.5f, thin}, [&](const GlassSplit& s, const Vec3&, const Vec3& n, bool) {
            EXPECT_NEAR(s.reflectance + s.transmittance, 1, 1e-6);
            EXPECT_GT(glm::dot(s.reflected, n), 0);
            EXPECT_NEAR(glm::length(s.reflected), 1, 1e-5);
            if (s.transmittance <= 0) return;
            EXPECT_LT(glm::dot(s.transmitted, n), 0);
            EXPECT_NEAR(glm::length(s.transmitted), 1, 1e-4);
        });
}

TEST_F(GlassSplits, ScaleRadianceByTheSquareOfTheIndexAndBack) {
    forRandomRays({1.6f, false}, [](const GlassSplit& s, const Vec3&, const Vec3&, bool outside) {
        EXPECT_NEAR(s.radianceScale, outside ? 1 / (1.6f * 1.6f) : 1.6f * 1.6f, 1e-5);
    });
    forRandomRays({1.6f, true}, [](const GlassSplit& s, const Vec3& incoming, const Vec3&, bool) {
        EXPECT_EQ(s.radianceScale, 1);
        EXPECT_EQ(s.transmitted, incoming);
    });
}

TEST(SplitAtGlass, RefractsBySnellsLaw) {
    const Vec3 normal(0, 0, 1), incoming = glm::normalize(Vec3(0.6f, 0, -0.8f));
    const GlassSplit in = splitAtGlass({1.5f, false}, incoming, normal, normal, true);
    EXPECT_NEAR(in.transmitted.x, 0.6f / 1.5f, 1e-6);
    // Out again through a parallel face: as it came, of what it lost twice.
    const GlassSplit out = splitAtGlass({1.5f, false}, in.transmitted, normal, normal, false);
    EXPECT_NEAR(out.transmitted.x, incoming.x, 1e-6);
    EXPECT_NEAR(in.radianceScale * out.radianceScale, 1, 1e-6);
    EXPECT_NEAR(in.reflectance, out.reflectance, 1e-5);
}

TEST(SplitAtGlass, ReflectsTotallyFromWithin) {
    const Vec3 normal(0, 0, 1), incoming = glm::normalize(Vec3(0.8f, 0, -0.6f));
    const GlassSplit split = splitAtGlass({1.5f, false}, incoming, normal, normal, false);
    EXPECT_EQ(split.reflectance, 1);
    EXPECT_EQ(split.transmittance, 0);
}

TEST(FollowGlass, FollowsBothRaysUntilOneIsNotWorthIt) {
    const Vec3 normal(0, 0, 1), incoming(0, 0, -1);
    const GlassSplit split = splitAtGlass({1.5f, false}, incoming, normal, normal, true);
    const auto sumOf = [&](float throughput, int& rays) {
        Vec3 sum(0);
        rays = 0;
        followGlass(split, Vec3(1), Vec3(throughput), [&](const Vec3&, float, const Vec3& weight) {
            sum += weight;
            ++rays;
        });
        return sum.x;
    };
    int rays = 0;
    EXPECT_NEAR(sumOf(1, rays), 0.04f + 0.96f / 2.25f, 1e-5);
    EXPECT_EQ(rays, 2);
    EXPECT_NEAR(sumOf(0.4f, rays), 0.96f / 2.25f, 1e-5);
    EXPECT_EQ(rays, 1);
}

TEST(MeanReflectance, IsThatOfDiffuseLight) {
    EXPECT_NEAR(meanReflectance([](float c) { return c; }), 2.0 / 3, 1e-3);
    EXPECT_NEAR(meanReflectance([](float c) { return fresnelReflectance(c, 1.5f); }), 0.0918, 1e-3);
}

}  // namespace
}  // namespace vlf
