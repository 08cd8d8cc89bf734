#pragma once
// Points of lit objects as paths see them.

#include "vlf/dynamic/lit_object.h"
#include "vlf/render/cpu/surface.h"

#include <optional>

namespace vlf {

/// Where a ray along `direction` has met the object, in the world's space; the triangle is the
/// object's own. Nothing on the inside of a solid, which is black.
std::optional<Surface> surfaceOf(const LitObject& object, const Hit& hit, const Vec3& direction);

/// Radiance that leaves a surface of the object by emission and diffuse reflection,
/// W·m⁻²·sr⁻¹.
Vec3 ownRadiance(const LitObject& object, const Surface& surface);

}  // namespace vlf
