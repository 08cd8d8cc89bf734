#include "vlf/display/window.h"

#include "vlf/base/error.h"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

namespace vlf {
namespace {

TEST(Window, WithoutADisplayIsAnErrorWithAdvice) {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    try {
        const Window window({});
        FAIL() << "there is no display";
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("no display"), std::string::npos) << e.what();
        EXPECT_NE(std::string(e.what()).find("vlf render"), std::string::npos) << e.what();
    }
}

}  // namespace
}  // namespace vlf
