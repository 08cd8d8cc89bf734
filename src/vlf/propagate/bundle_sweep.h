#pragma once
// One bundle of parallel rays, both senses at once: a scanline A-buffer of the whole scene seen
// along one direction, and the exchange of radiance between consecutive hits that face each other.

#include "vlf/field/parallel_subfield.h"
#include "vlf/propagate/bundle_faces.h"
#include "vlf/propagate/texel_buffer.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace vlf {

/// A ray of the bundle that leaves texel `receiver` in cell (x, y), along the direction (forward)
/// or against it, and meets texel `mirror` of a mirror at `mirrorDepth`.
struct MirrorSight {
    std::uint32_t receiver, mirror;
    float receiverDepth, mirrorDepth;
    std::uint16_t x, y;
    bool forward;
};

/// Radiance that comes from outside the scene: what a ray along the direction sees, and one against
/// it. W·m⁻²·sr⁻¹.
struct OutsideRadiance {
    Vec3 ahead{0}, behind{0};
};

/// Working memory of a sweep, reused from direction to direction by one thread.
class SweepScratch {
  public:
    SweepScratch();
    ~SweepScratch();
    SweepScratch(SweepScratch&&) noexcept;
    SweepScratch& operator=(SweepScratch&&) noexcept;

    struct Buffers;
    Buffers& buffers() { return *buffers_; }

  private:
    std::unique_ptr<Buffers> buffers_;
};

/// Sweeps one subfield. Adds to `gathered` what every texel hit sees in `radiance`: two hits that
/// face each other exchange, both ways; a hit that sees out of the scene takes `outside`; a hit
/// that sees the back of a surface is no sample. Sights of mirrors are appended to `mirrorSights`,
/// besides. Returns the number of exchanges. gathered, radiance: (atlas size + 1) entries, the last
/// of `radiance` being (0, 0, 0) with weight 1. N of the subfield in [2, 16384].
std::uint64_t sweepBundle(const BundleFaces& faces, const ParallelSubfield& subfield,
                          const TexelBuffer& radiance, TexelBuffer& gathered,
                          std::vector<MirrorSight>& mirrorSights, SweepScratch& scratch,
                          const OutsideRadiance& outside = {});

/// Instruction sets this machine can run the sweeps on, best first, e.g. {"AVX2", "SSE2"}. The best
/// is used unless useInstructionSet names another (throws InputError for one not in the list).
/// Results are reproducible within one instruction set. Not to be changed while a sweep runs.
std::vector<std::string> availableInstructionSets();
void useInstructionSet(const std::string& name);
std::string currentInstructionSet();

}  // namespace vlf
