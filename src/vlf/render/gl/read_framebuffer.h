#pragma once
// What a framebuffer shows, as a picture.

#include "vlf/image/image.h"

namespace vlf {

/// The lower left width x height pixels of `framebuffer` (0: the window), in display-linear
/// colours: its values are taken as sRGB-encoded. Leaves the context's state as it was.
Image readFramebuffer(unsigned framebuffer, int width, int height);

}  // namespace vlf
