#pragma once
// A picture of floats to draw into.

#include "vlf/render/gl/gl_object.h"

namespace vlf::gl {

/// Radiance in `color`, with depth.
struct FloatTarget {
    int width = 0, height = 0;
    TextureObject color, depth;
    Framebuffer framebuffer;

    FloatTarget() = default;
    FloatTarget(int w, int h);
};

}  // namespace vlf::gl
