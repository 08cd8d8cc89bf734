#pragma once
// How far baked irradiance is likely to be off, found from the bake itself: from the spread of its
// samples, the light still missing, and the bend of the light from texel to texel.

#include <cstddef>
#include <vector>

namespace vlf {

struct BakeState;

/// Relative noise of one coarse sweep that is alike over whole charts, so that the last sweeps hand
/// it on; measured, of 129 directions.
inline constexpr double kCoarseSweepNoise = 5e-4;

/// Expected relative RMSE of irradiance, √(Σ A s² / Σ A E²) over the texels that scatter light, A
/// being their area, s the standard error and E the irradiance; 0.01 = 1 %.
struct ErrorReport {
    double direct = 0;     ///< noise of direct light
    double indirect = 0;   ///< noise of the last sweeps
    double missing = 0;    ///< light still missing, noise of the coarse sweeps that is left, and
                           ///< what large texels lose in the exchange
    double texelSize = 0;  ///< what interpolation between the texels misses

    /// Of the texels' irradiance, each held against the mean over its surface.
    double ofTexels() const;
    /// Of irradiance interpolated between the texels, held against that at any point.
    double interpolated() const;
};

/// Expected square errors by texel (entries of unwrap.texels), (W·m⁻²)², summed over the channels.
struct ErrorEstimate {
    std::vector<float> direct, indirect, missing;
    std::vector<float> texelSize;  ///< of a single texel it may be negative through noise

    /// All together, smoothed over neighbouring texels.
    std::vector<float> total;
};

/// Of a state whose sweeps have ended. Empty vectors before.
ErrorEstimate estimateError(const BakeState& state);

/// The same over all texels.
ErrorReport reportError(const BakeState& state, const ErrorEstimate& estimate);

/// For pictures: by atlas texel the standard error of what interpolation shows there, relative to
/// the light of the texel or, where that is darker, to a tenth of the room's (root mean square). 0
/// where no surface is.
std::vector<float> relativeErrors(const BakeState& state, const ErrorEstimate& estimate);

}  // namespace vlf
