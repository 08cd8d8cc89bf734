#include "vlf/dynamic/changed_charts.h"
#include "support/baked_example.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

/// The Cornell box, and the light on its floor halved within half a metre of a place.
class ChangedLight : public testing::Test {
  protected:
    static constexpr float kRadius = 0.5f;
    const Vec3 middle{4.5f, 0, 1};
    const test::BakedExample& room = example();
    IrradianceAtlas with = room.field.atlas;

    static const test::BakedExample& example() {
        static const test::BakedExample baked("cornell", 6000);
        return baked;
    }

    const Chart& floorChart() const {
        const Hit hit = room.rays.closest({middle + Vec3(0, 1, 0), {0, -1, 0}});
        return room.field.charts[room.field.triangleCharts[hit.triangle].front];
    }

    ChangedLight() {
        const Chart& chart = floorChart();
        const Vec2 centre = chart.texelCoordinates(middle);
        const float texels = kRadius / chart.texelSize();
        for (std::uint32_t y = 0; y < chart.height; ++y)
            for (std::uint32_t x = 0; x < chart.width; ++x)
                if (glm::distance(Vec2(x + 0.5f, y + 0.5f), centre) < texels)
                    with.irradiance[with.index(chart.x + x, chart.y + y)] *= 0.5f;
    }

    ChangedCharts charts() const {
        ChangedCharts found(room.scene, room.field);
        found.update(with, room.field.atlas);
        return found;
    }

    /// What a ray from above sees changed when the distance is told with an error.
    Vec3 factor(const Vec3& place, float error) const {
        const Vec3 eye = place + Vec3(-1, 2, -0.5f);
        return charts().factor(eye, glm::normalize(place - eye), glm::distance(place, eye) + error,
                               with, room.field.atlas);
    }
};

TEST_F(ChangedLight, NamesTheChartAndTheTexelsThatHaveChanged) {
    const ChangedCharts found = charts();
    ASSERT_EQ(found.charts().size(), 1u);
    const ChangedChart& changed = found.charts().front();
    EXPECT_EQ(&room.field.charts[changed.chart], &floorChart());
    EXPECT_NEAR(changed.lower, 0, 1e-5f);
    const Vec2 size = (changed.last - changed.first) * floorChart().texelSize();
    EXPECT_NEAR(size.x, 2 * kRadius, 4 * floorChart().texelSize());
    EXPECT_NEAR(size.y, 2 * kRadius, 4 * floorChart().texelSize());
}

TEST_F(ChangedLight, IsSeenThereAndNowhereElse) {
    const float tolerated = 0.5f * charts().tolerance();
    for (const float error : {-tolerated, 0.0f, tolerated}) {
        EXPECT_LT(maxComponent(glm::abs(factor(middle, error) - 0.5f)), 1e-3f);
        EXPECT_EQ(factor(middle - Vec3(0, 0, 0.9f), error), Vec3(1));
        EXPECT_EQ(factor(middle + Vec3(0, 1, 0), error), Vec3(1));
    }
}

TEST_F(ChangedLight, IsNotSeenFromBelow) {
    const Vec3 eye = middle - Vec3(0, 1, 0);
    EXPECT_EQ(charts().factor(eye, {0, 1, 0}, 1, with, room.field.atlas), Vec3(1));
}

TEST_F(ChangedLight, NothingHasChangedWithoutObjects) {
    ChangedCharts found = charts();
    found.update(room.field.atlas, room.field.atlas);
    EXPECT_TRUE(found.charts().empty());
}

}  // namespace
}  // namespace vlf
