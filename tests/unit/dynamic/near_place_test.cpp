#include "vlf/dynamic/near_place.h"
#include "lit_room.h"
#include "support/analytic_scenes.h"
#include "vlf/dynamic/sight.h"
#include "vlf/math/random.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

const LitRoom& room() {
    static const LitRoom room(
        [] {
            SceneBuilder b;
            b.box(Vec3(-2), Vec3(2), true, b.material("wall", Vec3(0.5f)));
            return b.scene();
        }(),
        Vec3(1));
    return room;
}

std::uint32_t chartOf(std::uint32_t texel) {
    const Unwrap& unwrap = room().texels.unwrap;
    return unwrap.texelChart[room().texels.entryOf[texel]];
}

TEST(NearPlace, AParallelMeetsTheTexelThatARayOfItsOwnDoes) {
    const Pose pose{{0.4f, -1.2f, 0.3f}, glm::normalize(Quat(0.8f, 0.3f, -0.2f, 0.4f)), 0.5f};
    SightTracer tracer(room().scene, room().rays, room().texels);
    Sights sights;
    RandomStream random(3, 0);
    const auto inside = [&] { return Vec3(random.next(), random.next(), random.next()) - 0.5f; };
    int met = 0, passed = 0, edges = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 direction = pose.direction(glm::normalize(inside()));
        const Vec3 from = inside(), to = inside();
        const std::array<Ray, 2> rays{Ray{pose.point(from), direction},
                                      Ray{pose.point(to), direction}};
        tracer.trace(rays, sights);
        ASSERT_NE(sights.texel[0], kNoTexel);
        const auto place =
            NearPlace::of(rays[0], sights.distance[0], sights.texel[0], pose, room().texels);
        ASSERT_TRUE(place);
        const std::uint32_t own = place->texelFrom(to - from, room().texels);
        if (chartOf(sights.texel[0]) != chartOf(sights.texel[1])) {
            ++passed;
            EXPECT_EQ(own, kNoTexel);
        } else if (own == sights.texel[1]) {
            ++met;
        } else {
            ++edges;
        }
    }
    EXPECT_GT(met, 1000);
    EXPECT_GT(passed, 100);
    EXPECT_LE(edges, 2) << "rounding where texels meet";
}

}  // namespace
}  // namespace vlf::test
