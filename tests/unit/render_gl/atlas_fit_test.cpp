#include "vlf/render/gl/atlas_fit.h"

#include "small_rooms.h"
#include "vlf/base/error.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

/// The light at every chart's middle, as a renderer samples it.
void expectSameLight(const LightField& field, const LightField& layout,
                     const IrradianceAtlas& fitted, float tolerance) {
    for (std::size_t c = 0; c < field.charts.size(); ++c) {
        const Chart &whole = field.charts[c], &small = layout.charts[c];
        const Vec2 middle(0.5f * static_cast<float>(whole.width),
                          0.5f * static_cast<float>(whole.height));
        const Vec3 exact = field.atlas.sample(whole, middle);
        const Vec2 scale = Vec2(glm::length(small.uAxis) / glm::length(whole.uAxis),
                                glm::length(small.vAxis) / glm::length(whole.vAxis));
        const Vec3 shown = fitted.sample(small, middle * scale);
        EXPECT_LE(maxComponent(glm::abs(shown - exact)), tolerance * (1 + maxComponent(exact)))
            << c;
    }
}

}  // namespace

TEST(AtlasFit, LeavesAnAtlasThatFits) {
    const LightField& field = mirrorRoom().field;
    const AtlasFit fit(field, std::max(field.atlas.width, field.atlas.height));
    EXPECT_TRUE(fit.unchanged());
    EXPECT_EQ(fit.factor(), 1u);
    EXPECT_EQ(fit.layout().atlas.width, field.atlas.width);
}

TEST(AtlasFit, PacksALongAtlasAnewWithoutLoss) {
    LightField field = mirrorRoom().field;
    const auto longSide = std::max(field.atlas.width, field.atlas.height);
    IrradianceAtlas wide{3 * longSide, field.atlas.height, {}};
    wide.irradiance.resize(std::size_t{wide.width} * wide.height, Vec3(0));
    for (std::uint32_t y = 0; y < field.atlas.height; ++y)
        for (std::uint32_t x = 0; x < field.atlas.width; ++x)
            wide.irradiance[wide.index(x, y)] = field.atlas.at(x, y);
    field.atlas = wide;
    const AtlasFit fit(field, 2 * longSide);
    EXPECT_FALSE(fit.unchanged());
    EXPECT_EQ(fit.factor(), 1u);
    expectSameLight(field, fit.layout(), fit.fit(field.atlas), 1e-6f);
}

TEST(AtlasFit, ShrinksAnAtlasThatIsTooLarge) {
    const LightField& field = mirrorRoom().field;
    const auto most = std::max(field.atlas.width, field.atlas.height) * 2 / 3;
    const AtlasFit fit(field, most);
    const LightField layout = fit.layout();
    EXPECT_GT(fit.factor(), 1u);
    EXPECT_LE(std::max(layout.atlas.width, layout.atlas.height), most);
    IrradianceAtlas even = field.atlas;
    std::fill(even.irradiance.begin(), even.irradiance.end(), Vec3(0.25f, 0.5f, 1));
    LightField evenField = field;
    evenField.atlas = even;
    expectSameLight(evenField, layout, fit.fit(even), 1e-6f);
}

TEST(AtlasFit, RefusesMoreChartsThanATextureHasRoomFor) {
    EXPECT_THROW(AtlasFit(mirrorRoom().field, 4), InputError);
}

}  // namespace vlf::test
