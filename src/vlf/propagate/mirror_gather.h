#pragma once
// Light that reaches the texels by way of mirrors: rays of the bundles that end on a mirror go on
// by reflection to a diffuse surface.

#include "vlf/propagate/bundle_sweep.h"
#include "vlf/propagate/light_sources.h"
#include "vlf/trace/ray_scene.h"
#include "vlf/unwrap/unwrap.h"

#include <vector>

namespace vlf {

/// Longest chain of mirrors followed; what is left of the light then is dropped.
inline constexpr int kMaxReflections = 16;

/// Follows mirror sights of one subfield and adds the radiance found to their receivers.
class MirrorGatherer {
  public:
    MirrorGatherer(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
                   const LightSources& sources)
        : scene_(scene), rays_(rays), unwrap_(unwrap), sources_(sources) {}

    /// `radiance`: diffuse radiance leaving each texel. Emission is added where the direct light
    /// does not have it already (LightSources::covers).
    void gather(const ParallelSubfield& subfield, const std::vector<MirrorSight>& sights,
                const TexelBuffer& radiance, TexelBuffer& gathered);

  private:
    struct Path {
        std::uint32_t receiver;
        Vec3 throughput;
        bool planarOnly;
    };

    void start(const ParallelSubfield& subfield, const std::vector<MirrorSight>& sights);
    void advance(int reflections, const TexelBuffer& radiance, TexelBuffer& gathered);

    const Scene& scene_;
    const RayScene& rays_;
    const Unwrap& unwrap_;
    const LightSources& sources_;
    std::vector<Path> paths_, nextPaths_;
    std::vector<Ray> rayQueue_, nextRays_;
    std::vector<Hit> hits_;
};

}  // namespace vlf
