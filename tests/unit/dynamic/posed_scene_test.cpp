#include "vlf/dynamic/posed_scene.h"
#include "support/analytic_scenes.h"
#include "vlf/scene/generate/primitives.h"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

DynamicObject red(const Pose& pose) {
    Material material;
    material.name = "red";
    material.diffuse = {1, 0, 0};
    DynamicObject object;
    object.model = std::make_shared<ObjectModel>(makePrimitive("cube", material));
    object.pose = pose;
    return object;
}

TEST(PosedScene, HasTheRoomFirstAndTheObjectsWhereTheyAre) {
    const Scene room = smallCornell();
    const Pose pose{{1, 2, 3}, glm::angleAxis(0.7f, glm::normalize(Vec3(1, 2, -1))), 0.3f};
    const std::vector<DynamicObject> objects{red(pose), red({{9, 9, 9}, {1, 0, 0, 0}, 1})};
    const Scene posed = posedScene(room, objects);
    const Scene& cube = objects[0].model->scene();
    const std::size_t first = room.triangles.size();
    ASSERT_EQ(posed.triangles.size(), first + 2 * cube.triangles.size());
    EXPECT_EQ(posed.cameras.size(), room.cameras.size());
    for (std::uint32_t t = 0; t < first; ++t) {
        EXPECT_EQ(posed.position(t, 0), room.position(t, 0));
        EXPECT_EQ(posed.material(t).name, room.material(t).name);
    }
    for (std::uint32_t t = 0; t < cube.triangles.size(); ++t) {
        const auto there = static_cast<std::uint32_t>(first + t);
        EXPECT_EQ(posed.material(there).name, "red");
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(posed.position(there, c), pose.point(cube.position(t, c)));
        EXPECT_LT(glm::distance(geometricNormal(posed, there),
                                pose.direction(geometricNormal(cube, t))),
                  1e-5f);
    }
}

TEST(PosedScene, LeavesOutWhatIsHidden) {
    DynamicObject hidden = red({});
    hidden.visible = false;
    const Scene room = smallCornell();
    EXPECT_EQ(posedScene(room, {&hidden, 1}).triangles.size(), room.triangles.size());
    EXPECT_EQ(posedScene(room, {}).triangles.size(), room.triangles.size());
}

}  // namespace
}  // namespace vlf::test
