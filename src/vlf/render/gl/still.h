#pragma once
// Still pictures by OpenGL.

#include "vlf/base/progress.h"
#include "vlf/image/image.h"
#include "vlf/render/cpu/still.h"
#include "vlf/render/gl/renderer.h"

namespace vlf {

/// As renderStill of render/cpu, by a renderer in the current context. The picture is the mean of
/// antialias² of them, shifted by parts of a pixel; the rays of mirrors are not counted. Throws
/// InputError if the renderer does not draw the mode, the camera has no view or a number is out of
/// range, and Cancelled.
Image renderStill(Renderer& renderer, const StillParams& params, Progress& progress,
                  StillReport* report = nullptr);

}  // namespace vlf
