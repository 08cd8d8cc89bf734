#pragma once
// The rival of the bundles: every texel gathers light by rays of its own.
//
// A radiosity gather as one would write it with a ray tracing library: cosine-distributed rays from
// each texel, the radiance of the texel they meet read there, mirrors followed by reflection. The
// ratio estimator, what counts as a sample and which emission the direct light holds already are as
// in the bake.

#include "vlf/propagate/bake.h"
#include "vlf/propagate/texel_buffer.h"

#include <cstdint>
#include <vector>

namespace vlf::bench {

class TexelGather {
  public:
    /// Keeps a reference to `state`.
    explicit TexelGather(const BakeState& state);

    /// Adds to `gathered` the radiance seen and the number of samples, per atlas texel, of `count`
    /// rays from each of the unwrap's texels. `radiance`: diffuse radiance leaving each; where its
    /// weight is 0, none is known and a ray no sample. Calls of different seeds are independent.
    void gather(const TexelBuffer& radiance, int count, std::uint64_t seed,
                TexelBuffer& gathered) const;

  private:
    struct Path;
    struct Start;
    struct Queue;

    std::vector<Start> startsOf(std::size_t texel) const;
    void gatherPacket(std::size_t first, int count, std::uint64_t seed, const TexelBuffer& radiance,
                      TexelBuffer& gathered) const;
    void trace(Queue& queue, const TexelBuffer& radiance, TexelBuffer& gathered) const;
    void arrive(const Path& path, const Ray& ray, const Hit& hit, const TexelBuffer& radiance,
                TexelBuffer& gathered, Queue& reflected) const;
    Vec3 emissionSeen(const Path& path, const Hit& hit, bool front) const;
    void reflect(Path path, const Ray& ray, const Hit& hit, bool front, Queue& reflected) const;

    const BakeState& state_;
    std::vector<Vec3> normals_;  ///< unit winding normal of each triangle
};

}  // namespace vlf::bench
