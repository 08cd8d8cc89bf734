#include "vlf/scene/import/cut_masks.h"
#include "unit/scene/import_support.h"
#include "vlf/math/random.h"
#include "vlf/scene/import/polygon_holes.h"
#include "vlf/scene/scene_hash.h"

#include <cmath>
#include <functional>

namespace vlf {
namespace {

/// An image of size x size whose alpha channel is opacity(x, y), with x, y in [0, 1], y up.
DecodedImage alphaChannel(int size, const std::function<float(double, double)>& opacity) {
    DecodedImage image{size, size, {}, {}, true};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const float a = opacity((x + 0.5) / size, 1 - (y + 0.5) / size);
            image.srgb8.insert(image.srgb8.end(), 3, 255);
            image.srgb8.push_back(static_cast<std::uint8_t>(std::lround(255 * a)));
        }
    return image;
}

/// Solid within `radius` around the middle; the border is one texel wide.
DecodedImage disc(int size, double radius) {
    return alphaChannel(size, [=](double x, double y) {
        const double inside = radius - std::hypot(x - 0.5, y - 0.5);
        return static_cast<float>(std::clamp(0.5 + size * inside, 0.0, 1.0));
    });
}

DecodedImage ring(int size, double inner, double outer) {
    return alphaChannel(size, [=](double x, double y) {
        const double r = std::hypot(x - 0.5, y - 0.5);
        return static_cast<float>(std::clamp(0.5 + size * std::min(outer - r, r - inner), 0., 1.));
    });
}

/// A square of two triangles, `extent` metres wide, that shows the texture `repeats` times each
/// way.
Scene square(float extent, float repeats) {
    Scene scene;
    for (const Vec2 p : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
        scene.positions.emplace_back(extent * p.x, extent * p.y, 0);
        scene.normals.emplace_back(0, 0, 1);
        scene.uvs.push_back(repeats * p);
    }
    scene.triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}};
    scene.meshes = {{"square", 0, 2}};
    scene.materials.resize(1);
    return scene;
}

MaskedMaterials masked(const DecodedImage& image, Wrap wrap = Wrap::repeat,
                       float threshold = 0.5f) {
    MaskedMaterials result;
    result.images.emplace_back(image, AlphaSource::alpha, wrap, wrap);
    result.masks[0] = {0, threshold};
    return result;
}

class CutMasks : public ::testing::Test {
  protected:
    Scene cut(Scene scene, const MaskedMaterials& masks, const MaskLimits& limits = {}) {
        report_ = {};
        cutMasks(scene, masks, "a.obj", report_, limits);
        return scene;
    }
    bool warns(const std::string& text) const {
        return std::any_of(report_.warnings.begin(), report_.warnings.end(),
                           [&](const auto& w) { return w.find(text) != std::string::npos; });
    }
    ImportReport report_;
};

/// Whether a point of the plane lies in a triangle of the scene.
bool isCovered(const Scene& scene, const Vec2& p) {
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        bool inside = true;
        for (int k = 0; k < 3; ++k) {
            const Vec3 a = scene.position(t, k), b = scene.position(t, (k + 1) % 3);
            inside &= (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= 0;
        }
        if (inside) return true;
    }
    return false;
}

TEST_F(CutMasks, KeepsTheAreaOfADisc) {
    for (const double radius : {0.2, 0.35, 0.45}) {
        const Scene scene = cut(square(2, 1), masked(disc(64, radius)));
        EXPECT_NEAR(test::totalArea(scene) / (4 * M_PI * radius * radius), 1, 0.01) << radius;
        EXPECT_LT(scene.triangles.size(), 200u);
        EXPECT_EQ(scene.meshes[0].triangleCount, scene.triangles.size());
    }
}

TEST_F(CutMasks, KeepsTheAreaOfWhatHasAHole) {
    const Scene scene = cut(square(1, 1), masked(ring(64, 0.2, 0.4)));
    EXPECT_NEAR(test::totalArea(scene) / (M_PI * (0.16 - 0.04)), 1, 0.015);
    EXPECT_FALSE(isCovered(scene, {0.5f, 0.5f}));
    EXPECT_TRUE(isCovered(scene, {0.5f, 0.8f}));
}

TEST_F(CutMasks, FollowTheMaskEverywhere) {
    const DecodedImage blobs = alphaChannel(96, [](double x, double y) {
        return static_cast<float>(0.5 + 0.5 * std::sin(17 * x + 3 * y) * std::sin(23 * y - 5 * x));
    });
    const MaskedMaterials masks = masked(blobs);
    const Scene scene = cut(square(1, 1), masks);
    RandomStream random(1, 2);
    int wrong = 0;
    for (int i = 0; i < 4000; ++i) {
        const Vec2 p(random.next(), random.next());
        const float excess = masks.images[0].sample(p, 0) - 0.5f;
        if (std::abs(excess) > 0.08f) wrong += isCovered(scene, p) != (excess > 0);
    }
    EXPECT_EQ(wrong, 0);
}

TEST_F(CutMasks, WindPiecesLikeTheirTriangleAndInterpolate) {
    Scene source = square(2, 1);
    std::swap(source.triangles[0].vertex[0], source.triangles[0].vertex[2]);
    for (std::size_t v = 0; v < 4; ++v)
        source.normals[v] = glm::normalize(Vec3(source.uvs[v] - 0.5f, 1));
    const Scene scene = cut(source, masked(disc(64, 0.4)));
    bool front = false, back = false;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        (areaVector(scene, t).z > 0 ? front : back) = true;
        for (const std::uint32_t v : scene.triangles[t].vertex) {
            test::expectNear(Vec3(scene.uvs[v], 0), scene.positions[v] / 2.0f);
            const Vec2 slope = Vec2(scene.normals[v]) / scene.normals[v].z;
            test::expectNear(Vec3(slope, 0), Vec3(scene.uvs[v] - 0.5f, 0), 1e-4f);
        }
    }
    EXPECT_TRUE(front && back);
}

TEST_F(CutMasks, ObeyTheWrapMode) {
    // Solid is the left quarter.
    const DecodedImage quarter = alphaChannel(64, [](double x, double) { return x < 0.25; });
    const auto area = [&](Wrap wrap) {
        return test::totalArea(cut(square(4, 4), masked(quarter, wrap)));
    };
    // A border between opaque and transparent texels lies between their centres.
    EXPECT_NEAR(area(Wrap::repeat), 4, 0.05);
    EXPECT_NEAR(area(Wrap::mirror), 4, 0.05);
    EXPECT_NEAR(area(Wrap::clamp), 1, 0.05);
    const Scene mirrored = cut(square(4, 4), masked(quarter, Wrap::mirror));
    EXPECT_TRUE(isCovered(mirrored, {1.9f, 0.5f}));
    EXPECT_FALSE(isCovered(mirrored, {1.1f, 0.5f}));
    EXPECT_TRUE(isCovered(mirrored, {2.1f, 0.5f}));
}

TEST_F(CutMasks, LeaveAnOpaqueSceneAsItIs) {
    const Scene source = square(1, 3);
    const Scene scene = cut(source, masked(alphaChannel(8, [](double, double) { return 1.f; })));
    EXPECT_EQ(sceneHash(scene), sceneHash(source));
    EXPECT_EQ(scene.positions.size(), 4u);
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(CutMasks, DropWhatIsTransparentAllOverAndSaySo) {
    Scene source = square(1, 1);
    source.meshes = {{"a", 0, 1}, {"b", 1, 1}};
    const Scene scene = cut(source, masked(alphaChannel(32, [](double x, double y) {
                                return x > y - 0.1 ? 1.0f : 0.0f;  // the first triangle's half
                            })));
    EXPECT_TRUE(warns("1 triangles are cut into"));
    const Scene none = cut(source, masked(alphaChannel(8, [](double, double) { return 0.f; })));
    EXPECT_TRUE(none.triangles.empty());
    EXPECT_TRUE(warns("2 are transparent and left out"));
}

TEST_F(CutMasks, UseTheThreshold) {
    const DecodedImage ramp =
        alphaChannel(128, [](double x, double) { return static_cast<float>(x); });
    for (const float threshold : {0.2f, 0.5f, 0.9f})
        EXPECT_NEAR(test::totalArea(cut(square(1, 1), masked(ramp, Wrap::clamp, threshold))),
                    1 - threshold, 0.01);
}

TEST_F(CutMasks, CutBothSidesOfASurfaceModelledTwiceAlike) {
    Scene source = square(1, 1);
    source.triangles.push_back({{2, 1, 0}, 0});
    source.triangles.push_back({{3, 2, 0}, 0});
    source.meshes[0].triangleCount = 4;
    Scene scene = cut(source, masked(disc(32, 0.4)));
    const std::size_t both = scene.triangles.size();
    cleanScene(scene, report_);
    EXPECT_EQ(report_.duplicateTriangles, both / 2);
    EXPECT_EQ(scene.triangles.size(), both / 2);
}

TEST_F(CutMasks, StayWithinTheirLimitsAndSaySo) {
    RandomStream random(3, 4);
    const DecodedImage noise = alphaChannel(256, [&](double, double) { return random.next(); });
    const Scene fine = cut(square(1, 8), masked(noise));
    EXPECT_TRUE(warns("have more detail than is cut"));
    EXPECT_LT(fine.triangles.size(), 250'002u);
    const Scene coarse = cut(square(1, 2), masked(ring(64, 0.1, 0.4)), {1 << 20, 40, 1024});
    EXPECT_LE(coarse.triangles.size(), 42u);
    EXPECT_TRUE(warns("have more detail than is cut"));
    cut(square(1, 2), masked(disc(64, 0.4)), {1 << 10, 1000, 1024});
    EXPECT_TRUE(warns("have more detail than is cut"));
}

TEST_F(CutMasks, TakeCoordinatesOfAnySizeAndTrianglesOfAnyShape) {
    const MaskedMaterials masks = masked(disc(64, 0.3));
    for (const float repeats : {1e-6f, 1e6f, 1e30f}) {
        const Scene scene = cut(square(1, repeats), masks);
        EXPECT_LE(scene.triangles.size(), 2u) << repeats;
    }
    Scene sliver = square(1, 1);
    sliver.positions[2].y = 1e-7f;
    sliver.uvs[3] = Vec2(std::numeric_limits<float>::infinity());
    cut(sliver, masks);
    Scene point = square(0, 1);
    EXPECT_EQ(cut(point, masks).triangles.size(), 2u);  // left to cleanScene
}

TEST(AlphaImage, TakesTheChannelThatIsAskedFor) {
    DecodedImage image{1, 1, {255, 0, 51, 102}, {}, true};
    const auto opacity = [&](AlphaSource source) {
        return AlphaImage(image, source, Wrap::repeat, Wrap::repeat).sample(Vec2(0.3f), 0);
    };
    EXPECT_NEAR(opacity(AlphaSource::red), 1, 1e-6);
    EXPECT_NEAR(opacity(AlphaSource::green), 0, 1e-6);
    EXPECT_NEAR(opacity(AlphaSource::blue), 0.2, 1e-6);
    EXPECT_NEAR(opacity(AlphaSource::alpha), 0.4, 1e-6);
    EXPECT_NEAR(opacity(AlphaSource::alphaOrLuminance), 0.4, 1e-6);
    EXPECT_NEAR(opacity(AlphaSource::luminance), 0.2126 + 0.0722 * 0.2, 0.002);
    image.hasAlpha = false;
    EXPECT_NEAR(opacity(AlphaSource::alphaOrLuminance), 0.2126 + 0.0722 * 0.2, 0.002);
}

TEST(AlphaImage, HasTheSameMeanInEveryResolution) {
    const AlphaImage image(disc(96, 0.3), AlphaSource::alpha, Wrap::repeat, Wrap::repeat);
    EXPECT_EQ(image.levelCount(), 7);
    EXPECT_NEAR(image.sample(Vec2(0.5f), 6), M_PI * 0.09, 0.02);
}

TEST(PolygonHoles, CutARegionWithHolesIntoItsArea) {
    const auto circle = [](glm::dvec2 centre, double radius, int corners) {
        Ring ring;
        for (int k = 0; k < corners; ++k) {
            const double angle = 2 * M_PI * k / corners;
            ring.push_back(
                Vec2(centre + std::abs(radius) * glm::dvec2(std::cos(angle), std::sin(angle))));
        }
        if (radius < 0) std::reverse(ring.begin(), ring.end());
        return ring;
    };
    std::vector<Ring> rings{circle({0, 0}, 10, 40)};
    for (int i = 0; i < 9; ++i)
        rings.push_back(circle({5 * (i % 3 - 1), 5 * (i / 3 - 1)}, -1.5, 12));
    rings.push_back(circle({0, 0}, 0.5, 8));  // an island in a hole
    ASSERT_TRUE(areSimple(rings));
    const auto triangles = triangulateRegion(rings);
    ASSERT_TRUE(triangles);
    std::vector<glm::dvec2> corners;
    for (const Ring& ring : rings) corners.insert(corners.end(), ring.begin(), ring.end());
    double sum = 0;
    for (const auto& t : *triangles) {
        const glm::dvec2 u = corners[t[1]] - corners[t[0]], v = corners[t[2]] - corners[t[0]];
        EXPECT_GT(u.x * v.y - u.y * v.x, 0);
        sum += 0.5 * (u.x * v.y - u.y * v.x);
    }
    const auto area = [](double radius, int n) {
        return 0.5 * n * radius * radius * std::sin(2 * M_PI / n);
    };
    EXPECT_NEAR(sum, area(10, 40) - 9 * area(1.5, 12) + area(0.5, 8), 1e-4);
}

TEST(PolygonHoles, SeeWhereEdgesCross) {
    const Ring square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    EXPECT_TRUE(areSimple(std::vector<Ring>{square}));
    EXPECT_FALSE(areSimple(std::vector<Ring>{square, {{1, 1}, {5, 1}, {2, 2}}}));
    EXPECT_FALSE(areSimple(std::vector<Ring>{{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}));
}

}  // namespace
}  // namespace vlf
