// Nothing allocates per frame: neither a still view nor an object that moves where it has been.

#include "dynamic_example.h"
#include "support/count_allocations.h"

#include <algorithm>
#include <limits>

namespace vlf::test {
namespace {

constexpr DisplayMode kModes[] = {DisplayMode::field, DisplayMode::raytraced,
                                  DisplayMode::wireframe};

/// Of work that is done again and again, the fewest allocations once it has got going.
template <class Work>
int allocationsOf(const Work& work) {
    int fewest = std::numeric_limits<int>::max();
    for (int i = 0; i < 8; ++i) {
        allocations = 0;
        work(i);
        if (i >= 3) fewest = std::min(fewest, allocations.load());
    }
    return fewest;
}

template <class Work>
void counted(const Work& work) {  // the driver's threads do as they like
    countsOwnAllocations = true;
    work();
    countsOwnAllocations = false;
}

class FrameAllocation : public OpenGl {
  protected:
    void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
        GTEST_SKIP() << "a sanitizer allocates in its own way";
#endif
        OpenGl::SetUp();
    }

    void draw(Renderer& renderer, const Target& target, DisplayMode mode) const {
        const View view = viewOf(room_.camera("front"), 160, 120, renderer.nearest());
        RenderSettings settings;
        settings.mode = mode;
        counted([&] { renderer.draw(view, settings, target.framebuffer.id()); });
        glFinish();
    }

    const BakedExample& room_ = mirrorRoom();
};

TEST_F(FrameAllocation, OfARoomIsNone) {
    const Target target(160, 120);
    Renderer renderer(room_.scene, room_.field);
    for (const DisplayMode mode : kModes)
        EXPECT_EQ(allocationsOf([&](int) { draw(renderer, target, mode); }), 0)
            << static_cast<int>(mode);
}

TEST_F(FrameAllocation, OfAnObjectThatMovesIsNone) {
    const Target target(160, 120);
    Renderer renderer(room_.scene, room_.field);
    DynamicRoom dynamic(room_.scene, room_.rays, room_.field);
    dynamic.add(objectOf("sphere", {2.9f, 1.8f, 1.4f}, 0.8f));
    Pose pose = dynamic.object(0).pose;
    for (const DisplayMode mode : kModes) {
        const auto move = [&](int i) {
            pose.translation.x = i % 2 == 0 ? 2.9f : 3.0f;
            dynamic.setPose(0, pose);
            dynamic.update();
            counted([&] { renderer.updateObjects(dynamic); });
            draw(renderer, target, mode);
        };
        EXPECT_EQ(allocationsOf(move), 0) << static_cast<int>(mode);
    }
}

}  // namespace
}  // namespace vlf::test
