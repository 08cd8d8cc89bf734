#include "vlf/display/exposure.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

Exposure adapted(float wanted, float seconds, int frames) {
    Exposure exposure(1);
    exposure.setAutomatic(true);
    for (int i = 0; i < frames; ++i) exposure.adapt(wanted, seconds / static_cast<float>(frames));
    return exposure;
}

TEST(Exposure, FixedStaysWhateverIsSeen) {
    Exposure exposure(1);
    exposure.adapt(5, 10);
    EXPECT_EQ(exposure.value(), 1);
}

TEST(Exposure, AutomaticComesToWhatSuitsTheViewSmoothlyAtAnyFrameRate) {
    EXPECT_NEAR(adapted(5, 10, 100).value(), 5, 1e-3);
    const float slow = adapted(5, 0.3f, 3).value(), quick = adapted(5, 0.3f, 100).value();
    EXPECT_NEAR(slow, quick, 1e-4);
    EXPECT_GT(quick, 1.5f);
    EXPECT_LT(quick, 4);
}

TEST(Exposure, WhatTheUserAddsIsKept) {
    Exposure exposure = adapted(5, 10, 100);
    exposure.setCompensation(-0.5f);
    EXPECT_NEAR(exposure.value(), 4.5f, 1e-3);
    exposure.setAutomatic(false);
    EXPECT_NEAR(exposure.value(), 4.5f, 1e-3) << "it stays where it is";
}

}  // namespace
}  // namespace vlf
