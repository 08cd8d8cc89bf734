#include "vlf/dynamic/texel_square.h"
#include "lit_room.h"
#include "support/analytic_scenes.h"

#include <functional>
#include <map>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

/// A floor whose chart ends within a square.
const LitRoom& floorRoom() {
    static const LitRoom room(
        [] {
            SceneBuilder b;
            b.quad({0, 0, 0}, {0, 0, 2.9f}, {3.1f, 0, 0}, b.material("floor", Vec3(0.5f)));
            return b.scene();
        }(),
        Vec3(0));
    return room;
}

struct Found {
    int finds = 0;
    std::map<std::uint32_t, float> light;  ///< by texel
};

Vec3 placeOf(std::uint32_t texel) {
    return floorRoom().texels.place[texel];
}

/// Over all squares, of a light given by place.
Found lightBy(const std::function<float(const Vec3&)>& given,
              const std::function<LightThere(const Sphere&)>& expect) {
    const RoomTexels& room = floorRoom().texels;
    Found found;
    for (const TexelGroup& group : room.groups)
        TexelSquare(room, group)
            .light(
                1e-4f, expect,
                [&](std::uint32_t entry) {
                    ++found.finds;
                    return Vec3(given(placeOf(room.unwrap.texels[entry])));
                },
                [&](std::uint32_t texel, const Vec3& light) {
                    EXPECT_TRUE(found.light.try_emplace(texel, light.x).second);
                });
    return found;
}

LightThere evenLight(const Sphere&) {
    return LightThere::even;
}

float slope(const Vec3& p) {
    return 1 + 0.3f * p.x + 0.2f * p.z;
}

int texelCount() {
    return static_cast<int>(floorRoom().texels.unwrap.texels.size());
}

TEST(TexelSquare, FindsLightThatChangesEvenlyAtAFewTexels) {
    const Found found = lightBy(slope, evenLight);
    EXPECT_LT(found.finds, texelCount() / 4);
    ASSERT_EQ(static_cast<int>(found.light.size()), texelCount());
    for (const auto& [texel, light] : found.light) EXPECT_NEAR(light, slope(placeOf(texel)), 2e-3f);
}

TEST(TexelSquare, FindsEachTexelsLightWhereItIsNotKnownToChangeEvenly) {
    const auto anything = [](const Sphere&) { return LightThere::any; };
    const Found found = lightBy(slope, anything);
    EXPECT_EQ(found.finds, texelCount());
    ASSERT_EQ(static_cast<int>(found.light.size()), texelCount());
    for (const auto& [texel, light] : found.light) EXPECT_EQ(light, slope(placeOf(texel)));
}

TEST(TexelSquare, FindsMoreOfLightThatProvesToChangeUnevenly) {
    const auto edge = [](const Vec3& p) { return p.x + 0.4f * p.z > 1.9f ? 1.0f : 0.0f; };
    const Found found = lightBy(edge, evenLight);
    EXPECT_LT(found.finds, texelCount() / 2);
    int off = 0;
    for (const auto& [texel, light] : found.light) off += light != edge(placeOf(texel));
    EXPECT_LT(off, texelCount() / 50);
}

TEST(TexelSquare, AsksForNothingWhereNoLightIsExpected) {
    const auto isNear = [](const Sphere& s) { return glm::length(s.centre) < 1 + s.radius; };
    const Found found =
        lightBy([](const Vec3&) { return 1.0f; },
                [&](const Sphere& s) { return isNear(s) ? LightThere::any : LightThere::none; });
    EXPECT_GT(found.finds, 0);
    EXPECT_LT(found.finds, texelCount() / 2);
    for (const std::uint32_t texel : floorRoom().texels.unwrap.texels)
        EXPECT_TRUE(glm::length(placeOf(texel)) >= 1 || found.light.contains(texel));
}

}  // namespace
}  // namespace vlf::test
