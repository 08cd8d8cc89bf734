#include "viewer/object_pointer.h"

#include "placed_objects.h"

#include <gtest/gtest.h>

namespace vlf::app {
namespace {

using test::PlacedObjects;

struct Pointed : PlacedObjects {
    Screen screen{{"", {4.3f, 1.2f, -0.5f}, {4.3f, 0.5f, 1}, {0, 1, 0}, 60}, {800, 600}};
    ObjectPointer pointer{*objects};

    Vec2 pointOf(std::size_t i) const { return *screen.point(objects->now(i).pose.translation); }
    void click(const Vec2& at) {
        pointer.press(screen, at, 1);
        pointer.release(screen, at);
    }
};

TEST(ObjectPointer, AClickSelectsWhatIsThereAndNothingElsewhere) {
    Pointed p;
    p.click(p.pointOf(1));
    EXPECT_EQ(p.objects->selected(), 1u);
    p.click(p.pointOf(0));
    EXPECT_EQ(p.objects->selected(), 0u);
    p.click({790, 20});
    EXPECT_FALSE(p.objects->selected());
}

TEST(ObjectPointer, ADragThatLooksAroundSelectsNothing) {
    Pointed p;
    p.click(p.pointOf(0));
    p.pointer.press(p.screen, {700, 50}, 1);
    p.pointer.drag({600, 80});
    EXPECT_FALSE(p.pointer.held());
    p.pointer.release(p.screen, p.pointOf(1));
    EXPECT_EQ(p.objects->selected(), 0u);
}

TEST(ObjectPointer, ADragOfAnArmMovesTheObjectAlongIt) {
    Pointed p;
    EXPECT_FALSE(p.pointer.gizmo(p.screen, 1)) << "nothing is selected";
    p.click(p.pointOf(0));
    const Pose before = p.objects->now(0).pose;
    const Vec2 end = *p.screen.point(p.pointer.gizmo(p.screen, 1)->armEnd(0));
    p.pointer.press(p.screen, end, 1);
    EXPECT_EQ(p.pointer.held(), (GizmoHandle{GizmoPart::arm, 0}));
    for (int step = 1; step <= 10; ++step) p.pointer.drag(end + Vec2(5 * step, 0));
    const Vec3 way = p.objects->now(0).pose.translation - before.translation;
    EXPECT_LT(way.x, -0.05f) << "it looks along +Z";
    EXPECT_LT(glm::length(Vec2(way.y, way.z)), 1e-4f);
    p.pointer.release(p.screen, end + Vec2(50, 0));
    EXPECT_EQ(p.objects->selected(), 0u);
    EXPECT_FALSE(p.pointer.held());
    p.pointer.drag(end);
    EXPECT_EQ(p.objects->now(0).pose.translation, before.translation + way) << "the button is up";
}

TEST(ObjectPointer, ADragMovesTheObjectItBeganWithAlone) {
    Pointed p;
    p.click(p.pointOf(0));
    const Pose sphere = p.objects->now(1).pose;
    const Vec2 end = *p.screen.point(p.pointer.gizmo(p.screen, 1)->armEnd(0));
    p.pointer.press(p.screen, end, 1);
    p.objects->selectNext();
    p.pointer.drag(end + Vec2(50, 0));
    EXPECT_EQ(p.objects->now(1).pose, sphere);
}

TEST(ObjectPointer, AnInvisibleObjectHasNoGizmo) {
    Pointed p;
    p.click(p.pointOf(0));
    ASSERT_TRUE(p.pointer.gizmo(p.screen, 1));
    p.objects->setVisible(0, false);
    EXPECT_FALSE(p.pointer.gizmo(p.screen, 1));
}

}  // namespace
}  // namespace vlf::app
