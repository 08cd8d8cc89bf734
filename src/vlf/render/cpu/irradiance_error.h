#pragma once
// How far baked irradiance is from the truth.

#include "vlf/render/cpu/texel_reference.h"

#include <span>

namespace vlf {

/// Area-weighted errors over the texels that have a reference. All relative, 0.01 = 1 %.
struct IrradianceError {
    double relativeRmse = 0;     ///< √(Σ(E−E*)² / ΣE*²), the truth's own variance subtracted
    double measuredRmse = 0;     ///< the same with the truth's noise in it
    double truthError = 0;       ///< standard error of the truth, pooled the same way
    double bias = 0;             ///< Σ(E−E*) / ΣE*
    double biasError = 0;        ///< standard error of the bias through the truth's noise
    double meanRelative = 0;     ///< mean of |E−E*| / E* by luminance, the truth's noise in it
    std::size_t texels = 0;
};

/// baked, reference and area are of the same texels. Texels without valid samples are left out.
IrradianceError compareIrradiance(std::span<const Vec3> baked,
                                  std::span<const IrradianceEstimate> reference,
                                  std::span<const float> area);

}  // namespace vlf
