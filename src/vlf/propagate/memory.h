#pragma once
// How much memory a bake will need, before it starts.

#include "vlf/propagate/bake.h"

#include <cstdint>

namespace vlf {

struct MemoryNeed {
    std::uint64_t transport = 0;  ///< bytes: geometry, texels, accumulators
    std::uint64_t radiance = 0;   ///< bytes: the radiance field of the mirrors

    std::uint64_t total() const { return transport + radiance; }
};

/// Predicted peak of a bake, from areas and counts alone.
MemoryNeed predictMemory(const Scene& scene, const BakeParams& params);

/// Throws InputError if the bake would need more than `bytes`, naming the settings that bring it
/// down and by how much.
void requireMemory(const Scene& scene, const BakeParams& params, std::uint64_t bytes);

}  // namespace vlf
