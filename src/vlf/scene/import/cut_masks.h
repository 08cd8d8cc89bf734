#pragma once
// Holes where alpha masks are transparent.

#include "vlf/scene/import/alpha_mask.h"
#include "vlf/scene/import/import.h"

namespace vlf {

/// How finely masks are cut. Both limits hold for a scene file.
struct MaskLimits {
    std::size_t mostSamples = std::size_t{1} << 26;  ///< of opacity
    /// Triangles gained, unless so many have masks: at least one for each of those.
    std::size_t mostTriangles = 250'000;
    int mostSteps = 1024;  ///< samples along an edge
};

/// Cuts every masked triangle along the line where its mask, interpolated bilinearly, passes the
/// threshold, and drops what is transparent. The line follows samples half a texel apart and keeps
/// within 0.15 texels of them; new vertices get interpolated normals and texture
/// coordinates. Triangles that are solid all over stay as they are. Where the limits ask for it,
/// masks are halved in resolution, as often as needed, with a warning. Reports how many triangles
/// vanished and how many were cut. `file` is for messages.
void cutMasks(Scene& scene, const MaskedMaterials& masked, const std::string& file,
              ImportReport& report, const MaskLimits& limits = {});

}  // namespace vlf
