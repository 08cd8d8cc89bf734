#pragma once
// Which glass is a pane and which the surface of a solid.

#include "vlf/scene/scene.h"

#include <cstdint>
#include <span>

namespace vlf {

/// Decides for glass of the given materials, whose transmission is that of a pane or of a whole
/// body: pieces connected by edges (vertices at the same position are one) are solid where every
/// edge belongs to exactly two triangles, panes elsewhere. Triangles without area and repeated ones
/// do not count. Of a material that is both, the solids get a copy. Triangles of solids are wound
/// alike, and outwards if the solid lies in no other; the surfaces of cavities are left as they
/// are.
void sortGlass(Scene& scene, std::span<const std::uint32_t> materials);

}  // namespace vlf
