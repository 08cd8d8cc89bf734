#include "vlf/dynamic/rebake.h"
#include "lit_room.h"
#include "support/analytic_scenes.h"
#include "vlf/dynamic/posed_scene.h"
#include "vlf/scene/generate/primitives.h"

#include <memory>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

/// 2 x 2 x 2 m with the floor at y = 0; on it a rug without an underside, 1 cm high, about
/// x = -0.5, and a solid block, 0.4 m high, sunk into it about x = 0.5.
const LitRoom& furnished() {
    static const LitRoom room(
        [] {
            SceneBuilder b;
            const std::uint32_t white = b.material("white", Vec3(0.5f));
            b.box({-1, 0, -1}, {1, 2, 1}, true, white);
            b.quad({-0.8f, 0.01f, -0.3f}, {0, 0, 0.6f}, {0.6f, 0, 0}, white);
            const std::uint32_t lamp = b.material("lamp", Vec3(0), Vec3(1));
            b.quad({-0.2f, 1.9f, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f}, lamp);
            DynamicObject block;
            block.model = std::make_shared<ObjectModel>(makePrimitive("cube", Material{}));
            block.pose = {{0.5f, 0.15f, 0}, Quat(1, 0, 0, 0), 0.5f};
            return posedScene(b.scene(), {&block, 1});
        }(),
        Vec3(1));
    return room;
}

bool isConcealed(float x, float y, float gap) {
    const LitRoom& room = furnished();
    const Vec3 above(x, y + 0.001f, 0.01f);
    const Hit hit = room.rays.closest({above, {0, -1, 0}});
    EXPECT_NEAR(hit.t, 0.001f, 1e-5f);
    const bool front = geometricNormal(room.scene, hit.triangle).y > 0;
    return isConcealed(room.scene, room.rays, room.field.triangleCharts, hit.triangle, front,
                       {x, y, 0.01f}, gap);
}

TEST(Concealed, ArePlacesUnderARugThatLiesClose) {
    EXPECT_TRUE(isConcealed(-0.5f, 0, 0.02f));
    EXPECT_FALSE(isConcealed(-0.5f, 0, 0.005f));
    EXPECT_FALSE(isConcealed(-0.5f, 0.01f, 0.02f)) << "on the rug";
    EXPECT_FALSE(isConcealed(0, 0, 0.02f)) << "beside it";
}

TEST(Concealed, ArePlacesWithinASolidHoweverHigh) {
    EXPECT_TRUE(isConcealed(0.5f, 0, 0.02f));
    EXPECT_FALSE(isConcealed(0.5f, 0.4f, 0.02f)) << "on top of it";
}

}  // namespace
}  // namespace vlf::test
