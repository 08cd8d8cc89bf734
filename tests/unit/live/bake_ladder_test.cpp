#include "vlf/live/bake_ladder.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

std::vector<std::string> names(const std::vector<BakeParams>& rungs) {
    std::vector<std::string> names;
    for (const BakeParams& p : rungs) names.push_back(p.preset);
    return names;
}

TEST(BakeLadder, ClimbsToTheWantedPresetAndNoFurther) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(names(bakeLadder(presetParams("draft"))), (Names{"preview", "draft"}));
    EXPECT_EQ(names(bakeLadder(presetParams("high"))),
              (Names{"preview", "draft", "standard", "high"}));
}

TEST(BakeLadder, EndsWithExactlyWhatIsWanted) {
    BakeParams wanted = presetParams("standard");
    wanted.texelSize = 0.125f;
    wanted.directSamples = 7;
    EXPECT_EQ(bakeLadder(wanted).back().texelSize, 0.125f);
    EXPECT_EQ(bakeLadder(wanted).back().directSamples, 7);
}

TEST(BakeLadder, EveryRungShowsTheSameKindOfLight) {
    BakeParams wanted = presetParams("standard");
    wanted.seed = 42;
    wanted.maxBounces = 2;
    wanted.radianceDirections = 0;
    for (const BakeParams& p : bakeLadder(wanted)) {
        EXPECT_EQ(p.seed, 42u);
        EXPECT_EQ(p.maxBounces, 2);
        EXPECT_EQ(p.radianceDirections, 0);
    }
}

}  // namespace
}  // namespace vlf
