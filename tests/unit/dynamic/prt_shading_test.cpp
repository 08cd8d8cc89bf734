// Precomputed transfer as a dynamic room uses it.

#include "vlf/base/parallel.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/dynamic/subdivide.h"
#include "vlf/scene/generate/primitives.h"

#include "support/analytic_scenes.h"
#include "unit/dynamic/lit_room.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace vlf {
namespace {

using test::LitRoom;

Scene roomOf(const Vec3& reflectance) {
    test::SceneBuilder builder;
    builder.box(Vec3(-1), Vec3(1), true, builder.material("wall", reflectance));
    builder.quad({-0.1f, 0.99f, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f},
                 builder.material("lamp", Vec3(0), Vec3(5)));
    return builder.scene();
}

DynamicObject objectAt(const std::shared_ptr<const ObjectModel>& model, const Vec3& place,
                       float scale) {
    DynamicObject object;
    object.model = model;
    object.pose = {place, Quat(1, 0, 0, 0), scale};
    object.settings.shading = Shading::prt;
    object.settings.shadow = ShadowKind::none;
    return object;
}

TEST(PrtShading, OfNeighboursIsTheSameWithAnyNumberOfThreads) {
    const LitRoom room(roomOf(Vec3(0.5f)), Vec3(0));
    const auto cube = std::make_shared<const ObjectModel>(makePrimitive("cube", {}));
    const auto light = [&] {
        DynamicRoom dynamic(room.scene, room.rays, room.field);
        for (int i = 0; i < 8; ++i)
            dynamic.add(objectAt(cube, Vec3(0.25f * static_cast<float>(i) - 0.9f, 0, 0), 0.2f));
        dynamic.update();
        std::vector<Vec3> all;
        for (const LitObject& lit : dynamic.litObjects())
            all.insert(all.end(), lit.vertexIrradiance.begin(), lit.vertexIrradiance.end());
        return all;
    };
    const std::vector<Vec3> many = light();
    EXPECT_GT(many.front().x + many.back().x, 0);
    const ThreadLimit one(1);
    EXPECT_EQ(light(), many);
}

TEST(PrtShading, LightOfTheObjectsOwnCountsOnce) {
    const LitRoom room(roomOf(Vec3(0)), Vec3(0));
    test::SceneBuilder builder;
    builder.quad({-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, builder.material("floor", Vec3(0)));
    builder.quad({-5, 0.01f, -5}, {10, 0, 0}, {0, 0, 10},
                 builder.material("lamp", Vec3(0), Vec3(2)));
    const auto model = std::make_shared<const ObjectModel>(subdivide(builder.scene()));
    DynamicRoom dynamic(room.scene, room.rays, room.field);
    dynamic.add(objectAt(model, Vec3(0, -0.5f, 0), 0.05f));
    dynamic.update();
    const LitObject& lit = dynamic.litObjects()[0];
    const std::vector<Vec3>& positions = lit.mesh->scene.positions;
    const auto middle = std::find(positions.begin(), positions.end(), Vec3(0)) - positions.begin();
    EXPECT_NEAR(lit.vertexIrradiance[static_cast<std::size_t>(middle)].x, 2 * kPi, 0.1f);
}

}  // namespace
}  // namespace vlf
