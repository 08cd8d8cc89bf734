#pragma once
// What the walkthrough can show; a row each.

#include "vlf/render/gl/renderer.h"

#include <array>

namespace vlf::app {

struct ViewMode {
    const char* name;
    const char* help;
    void (*apply)(RenderSettings& settings);
};

inline constexpr std::array kViewModes{
    ViewMode{"field", "diffuse light and mirrors from the field", [](RenderSettings&) {}},
};

}  // namespace vlf::app
