// A room with a mirror for a wall and an object before it is the half of a room twice as long, with
// the object's image in the other half.

#include "posed_truth.h"

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

/// x in [0, 2] or, with its image, [-2, 2]; lamps above x = 1 and -1; the wall x = 0 a mirror.
Scene half() {
    Scene scene = lampRoom();
    Material& wall = scene.materials[1];
    wall.diffuse = Vec3(0);
    wall.mirror = Vec3(1);
    return scene;
}

Scene whole() {
    SceneBuilder b;
    b.box({-2, 0, 0}, Vec3(2), true, b.material("grey", Vec3(0.5f)));
    const std::uint32_t lamp = b.material("lamp", Vec3(0), Vec3(10));
    for (const float x : {0.7f, -1.3f})
        b.quad(Vec3(x, 1.99f, 0.7f), {0.6f, 0, 0}, {0, 0, 0.6f}, lamp);
    return b.scene();
}

class BeforeAMirror : public testing::Test {
  protected:
    static const BakedRoom& mirrored() {
        static const BakedRoom baked(half(), 4000);
        return baked;
    }
    static const BakedRoom& doubled() {
        static const BakedRoom baked(whole(), 8000);
        return baked;
    }

    static DynamicObject body(const Vec3& diffuse, float side) {
        DynamicObject object = bodyAt("cube", {side * 0.5f, 0.4f, 0.9f}, 0.4f, diffuse);
        object.settings.gather.lines = 513;
        return object;
    }

    static void expectSameFaces(const FilledRoom& a, const FilledRoom& b, double tolerance) {
        for (const Vec3& n : {Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0),
                              Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
            const float one = meanIrradiance(a.room.litObjects()[0], n).x;
            const float two = meanIrradiance(b.room.litObjects()[0], n).x;
            EXPECT_NEAR(one / two, 1, tolerance) << n.x << " " << n.y << " " << n.z;
        }
    }

    /// Mean relative difference of the change on the room's texels with x > 0 that `wanted` picks.
    static double changeDifference(const FilledRoom& a, const FilledRoom& b) {
        const RoomTexels texels =
            makeRoomTexels(mirrored().scene, mirrored().rays, mirrored().field);
        double difference = 0, change = 0;
        for (std::size_t i = 0; i < texels.unwrap.texels.size(); ++i) {
            const LightReceiver r = texelReceiver(mirrored().scene, texels.unwrap, i);
            if (r.normal.x > 0.9f || r.centre.y > 1.9f) continue;
            const Hit hit = doubled().rays.closest({r.centre + 0.01f * r.normal, -r.normal});
            const std::uint32_t c = doubled().field.triangleCharts[hit.triangle].front;
            const Chart& chart = doubled().field.charts[c];
            const Vec2 at = chart.texelCoordinates(r.centre);
            const auto changeIn = [](const FilledRoom& f, const auto& look) {
                return look(f.room.irradiance()) - look(f.room.roomIrradiance());
            };
            const std::uint32_t t = texels.unwrap.texels[i];
            const float one =
                changeIn(a, [&](const IrradianceAtlas& atlas) { return atlas.irradiance[t].x; });
            const float two = changeIn(
                b, [&](const IrradianceAtlas& atlas) { return atlas.sample(chart, at).x; });
            difference += texels.area[t] * std::abs(one - two);
            change += texels.area[t] * std::abs(two);
        }
        return difference / change;
    }
};

TEST_F(BeforeAMirror, AnObjectTakesAndGivesAsWithItsImage) {
    const Vec3 grey(0.6f);
    const FilledRoom one(mirrored(), {body(grey, 1)});
    const FilledRoom two(doubled(), {body(grey, 1), body(grey, -1)});
    expectSameFaces(one, two, 0.03);
    EXPECT_LT(changeDifference(one, two), 0.15);
}

}  // namespace
}  // namespace vlf::test
