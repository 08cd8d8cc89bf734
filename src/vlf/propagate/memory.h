#pragma once
// How much memory a bake will need, before it starts.

#include "vlf/propagate/bake.h"

#include <cstdint>

namespace vlf {

struct MemoryNeed {
    std::uint64_t transport = 0;  ///< bytes: geometry, textures, texels, accumulators
    std::uint64_t radiance = 0;   ///< bytes: the radiance fields of the mirrors
    std::uint64_t scratch = 0;    ///< bytes of disk, not of memory: of those that live in files

    std::uint64_t total() const { return transport + radiance; }
};

/// Elements of the radiance fields, about.
struct MirrorElements {
    double perfect = 0, rough = 0;
};
MirrorElements predictElements(const Scene& scene, const BakeParams& params);

/// Predicted peak of a bake before it starts, from areas and counts alone. Mirrors of many small
/// charts take more. `scratch`: where large radiance fields are kept; null: in memory.
MemoryNeed predictMemory(const Scene& scene, const BakeParams& params,
                         const ScratchPlace* scratch = nullptr);

/// The same to 10 % or 15 MiB, of a bake whose charts are known. Radiance fields live where the state's
/// solution keeps them.
MemoryNeed predictMemory(const BakeState& state);

/// Throw InputError if the bake would need more than `bytes`, naming the settings that bring it
/// down and by how much.
void requireMemory(const Scene& scene, const BakeParams& params, std::uint64_t bytes,
                   const ScratchPlace* scratch = nullptr);
void requireMemory(const BakeState& state, std::uint64_t bytes);

}  // namespace vlf
