#pragma once
// A point of a surface as a path sees it.

#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

namespace vlf {

/// A surface point with its geometry and reflection. Both normals are unit and lie on the side of
/// the point (n·g >= 0).
struct Surface {
    SidePoint point;
    Vec3 position{0};
    Vec3 normal{0};           ///< interpolated
    Vec3 geometricNormal{0};  ///< of the triangle's plane
    Vec3 diffuse{0};          ///< Lambertian reflectance
    Vec3 mirror{0};           ///< specular reflectance
    float roughness = 0;      ///< of that; 0: a perfect mirror

    bool reflects() const { return maxComponent(diffuse + mirror) > 0; }
    bool isPerfectMirror() const { return roughness <= 0; }
};

/// The side of a hit triangle that faces against `direction`.
SidePoint pointFacing(const Scene& scene, const Hit& hit, const Vec3& direction);

Surface surfaceAt(const Scene& scene, const SidePoint& point);

/// Radiance that leaves the surface by itself, W·m⁻²·sr⁻¹; zero on the dark side of an emitter.
Vec3 emittedRadiance(const Scene& scene, const SidePoint& point);

/// Density per steradian of cosine-distributed directions about the shading normal, of which those
/// below the surface are left out: (n·ω) / (π (1 + n·g) / 2), as ∫ (n·ω)⁺ over the hemisphere of g
/// is π (1 + n·g) / 2. A Lambertian reflector with this lobe keeps its albedo whatever its shading
/// normal, and no light passes through the surface. Zero below either normal's horizon.
float cosineLobe(const Surface& surface, const Vec3& direction);

/// Reflects against `incoming`; about the geometric normal where the shading normal would send
/// the ray into the surface.
Vec3 mirrorDirection(const Surface& surface, const Vec3& incoming);

}  // namespace vlf
