// Irradiance about the shading normal from rays that are spread about the surface's own.

#include "vlf/propagate/bent_texels.h"

#include "vlf/field/direction_set.h"
#include "vlf/trace/ray_scene.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vlf::test {

namespace {

float radianceFrom(const Vec3& direction) {
    return 1 + direction.x + 0.5f * direction.y * direction.z;
}

/// Mean of the radiance over directions above the surface, weighted by their cosine to `shading`.
double expectedMean(const Vec3& shading, const Vec3& geometric) {
    const DirectionSet directions(8193);
    double sum = 0, weights = 0;
    for (std::uint32_t i = 0; i < 2u * 8193; ++i) {
        const Vec3 d = i < 8193 ? directions.direction(i) : -directions.direction(i - 8193);
        if (glm::dot(d, geometric) <= 0 || glm::dot(d, shading) <= 0) continue;
        const double w = glm::dot(d, shading) * directions.weight(i % 8193);
        sum += w * radianceFrom(d);
        weights += w;
    }
    return sum / weights;
}

}  // namespace

TEST(BentTexels, GatherAboutTheShadingNormal) {
    const Vec3 geometric(0, 1, 0), shading = glm::normalize(Vec3(0.3f, 1, -0.1f));
    const std::vector<BentTexel> bent{{1, shading, geometric}};
    const DirectionSet directions(2049);
    std::vector<BentSum> gatheredSoFar;
    BentSums sums(bent, gatheredSoFar);
    TexelBuffer gathered(3);
    for (std::uint32_t i = 0; i < 2049; ++i) {
        const Vec3 d = directions.direction(i);
        const Vec3 seen = d.y > 0 ? d : -d;
        // Rays hit the texel in proportion to its projected area.
        const float hits = 100 * directions.weight(i) * std::abs(d.y);
        gathered.add(1, Vec3(hits * radianceFrom(seen)), hits);
        sums.take(d, gathered);
        ASSERT_EQ(gathered.weight(1), 0);
    }
    sums.putBack(gathered);
    const double expected = expectedMean(shading, geometric);
    EXPECT_GT(std::abs(expectedMean(geometric, geometric) / expected - 1), 0.05);
    EXPECT_NEAR(gathered.rgb(1).x / gathered.weight(1), expected, 2e-3 * expected);
}

TEST(BentTexels, AreThoseOfCoarseRoundBodiesAndNotOfFlatOnes) {
    SceneBuilder b;
    b.box(Vec3(-2), Vec3(2), true, b.material("wall", Vec3(0.5f), Vec3(1)));
    const std::size_t flat = b.scene().triangles.size();
    b.sphere(Vec3(0), 1, 1, false, b.material("ball", Vec3(0.5f)));
    const RayScene rays(b.scene());
    const Unwrap u = unwrap(b.scene(), rays, {0.05f});
    const std::vector<BentTexel> bent = findBentTexels(b.scene(), u);
    EXPECT_GT(bent.size(), 1000u);
    std::vector<bool> isBent(u.atlasSize(), false);
    for (const BentTexel& t : bent) isBent[t.texel] = true;
    for (std::size_t i = 0; i < u.texels.size(); ++i)
        if (u.points.of(i)[0].triangle < flat) {
            ASSERT_FALSE(isBent[u.texels[i]]);
        }
    for (const BentTexel& t : bent) ASSERT_GT(glm::dot(t.shading, t.geometric), 0.8f);
}

}  // namespace vlf::test
