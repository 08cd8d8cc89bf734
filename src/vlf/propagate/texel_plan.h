#pragma once
// Texels where the error is: a quick bake with large texels tells where light bends, and pieces of
// flat surfaces get finer texels there and coarser ones elsewhere, for the same number in all.

#include "vlf/propagate/bake.h"

namespace vlf {

/// Plans the texels of a bake and cuts the scene where their size changes: the same surface in more
/// triangles, to be baked and shown in place of the scene. Returns the pieces, for
/// BakeParams::pieces; none, of the scene as it was, where even texels are as good. Deterministic.
/// Throws Cancelled, InputError as bake() does.
TexelPieces planTexels(Scene& scene, const BakeParams& params, Progress& progress);

}  // namespace vlf
