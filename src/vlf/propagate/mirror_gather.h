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
        int reflections;
        bool planarOnly;
        Vec3 throughput;
    };

    void start(const ParallelSubfield& subfield, const std::vector<MirrorSight>& sights);
    void advance(const TexelBuffer& radiance, TexelBuffer& gathered);
    Vec3 radianceSeen(const Path& path, const Hit& hit, std::uint32_t chart, bool front,
                      const Vec3& position, const TexelBuffer& radiance) const;
    void reflect(Path path, const Vec3& direction, const Hit& hit, std::uint32_t chart, bool front,
                 const Vec3& position);
    bool isPlainMirror(std::uint32_t chart) const;

    const Scene& scene_;
    const RayScene& rays_;
    const Unwrap& unwrap_;
    const LightSources& sources_;
    std::vector<Path> paths_, nextPaths_;
    std::vector<Ray> queue_, nextQueue_;
    std::vector<Hit> hits_;
};

}  // namespace vlf
