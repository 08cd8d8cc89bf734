#include "vlf/render/cpu/supersample.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

/// Looks along -z; at distance 1 the picture is 2 high.
const Camera kCamera{"test", Vec3(0), {0, 0, -1}, {0, 1, 0}, 90};

/// White where the ray passes the line x = slope · y + offset (at distance 1) on its right.
struct Edge {
    float slope, offset;

    std::uint64_t operator()(std::span<const Ray> rays, int, std::span<Vec3> colors) const {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Vec3 p = rays[i].direction / -rays[i].direction.z;
            colors[i] = Vec3(p.x > slope * p.y + offset ? 1.0f : 0.0f);
        }
        return rays.size();
    }
};

Image draw(const Edge& edge, int size, int n, std::uint64_t& traced) {
    Progress progress;
    return supersample(CameraRays(kCamera, size, size), size, size, n, edge, progress, traced);
}

/// Largest error of coverage over the pixels, the truth being sampled 64 x 64.
float worstCoverage(const Edge& edge, int size, int n) {
    std::uint64_t traced = 0;
    const Image image = draw(edge, size, n, traced);
    float worst = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            double truth = 0;
            for (int i = 0; i < 64 * 64; ++i) {
                const float px = (x + (i % 64 + 0.5f) / 64) * 2 / size - 1;
                const float py = 1 - (y + (i / 64 + 0.5f) / 64) * 2 / size;
                truth += px > edge.slope * py + edge.offset;
            }
            worst = std::max(worst, std::abs(image.at(x, y).x - static_cast<float>(truth / 4096)));
        }
    return worst;
}

TEST(Supersample, EdgesOfEverySlopeAreSmooth) {
    for (const float slope : {0.0f, 0.07f, 0.5f, 1.0f, 3.0f}) {
        EXPECT_LT(worstCoverage({slope, 0.013f}, 20, 4), 2.5f / 16) << slope;
        EXPECT_LT(worstCoverage({slope, 0.013f}, 20, 8), 4.5f / 64) << slope;
    }
}

TEST(Supersample, OnlyPixelsWithDetailGetAllRays) {
    std::uint64_t plain = 0, edged = 0, full = 0;
    draw({0, 5}, 64, 8, plain);
    draw({0, 0.013f}, 64, 8, edged);
    draw({0, 0.013f}, 64, 2, full);
    EXPECT_EQ(full, 64u * 64u * 4u);
    EXPECT_LT(plain, 1.2 * full);
    // The edge crosses one column of pixels; it and its neighbours are refined.
    EXPECT_NEAR(static_cast<double>(edged - plain), 3 * 64 * 64, 64 * 64);
}

TEST(Supersample, DetailBesideAPixelRefinesItAcrossTiles) {
    // The edge lies just left of column 32, the first of a tile.
    std::uint64_t traced = 0;
    const Image image = draw({0, -0.002f}, 64, 4, traced);
    EXPECT_NEAR(image.at(31, 20).x, 0.0625f, 1e-5);
    EXPECT_EQ(image.at(32, 20).x, 1);
}

}  // namespace
}  // namespace vlf
