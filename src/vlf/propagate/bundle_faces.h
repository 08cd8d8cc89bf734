#pragma once
// The scene's surfaces as the bundle sweeps read them: one record per triangle side that has texels,
// or per triangle of a fan where a flat chart is convex, in structure-of-arrays order for SIMD.

#include "vlf/field/parallel_subfield.h"
#include "vlf/scene/scene.h"
#include "vlf/unwrap/unwrap.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vlf {

/// Arrays are padded to a multiple of kFacePadding with faces of no area.
struct BundleFaces {
    static constexpr std::size_t kFacePadding = 16;
    static constexpr std::uint32_t kMirror = 1;   ///< the material reflects as a mirror
    static constexpr std::uint32_t kFlipped = 2;  ///< the texels face against the winding normal

    FieldFrame frame;
    std::array<std::vector<float>, 3> x, y, z;  ///< vertices, metres from the frame's centre
    std::array<std::vector<float>, 3> u, v;     ///< their texel coordinates within the chart
    std::vector<std::uint32_t> origin;          ///< atlas index of the chart's texel (0, 0)
    std::vector<std::uint32_t> width, height;   ///< of the chart, texels
    std::vector<std::uint32_t> flags;
    std::uint32_t atlasWidth = 0;
    std::size_t count = 0;  ///< without padding
};

BundleFaces makeBundleFaces(const Scene& scene, const Unwrap& unwrap, const FieldFrame& frame);

}  // namespace vlf
