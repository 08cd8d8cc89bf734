#pragma once
// Where light bends, by block of surface: what interpolation between texels misses there, and how
// that falls with their size.

#include "vlf/propagate/bake.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace vlf {

/// A part of a surface.
struct BendBlock {
    double area = 0;    ///< m²
    double texels = 0;  ///< that it was measured with
    double fine = 0;    ///< ∫ square bend dA of the texels there are, (W·m⁻²)² m²
    double coarse = 0;  ///< the same, of four of them taken together

    /// ∫ square error dA of light interpolated between texels of a size (metres), (W·m⁻²)² m².
    double squareError(double texelSize) const;
};

/// Block of a place on a chart; kNoBlock: none of interest.
inline constexpr std::uint32_t kNoBlock = 0xffffffffu;
using BlockOf = std::function<std::uint32_t(std::uint32_t triangle, const Vec3& position)>;

/// By block, numbered from 0 on, of a state whose sweeps have ended.
std::vector<BendBlock> findBend(const BakeState& state, const BlockOf& blockOf);

}  // namespace vlf
