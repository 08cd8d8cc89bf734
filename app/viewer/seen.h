#pragma once
// What a picture of a room shows.

#include "vlf/render/gl/renderer.h"

#include <cstdint>

namespace vlf::app {

struct Seen {
    Camera camera;
    RenderSettings settings;         ///< of a mode that is no diagram
    int width = 0, height = 0;       ///< pixels
    std::uint64_t lightChanges = 0;  ///< of the renderer

    /// Whether the pictures are the same.
    friend bool operator==(const Seen& a, const Seen& b);
};

}  // namespace vlf::app
