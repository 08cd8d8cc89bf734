#pragma once
// What mirror objects show where no ray is to be traced through the room: a cube map of radiance
// and distance seen from the object's middle, looked up where the reflected ray meets what the map
// shows, after L. Szirmay-Kalos et al., "Approximate Ray-Tracing on the GPU with Distance
// Impostors", Eurographics 2005.

#include "vlf/math/vector.h"
#include "vlf/trace/ray_scene.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace vlf {

/// Six faces of size x size texels in the order and orientation of OpenGL's cube maps (+x -x +y -y
/// +z -z), rows from t = 0.
struct ReflectionProbe {
    Vec3 centre{0};
    int size = 0;
    std::vector<Vec3> radiance;          ///< W·m⁻²·sr⁻¹
    std::vector<float> inverseDistance;  ///< 1/m from the centre; 0: nothing there
    float farthest = 0;                  ///< metres to the farthest of what is there

    std::size_t texelCount() const { return std::size_t{6} * size * size; }

    /// Through the middle of a texel, unit.
    Vec3 direction(std::size_t texel) const;
};

/// Radiance that arrives along unit rays and the distance it comes from (infinite: from nowhere).
/// Called from several threads.
using ProbeSight =
    std::function<void(std::span<const Ray> rays, std::span<Vec3> radiance, std::span<float> from)>;

/// The probe at `centre`, of `size` >= 1.
void fillProbe(ReflectionProbe& probe, const Vec3& centre, int size, const ProbeSight& see);

struct ProbeView {
    Vec3 radiance{0};
    float distance = std::numeric_limits<float>::infinity();  ///< metres along the ray
};

/// What a ray of unit direction from a point near the probe's centre sees: it is followed in equal
/// angles about the centre until it lies behind what the probe shows, and met there by regula
/// falsi: on a plane, length over distance is linear along the ray. Surfaces that the centre does
/// not see are not found.
ProbeView lookUp(const ReflectionProbe& probe, const Vec3& origin, const Vec3& direction);

}  // namespace vlf
