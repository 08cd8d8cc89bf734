// Nothing allocates per frame: an object that moves where it has been uses the memory of the frames
// before.

#include "baked_room.h"
#include "support/count_allocations.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace vlf::test {
namespace {

/// What Embree itself allocates to build its hierarchies over the objects and over those that
/// throw shadows.
constexpr int kOfEmbree = 4;

/// The fewest of several moves from place to place: threads come to their memory in any order.
int allocationsToMove(DynamicRoom& room) {
    int fewest = std::numeric_limits<int>::max();
    Pose pose = room.object(0).pose;
    for (int i = 0; i < 12; ++i) {
        pose.translation.x = i % 2 == 0 ? 1.1f : 1.0f;
        allocations = 0;
        countsAllocations = true;
        room.setPose(0, pose);
        room.update();
        countsAllocations = false;
        if (i >= 4) fewest = std::min(fewest, allocations.load());
    }
    return fewest;
}

DynamicObject lit(const char* primitive, Shading shading, ShadowKind shadow) {
    DynamicObject object = bodyAt(primitive, {1, 0.5f, 1}, 0.5f, {0.8f, 0.1f, 0.1f});
    object.settings.shading = shading;
    object.settings.shadow = shadow;
    return object;
}

class MovingAnObject : public testing::Test {
  protected:
    void expectNoAllocation(const DynamicObject& object) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
        GTEST_SKIP() << "a sanitizer allocates in its own way";
#endif
        static const BakedRoom baked(lampRoom());
        FilledRoom filled(baked, {object});
        EXPECT_LE(allocationsToMove(filled.room), kOfEmbree);
    }
};

TEST_F(MovingAnObject, ThatGathersAllocatesNothing) {
    expectNoAllocation(lit("cube", Shading::gather, ShadowKind::field));
    expectNoAllocation(lit("sphere", Shading::gather, ShadowKind::field));
}

TEST_F(MovingAnObject, OfPrecomputedTransferAllocatesNothing) {
    expectNoAllocation(lit("knot", Shading::prt, ShadowKind::field));
}

TEST_F(MovingAnObject, LitByPointLightsAllocatesNothing) {
    expectNoAllocation(lit("cube", Shading::lights, ShadowKind::soft));
    expectNoAllocation(lit("cube", Shading::lights, ShadowKind::hard));
}

}  // namespace
}  // namespace vlf::test
