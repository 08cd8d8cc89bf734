#include "lit_room.h"
#include "support/analytic_scenes.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/scene/generate/primitives.h"

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

TEST(ObjectEmitters, ASphereLightsABlackRoomByTheInverseSquare) {
    SceneBuilder b;
    b.box(Vec3(-2), Vec3(2), true, b.material("black", Vec3(0)));
    const LitRoom room(b.scene(), Vec3(0));
    DynamicRoom objects(room.scene, room.rays, room.field);
    Material lamp;
    lamp.diffuse = Vec3(0);
    lamp.emission = Vec3(10);
    DynamicObject ball;
    ball.model = std::make_shared<ObjectModel>(makePrimitive("sphere", lamp));
    ball.pose.scale = 0.4f;
    objects.add(ball);
    objects.update();
    double worst = 0;
    for (const std::uint32_t c : {0u, 1u, 2u, 3u, 4u, 5u}) {
        const Chart& chart = room.field.charts[c];
        for (std::uint32_t y = 0; y < chart.height; ++y)
            for (std::uint32_t x = 0; x < chart.width; ++x) {
                // The point of the plane at the texel's middle.
                const float u = 4 * (x + 0.5f) / chart.width - 2,
                            v = 4 * (y + 0.5f) / chart.height - 2;
                const float d2 = 4 + u * u + v * v;
                const float exact = kPi * 10 * 0.04f / d2 * 2 / std::sqrt(d2);
                const float found = objects.irradiance().at(chart.x + x, chart.y + y).x;
                worst = std::max<double>(worst, std::abs(found / exact - 1));
            }
    }
    EXPECT_LT(worst, 0.1);
}

}  // namespace
}  // namespace vlf::test
