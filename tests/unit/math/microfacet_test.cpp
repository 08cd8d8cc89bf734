#include "vlf/math/microfacet.h"

#include "vlf/math/sampling.h"

#include "support/chi_square.h"

#include <gtest/gtest.h>

#include <vector>

namespace vlf {
namespace {

constexpr float kWidths[] = {0.05f, 0.1f, 0.3f, 0.6f, 1};
constexpr float kCosines[] = {1, 0.7f, 0.2f};

Vec3 directionAt(float cosine) {
    return {std::sqrt(1 - cosine * cosine), 0, cosine};
}

/// Bins of equal solid angle about the mirror direction, where the lobe is, finer towards it.
class LobeBins {
  public:
    explicit LobeBins(const Vec3& middle) : frame_(frameFromNormal(middle)) {}

    std::size_t of(const Vec3& direction) const {
        const Vec3 d = frame_.toLocal(direction);
        const float t = std::sqrt(std::sqrt(std::max(0.0f, (1 - d.z) / 2)));
        const float turn = std::atan2(d.y, d.x) / (2 * kPi) + 0.5f;
        const int row = std::clamp(static_cast<int>(t * kRows), 0, kRows - 1);
        return static_cast<std::size_t>(row) * kColumns +
               std::min(static_cast<int>(turn * kColumns), kColumns - 1);
    }

    /// Integral of `density` over each bin.
    template <class Density>
    std::vector<double> integrals(const Density& density) const {
        constexpr int kSteps = 40;
        std::vector<double> sums(kRows * kColumns, 0.0);
        for (int row = 0; row < kRows * kSteps; ++row)
            for (int column = 0; column < kColumns * kSteps; ++column) {
                // z of the row's limits, so that every step's solid angle is exact.
                const auto zAt = [](double t) { return 1 - 2 * t * t * t * t; };
                const double t0 = static_cast<double>(row) / (kRows * kSteps);
                const double t1 = static_cast<double>(row + 1) / (kRows * kSteps);
                const double z = (zAt(t0) + zAt(t1)) / 2;
                const double phi =
                    2 * kPi * ((column + 0.5) / (kColumns * kSteps)) - static_cast<double>(kPi);
                const double r = std::sqrt(std::max(0.0, 1 - z * z));
                const Vec3 d = frame_.toWorld(Vec3(r * std::cos(phi), r * std::sin(phi), z));
                const double solidAngle = 2 * kPi * (zAt(t0) - zAt(t1)) / (kColumns * kSteps);
                sums[static_cast<std::size_t>(row / kSteps) * kColumns + column / kSteps] +=
                    density(glm::normalize(d)) * solidAngle;
            }
        return sums;
    }

    static constexpr int kRows = 12, kColumns = 8;

  private:
    Frame frame_;
};

/// Bins too rare for the test become one.
void mergeRare(std::vector<double>& observed, std::vector<double>& expected) {
    std::vector<double> o{0}, e{0};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (expected[i] < 5)
            o[0] += observed[i], e[0] += expected[i];
        else
            o.push_back(observed[i]), e.push_back(expected[i]);
    }
    if (e[0] < 5) o.erase(o.begin()), e.erase(e.begin());
    observed = o, expected = e;
}

TEST(Microfacet, ReflectionsHaveTheirDensity) {
    constexpr int kSamples = 100000;
    for (const float alpha : kWidths)
        for (const float cosine : kCosines) {
            const Vec3 toEye = directionAt(cosine);
            const LobeBins bins(Vec3(-toEye.x, -toEye.y, toEye.z));
            std::vector<double> expected = bins.integrals(
                [&](const Vec3& d) { return kSamples * ggxDensity(alpha, toEye, d); });
            std::vector<double> observed(expected.size(), 0.0);
            RandomStream random(7, 0);
            for (int i = 0; i < kSamples; ++i)
                ++observed[bins.of(
                    glm::reflect(-toEye, sampleGgxNormal(alpha, toEye, random.next2())))];
            mergeRare(observed, expected);
            EXPECT_LT(test::chiSquareDeviation(observed, expected), 4)
                << "width " << alpha << ", cosine " << cosine;
        }
}

TEST(Microfacet, AlbedoIsTheIntegralOfTheLobe) {
    for (const float alpha : kWidths)
        for (const float cosine : kCosines) {
            const Vec3 toEye = directionAt(cosine);
            const LobeBins bins(Vec3(-toEye.x, -toEye.y, toEye.z));
            double sum = 0;
            for (const double share :
                 bins.integrals([&](const Vec3& d) { return ggxLobe(alpha, toEye, d); }))
                sum += share;
            EXPECT_NEAR(ggxAlbedo(alpha, cosine), sum, 0.005)
                << "width " << alpha << ", cosine " << cosine;
            EXPECT_LE(sum, 1.001);
        }
}

TEST(Microfacet, LobeIsReciprocal) {
    RandomStream random(3, 0);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 a = sampleCosineHemisphere(random.next2());
        const Vec3 b = sampleCosineHemisphere(random.next2());
        const float alpha = 0.05f + 0.95f * random.next();
        EXPECT_NEAR(ggxLobe(alpha, a, b) / b.z, ggxLobe(alpha, b, a) / a.z,
                    1e-3f * ggxLobe(alpha, a, b) / b.z + 1e-6f);
    }
}

TEST(Microfacet, NarrowLobesAreMirrors) {
    const Vec3 normal = glm::normalize(Vec3(1, 2, 3)), incoming = glm::normalize(Vec3(-1, -1, -3));
    RandomStream random(5, 0);
    for (int i = 0; i < 100; ++i) {
        const GlossyReflection r = sampleGgxReflection(1e-3f, incoming, normal, random.next2());
        EXPECT_GT(glm::dot(r.direction, glm::reflect(incoming, normal)), 0.99f);
        EXPECT_NEAR(r.weight, 1, 1e-3f);
    }
    EXPECT_NEAR(ggxMeanAlbedo(1e-3f), 1, 1e-3f);
    EXPECT_LT(ggxMeanAlbedo(1), 0.8f);
}

}  // namespace
}  // namespace vlf
