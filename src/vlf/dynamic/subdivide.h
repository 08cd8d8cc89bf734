#pragma once
// Finer meshes of the same shape.

#include "vlf/scene/scene.h"

namespace vlf {

/// Every triangle cut into four at the middles of its edges; normals and texture coordinates are
/// interpolated. The triangles 4t to 4t + 3 are those of triangle t.
Scene subdivide(const Scene& scene);

}  // namespace vlf
