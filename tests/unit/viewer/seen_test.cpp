#include "viewer/seen.h"

#include <functional>

#include <gtest/gtest.h>

namespace vlf::app {
namespace {

TEST(Seen, AnotherPictureIsNotTheSame) {
    const std::vector<std::function<void(Seen&)>> changes{
        [](Seen& s) { s.camera.eye.x += 1; },
        [](Seen& s) { s.camera.look.x += 1; },
        [](Seen& s) { s.camera.up.x += 1; },
        [](Seen& s) { s.camera.verticalFov += 1; },
        [](Seen& s) { s.settings.mode = DisplayMode::raytraced; },
        [](Seen& s) { s.settings.normals = true; },
        [](Seen& s) { s.settings.lookup = LookupKind::plain; },
        [](Seen& s) { s.settings.tone = ToneCurve::clamp; },
        [](Seen& s) { s.settings.exposure += 1; },
        [](Seen& s) { ++s.width; },
        [](Seen& s) { ++s.height; },
        [](Seen& s) { ++s.lightChanges; },
    };
    const Seen seen;
    EXPECT_EQ(seen, Seen());
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Seen other;
        changes[i](other);
        EXPECT_NE(seen, other) << i;
    }
}

}  // namespace
}  // namespace vlf::app
