#include "vlf/math/spherical_harmonics.h"

#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

Sh<float> someCoefficients(std::uint64_t key) {
    RandomStream random(3, key);
    Sh<float> coefficients;
    for (float& c : coefficients) c = random.next() - 0.5f;
    return coefficients;
}

Quat someRotation(std::uint64_t key) {
    RandomStream random(4, key);
    const Vec2 u = random.next2();
    return glm::quat_cast(sampleUniformRotation({u.x, u.y, random.next()}));
}

/// Midpoint rule in height and azimuth: shares nothing with the quadrature of projectSh.
template <class Function>
double integrate(Function f) {
    constexpr int kHeights = 400, kAzimuths = 64;
    double sum = 0;
    for (int i = 0; i < kHeights; ++i)
        for (int j = 0; j < kAzimuths; ++j)
            sum += f(sampleUniformSphere({(i + 0.5f) / kHeights, (j + 0.5f) / kAzimuths}));
    return sum * 4 * std::numbers::pi / (kHeights * kAzimuths);
}

TEST(SphericalHarmonics, AreOrthonormal) {
    for (int i = 0; i < kMaxShCount; ++i)
        for (int j = 0; j <= i; ++j)
            EXPECT_NEAR(integrate([&](const Vec3& d) { return shBasis(d)[i] * shBasis(d)[j]; }),
                        i == j ? 1 : 0, 2e-4)
                << i << ' ' << j;
}

TEST(SphericalHarmonics, BandsAreInvariantUnderRotation) {
    // The addition theorem: Σ_m Y_lm(a) Y_lm(b) = (2l + 1)/4π P_l(a·b), 1 where a = b.
    RandomStream random(1, 0);
    for (int trial = 0; trial < 100; ++trial) {
        const Sh<float> basis = shBasis(sampleUniformSphere(random.next2()));
        for (int l = 0, i = 0; l < kMaxShOrder; ++l) {
            float sum = 0;
            for (; i < shCount(l + 1); ++i) sum += basis[i] * basis[i];
            EXPECT_NEAR(sum, (2 * l + 1) / (4 * kPi), 1e-5f);
        }
    }
}

TEST(SphericalHarmonics, BandOfAFunction) {
    EXPECT_EQ(shBand(0), 0);
    EXPECT_EQ(shBand(3), 1);
    EXPECT_EQ(shBand(4), 2);
    EXPECT_EQ(shBand(24), 4);
}

TEST(SphericalHarmonics, ProjectionFindsTheCoefficientsAgain) {
    const Sh<float> coefficients = someCoefficients(0);
    const Sh<float> found = projectSh([&](const Vec3& d) { return shValue(coefficients, d); });
    for (int i = 0; i < kMaxShCount; ++i) EXPECT_NEAR(found[i], coefficients[i], 1e-5f);
}

TEST(SphericalHarmonics, RotatedCoefficientsAreThoseOfTheRotatedFunction) {
    RandomStream random(2, 0);
    for (int trial = 0; trial < 20; ++trial) {
        const Sh<float> coefficients = someCoefficients(trial);
        const Quat rotation = someRotation(trial);
        const Sh<float> rotated = rotateSh(coefficients, rotation);
        for (int i = 0; i < 50; ++i) {
            const Vec3 d = sampleUniformSphere(random.next2());
            EXPECT_NEAR(shValue(rotated, rotation * d), shValue(coefficients, d), 1e-5f);
        }
    }
}

TEST(SphericalHarmonics, RotationKeepsBandsApart) {
    Sh<float> coefficients{};
    coefficients[6] = 1;
    const Sh<float> rotated = rotateSh(coefficients, someRotation(1));
    for (int i = 0; i < kMaxShCount; ++i)
        EXPECT_NEAR(shBand(i) == 2 ? 0 : rotated[i], 0, 1e-6f) << i;
}

TEST(SphericalHarmonics, IrradianceOfConstantRadianceIsPiTimesIt) {
    const Sh<float> radiance = projectSh([](const Vec3&) { return 2.5f; });
    RandomStream random(5, 0);
    for (int i = 0; i < 20; ++i)
        EXPECT_NEAR(shIrradiance(radiance, sampleUniformSphere(random.next2())), 2.5f * kPi, 1e-4f);
}

TEST(SphericalHarmonics, IrradianceIsTheCosineWeightedIntegralOfRadiance) {
    const Sh<float> radiance = someCoefficients(9);
    for (int trial = 0; trial < 5; ++trial) {
        const Vec3 n = someRotation(trial) * Vec3(0, 0, 1);
        const double truth = integrate(
            [&](const Vec3& d) { return shValue(radiance, d) * std::max(0.0f, glm::dot(n, d)); });
        EXPECT_NEAR(shIrradiance(radiance, n), truth, 1e-3);
    }
}

}  // namespace
}  // namespace vlf
