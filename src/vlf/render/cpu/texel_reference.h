#pragma once
// Irradiance of given patches of surface by path tracing: the truth for the irradiance atlas.

#include "vlf/base/progress.h"
#include "vlf/render/cpu/path_integrator.h"

#include <span>
#include <vector>

namespace vlf {

/// The places of one texel: each sample starts at one of them, chosen uniformly. Give points
/// spread evenly over the area the texel covers.
using TexelArea = std::span<const SidePoint>;

struct IrradianceEstimate {
    Vec3 mean{0};               ///< W·m⁻², on the side the points lie on
    Vec3 standardError{0};      ///< of the mean; 0 with fewer than two valid samples
    std::uint32_t samples = 0;  ///< valid ones; 0: the texel is buried, its mean says nothing
};

struct IrradianceParams {
    int samplesPerTexel = 1024;  ///< >= 1
    std::uint64_t seed = 0;
    PathOptions paths;  ///< a path of one segment ends on an emitter that the texel sees
};

/// Mean irradiance over each texel's points. Samples whose direction first meets a side that is
/// not open are left out of both sum and count (ratio estimator), so that the part of a texel
/// that lies under other geometry has no say. A texel without points gets no samples. Random
/// numbers are keyed by seed, texel and sample. Throws Cancelled, and InputError if
/// samplesPerTexel < 1 or a point names no triangle of the scene.
std::vector<IrradianceEstimate> estimateIrradiance(const Scene& scene, const RayScene& rays,
                                                   std::span<const TexelArea> texels,
                                                   const SideIsOpen& isOpen,
                                                   const IrradianceParams& params,
                                                   Progress& progress);

}  // namespace vlf
