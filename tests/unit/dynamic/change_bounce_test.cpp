#include "vlf/dynamic/change_bounce.h"
#include "lit_room.h"
#include "support/analytic_scenes.h"
#include "vlf/scene/generate/primitives.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

constexpr float kReflectance = 0.5f;

/// A closed cube of 1 x 1 x 1 m, grey all over.
const LitRoom& greyBox() {
    static const LitRoom room(furnaceMirrorBox(Vec3(kReflectance), Vec3(0), Vec3(0)), Vec3(0));
    return room;
}

const BounceRays& raysOf(const LitRoom& room) {
    static const BounceRays rays(room.scene, room.rays, room.texels);
    return rays;
}

class BouncingChange : public testing::Test {
  protected:
    const LitRoom& lit = greyBox();
    const RoomTexels& room = lit.texels;
    Coverage coverage{room};

    /// Irradiance that bounces, by entry of the texels.
    std::vector<float> bounced(const RoomChange& change,
                               std::span<const RayInstance> objects = {}) {
        RayInstances instances;
        instances.place(objects);
        const std::vector<Sphere> spheres(objects.size(), Sphere{Vec3(0.5f), 1});
        ChangeBounce bounce;
        bounce.find(change, raysOf(lit), room, coverage, {instances, spheres}, room.totalArea);
        RoomChange result(room);
        bounce.addTo(result, 0);
        IrradianceAtlas own = lit.field.atlas, light = own;
        result.apply(own, light);
        std::vector<float> values;
        for (const std::uint32_t t : room.unwrap.texels) values.push_back(light.irradiance[t].x);
        return values;
    }

    double flux(const std::vector<float>& irradiance) const {
        double sum = 0;
        for (std::size_t i = 0; i < irradiance.size(); ++i)
            sum += room.area[room.unwrap.texels[i]] * irradiance[i];
        return sum;
    }

    /// Texels of the floor about its middle; all get less light by the distance from it.
    RoomChange spot(float strength) const {
        RoomChange change(room);
        for (std::size_t i = 0; i < room.unwrap.texels.size(); ++i) {
            const LightReceiver texel = texelReceiver(lit.scene, room.unwrap, i);
            const float distance = glm::distance(texel.centre, Vec3(0.5f, 0, 0.5f));
            if (distance < 0.2f)
                change.add(room.unwrap.texels[i], Vec3(strength * (0.2f - distance)));
        }
        return change;
    }
};

TEST_F(BouncingChange, OfAllSurfacesIsAGeometricSeries) {
    RoomChange change(room);
    change.addToAll(Vec3(1));
    const std::vector<float> values = bounced(change);
    EXPECT_NEAR(flux(values) / room.totalArea, kReflectance / (1 - kReflectance), 0.01);
    double squares = 0;
    for (const float value : values) squares += (value - 1) * (value - 1);
    EXPECT_LT(std::sqrt(squares / static_cast<double>(values.size())), 0.12);
}

TEST_F(BouncingChange, OfASpotIsAllThatItReflects) {
    const RoomChange change = spot(1);
    double sent = 0;
    for (const std::uint32_t t : room.unwrap.texels) sent += room.area[t] * change.of(t).x;
    EXPECT_NEAR(flux(bounced(change)) / (sent * kReflectance / (1 - kReflectance)), 1, 0.02);
}

TEST_F(BouncingChange, GrowsAsEvenlyAsTheChange) {
    std::vector<float> before = bounced(spot(1));
    const float mean = static_cast<float>(flux(before)) / room.totalArea;
    for (int step = 1; step <= 40; ++step) {
        const std::vector<float> now = bounced(spot(1 + 0.05f * step));
        for (std::size_t i = 0; i < now.size(); ++i)
            EXPECT_LT(std::abs(now[i] - before[i]), 0.4f * std::max(before[i], mean));
        before = now;
    }
}

TEST_F(BouncingChange, OfAGroupGivesNoTexelMoreThanTheGroupSends) {
    for (std::uint32_t g = 0; g < room.groups.size(); ++g) {
        RoomChange change(room);
        change.addToGroup(g, Vec3(0.01f));
        const std::vector<float> values = bounced(change);
        EXPECT_LT(*std::ranges::max_element(values), 0.01f * kReflectance) << g;
    }
}

TEST_F(BouncingChange, FallsOnWhatTheSpotSees) {
    const std::vector<float> values = bounced(spot(1));
    float ceiling = 0, floor = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Vec3 p = texelReceiver(lit.scene, room.unwrap, i).centre;
        if (p.y > 0.99f) ceiling = std::max(ceiling, values[i]);
        if (p.y < 0.01f) floor = std::max(floor, values[i]);
    }
    EXPECT_GT(ceiling, 1.5f * floor);  // which gets the ambient rest alone
}

TEST_F(BouncingChange, IsLostOnAnObjectInItsWay) {
    const RayScene cube(makePrimitive("cube", {}));
    Pose pose;
    pose.translation = Vec3(0.5f);
    pose.scale = 0.7f;
    const RayInstance between{&cube, pose};
    const std::vector<float> values = bounced(spot(1)), hidden = bounced(spot(1), {&between, 1});
    double before = 0, after = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (texelReceiver(lit.scene, room.unwrap, i).centre.y > 0.99f)
            before += values[i], after += hidden[i];
    EXPECT_LT(after, 0.4 * before);
}

}  // namespace
}  // namespace vlf::test
