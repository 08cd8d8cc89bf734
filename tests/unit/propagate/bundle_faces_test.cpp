// Flat charts that are convex are swept as a fan of few triangles, with the same exchanges.

#include "swept_scene.h"

#include "vlf/scene/generate/generate.h"

#include <gtest/gtest.h>

#include <functional>

namespace vlf::test {

namespace {

constexpr float kTexel = 0.05f;

/// A lid one metre above the tiles of an n x n unit square of which `isThere` says so, face to
/// face.
Scene tiles(int n, const std::function<bool(int, int)>& isThere) {
    SceneBuilder b;
    const std::uint32_t grey = b.material("grey", Vec3(0.5f));
    const float side = 1.0f / n;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            if (isThere(i, j)) b.quad({i * side, 0, j * side}, {0, 0, side}, {side, 0, 0}, grey);
    addSquare(b, 1, false, grey);
    return b.scene();
}

std::size_t facesOf(const Scene& scene) {
    return SweptScene(scene, kTexel).faces.count - 2;  // without the lid
}

bool everywhere(int, int) {
    return true;
}

/// What the lower surface gathers from the lid.
SweptScene::Sum gatheredByFloor(const Scene& scene) {
    SweptScene s(scene, kTexel);
    s.setRadiance(static_cast<std::uint32_t>(scene.triangles.size()) - 1, {1, 2, 3});
    s.sweep(glm::normalize(Vec3(0.2f, 1, 0.1f)), 500, 0.3f);
    return s.gatheredBy(0);
}

}  // namespace

TEST(BundleFaces, AConvexFlatChartIsAFanHoweverManyTrianglesItHas) {
    EXPECT_EQ(facesOf(tiles(1, everywhere)), 2u);
    EXPECT_EQ(facesOf(tiles(8, everywhere)), 2u);
}

TEST(BundleFaces, AChartThatIsNotConvexKeepsItsTriangles) {
    EXPECT_EQ(facesOf(tiles(2, [](int i, int j) { return i == 0 || j == 0; })), 6u);
    EXPECT_EQ(facesOf(tiles(4, [](int i, int j) { return i != 1 || j != 1; })), 30u) << "a hole";
}

TEST(BundleFaces, AFanGathersWhatItsTrianglesWould) {
    const SweptScene::Sum whole = gatheredByFloor(tiles(1, everywhere));
    const SweptScene::Sum tiled = gatheredByFloor(tiles(8, everywhere));
    EXPECT_GT(whole.samples, 20000);
    EXPECT_NEAR(tiled.samples, whole.samples, 2e-4 * whole.samples);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(tiled.rgb[c], whole.rgb[c], 2e-4 * whole.rgb[c]);
}

}  // namespace vlf::test
