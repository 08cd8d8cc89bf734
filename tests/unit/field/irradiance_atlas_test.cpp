#include "vlf/field/irradiance_atlas.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

/// Irradiance that is a linear function of atlas position.
Vec3 ramp(float x, float y) {
    return {x, 2 * y, x + y};
}

/// An atlas of 8 x 6 texels with a ramp in it, and a chart of 4 x 3 texels at (2, 1).
struct Fixture {
    IrradianceAtlas atlas;
    Chart chart;

    Fixture() {
        atlas.width = 8, atlas.height = 6;
        for (std::uint32_t y = 0; y < atlas.height; ++y)
            for (std::uint32_t x = 0; x < atlas.width; ++x)
                atlas.irradiance.push_back(ramp(x + 0.5f, y + 0.5f));
        chart.x = 2, chart.y = 1, chart.width = 4, chart.height = 3;
    }
};

TEST(IrradianceAtlas, SampleAtATexelCentreIsTheTexel) {
    const Fixture f;
    for (std::uint32_t y = 0; y < f.chart.height; ++y)
        for (std::uint32_t x = 0; x < f.chart.width; ++x)
            EXPECT_EQ(f.atlas.sample(f.chart, {x + 0.5f, y + 0.5f}),
                      f.atlas.at(f.chart.x + x, f.chart.y + y));
}

TEST(IrradianceAtlas, SampleIsLinearBetweenTexelsUpToTheChartsEdge) {
    const Fixture f;
    for (const Vec2 t : {Vec2(0, 0), Vec2(4, 3), Vec2(1.25f, 2.75f), Vec2(3.9f, 0.1f)}) {
        const Vec3 expected = ramp(f.chart.x + t.x, f.chart.y + t.y);
        const Vec3 sampled = f.atlas.sample(f.chart, t);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sampled[c], expected[c], 1e-5f);
    }
}

TEST(IrradianceAtlas, SampleClampsToTheChart) {
    const Fixture f;
    EXPECT_EQ(f.atlas.sample(f.chart, {-7, 1}), f.atlas.sample(f.chart, {0, 1}));
    EXPECT_EQ(f.atlas.sample(f.chart, {1, 99}), f.atlas.sample(f.chart, {1, 3}));
}

TEST(IrradianceAtlas, SampleNeverReadsBeyondTheGutter) {
    Fixture f;
    const Vec3 poison(1e9f);
    for (std::uint32_t y = 0; y < f.atlas.height; ++y)
        for (std::uint32_t x = 0; x < f.atlas.width; ++x)
            if (x + kGutter < f.chart.x || x >= f.chart.x + f.chart.width + kGutter ||
                y + kGutter < f.chart.y || y >= f.chart.y + f.chart.height + kGutter)
                f.atlas.irradiance[f.atlas.index(x, y)] = poison;
    for (float v = 0; v <= 3; v += 0.125f)
        for (float u = 0; u <= 4; u += 0.125f)
            EXPECT_LT(maxComponent(f.atlas.sample(f.chart, {u, v})), 100.0f) << u << ' ' << v;
}

TEST(Chart, TexelCoordinatesAreAffineInPosition) {
    Chart chart;
    chart.uAxis = {10, 0, 0}, chart.vAxis = {0, 0, -5};
    chart.uOffset = 1, chart.vOffset = 2;
    EXPECT_EQ(chart.texelCoordinates({0.5f, 9, -0.2f}), Vec2(6, 3));
}

}  // namespace
}  // namespace vlf
