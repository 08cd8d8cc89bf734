#include "vlf/scene/cut_planes.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <utility>

namespace vlf::test {

namespace {

using Place = std::array<float, 3>;

Place placeOf(const Vec3& p) {
    return {p.x, p.y, p.z};
}

/// How often each edge occurs, by the places of its ends.
std::map<std::pair<Place, Place>, int> countEdges(const Scene& scene) {
    std::map<std::pair<Place, Place>, int> count;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        for (int c = 0; c < 3; ++c) {
            const Place a = placeOf(scene.position(t, c)),
                        b = placeOf(scene.position(t, (c + 1) % 3));
            ++count[std::minmax(a, b)];
        }
    return count;
}

double areaOf(const Scene& scene) {
    double sum = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) sum += area(scene, t);
    return sum;
}

const AxisPlanes kPlanes{{{0.37f, 0.9f, 1.71f}, {0.5f, 1}, {0.3f, 1.1f}}};

Scene ballAndBox() {
    SceneBuilder b;
    const std::uint32_t white = b.material("white", Vec3(0.8f));
    b.sphere({1, 1, 1}, 1, 2, false, white);
    b.box({4, 0, 0}, {5, 1, 1}, true, b.material("grey", Vec3(0.5f)));
    return b.scene();
}

}  // namespace

TEST(CutByPlanes, LeavesNoGapWhereTrianglesMeet) {
    Scene scene = ballAndBox();
    const std::size_t before = scene.triangles.size();
    const std::vector<std::uint32_t> sources =
        cutByPlanes(scene, kPlanes, 1e-3f, std::vector<bool>(before, true));
    ASSERT_EQ(sources.size(), scene.triangles.size());
    EXPECT_GT(scene.triangles.size(), before + 100);
    for (const auto& [edge, count] : countEdges(scene)) EXPECT_EQ(count, 2);
}

TEST(CutByPlanes, LeavesTheSurfaceWhatItWas) {
    const Scene whole = ballAndBox();
    Scene scene = whole;
    const std::vector<std::uint32_t> sources =
        cutByPlanes(scene, kPlanes, 1e-3f, std::vector<bool>(whole.triangles.size(), true));
    EXPECT_NEAR(areaOf(scene) / areaOf(whole), 1, 1e-5);
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        EXPECT_EQ(scene.triangles[t].material, whole.triangles[sources[t]].material);
        const Vec3 normal = geometricNormal(scene, t);
        EXPECT_GT(glm::dot(normal, geometricNormal(whole, sources[t])), 0.9999f);
        EXPECT_GT(glm::dot(normal, shadingNormalAt(scene, t, Vec2(1.0f / 3))), 0.9f);
    }
    ASSERT_EQ(scene.meshes.size(), whole.meshes.size());
    std::uint32_t next = 0;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        EXPECT_EQ(scene.meshes[m].firstTriangle, next);
        next += scene.meshes[m].triangleCount;
        const Mesh& source = whole.meshes[m];
        for (std::uint32_t t = scene.meshes[m].firstTriangle; t < next; ++t)
            EXPECT_LT(sources[t] - source.firstTriangle, source.triangleCount);
    }
    EXPECT_EQ(next, scene.triangles.size());
}

TEST(CutByPlanes, LeavesNoTriangleAcrossAPlane) {
    Scene scene = ballAndBox();
    constexpr float kTolerance = 1e-3f;
    cutByPlanes(scene, kPlanes, kTolerance, std::vector<bool>(scene.triangles.size(), true));
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        for (int axis = 0; axis < 3; ++axis)
            for (const float plane : kPlanes[axis]) {
                int below = 0, above = 0;
                for (int c = 0; c < 3; ++c) {
                    const float d = scene.position(t, c)[axis] - plane;
                    below += d < -kTolerance;
                    above += d > kTolerance;
                }
                EXPECT_FALSE(below > 0 && above > 0);
            }
}

TEST(CutByPlanes, CutsWhatIsConnectedButNoLamps) {
    SceneBuilder b;
    const std::uint32_t white = b.material("white", Vec3(0.8f));
    b.quad({0, 0, 0}, {2, 0, 0}, {0, 0, 2}, white);  // chosen
    b.quad({0, 0, 2}, {2, 0, 0}, {0, 2, 0}, white);  // beside it
    b.quad({0, 5, 0}, {2, 0, 0}, {0, 0, 2}, white);  // elsewhere
    b.quad({2, 0, 0}, {2, 0, 0}, {0, 0, 2}, b.material("lamp", Vec3(0), Vec3(1)));
    Scene scene = b.scene();
    std::vector<bool> chosen(scene.triangles.size());
    chosen[0] = true;
    const std::vector<std::uint32_t> sources =
        cutByPlanes(scene, {{{1, 3}, {}, {1}}}, 1e-3f, chosen);
    std::array<int, 8> parts{};
    for (const std::uint32_t s : sources) ++parts[s];
    EXPECT_GT(parts[0], 1);
    EXPECT_GT(parts[1], 1);
    EXPECT_GT(parts[2] + parts[3], 2);
    EXPECT_EQ(parts[4] + parts[5] + parts[6] + parts[7], 4);
}

}  // namespace vlf::test
