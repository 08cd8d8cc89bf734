#pragma once
// Light gathered by single rays: by those of a bundle that end on a mirror or glass and go on by
// reflection or transmission to a diffuse surface, and by texels of their own that the bundles hit
// too rarely.

#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/propagate/bundle_sweep.h"
#include "vlf/propagate/light_sources.h"
#include "vlf/trace/ray_scene.h"
#include "vlf/unwrap/unwrap.h"

#include <algorithm>
#include <vector>

namespace vlf {

/// Longest chain of mirrors and glass followed; what is left of the light then is dropped.
inline constexpr int kMaxReflections = 16;

/// Chance with which light of many paths is followed by way of a mirror of this reflectance: of
/// weak ones some, which then stand for all. What chance adds to the variance is at most a
/// sixteenth of the square of the light seen.
inline float chanceToFollow(const Vec3& reflectance) {
    return std::min(1.0f, 2 * maxComponent(reflectance));
}

/// Follows rays over mirrors and glass and adds the radiance found to their receivers. Of the
/// directions in which a rough mirror reflects, one is drawn; so is reflection or transmission.
/// Punctual lights and the bright part of the environment are sought from rough mirrors besides,
/// one of the former and one direction of the latter.
class RayGatherer {
  public:
    RayGatherer(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
                const LightSources& sources)
        : scene_(scene), rays_(rays), unwrap_(unwrap), sources_(sources) {}

    /// What the mirror sights of one subfield come to see, to the samples that the sweep has
    /// counted. `radiance`: diffuse radiance leaving each texel. Emission, and the environment
    /// where rays leave the scene, are added where the direct light does not have them already
    /// (LightSources::covers).
    void gatherFromMirrors(const ParallelSubfield& subfield, const std::vector<MirrorSight>& sights,
                           RandomStream& random, const TexelBuffer& radiance,
                           TexelBuffer& gathered);

    /// `count` cosine-distributed rays from entry i of unwrap.texels, each one more sample.
    void gatherFromTexel(std::size_t i, int count, RandomStream& random,
                         const TexelBuffer& radiance, TexelBuffer& gathered);

  private:
    struct Path {
        std::uint32_t receiver;
        int reflections;
        bool planarOnly;  // all of these so far, and perfect; no glass but panes passed straight
        bool fromTexel;   // not yet among the receiver's samples when it starts
        Vec3 throughput;
        int steps = 0;  // reflections and transmissions
        bool behindPanes = false;
        float lobe = 0;  // density of its direction by the rough mirror it leaves, sr⁻¹; 0: none
    };
    // A point of a rough mirror and how it is seen.
    struct RoughPoint {
        Vec3 position, side;
        Frame frame;
        Vec3 toEye;  // in it
        float roughness;
    };

    void startAtMirrors(const ParallelSubfield& subfield, const std::vector<MirrorSight>& sights,
                        RandomStream& random);
    void advance(RandomStream& random, const TexelBuffer& radiance, TexelBuffer& gathered);
    Vec3 radianceSeen(const Path& path, const Hit& hit, std::uint32_t chart, bool front,
                      const Vec3& position, const TexelBuffer& radiance) const;
    void reflect(Path path, const Vec3& direction, const Hit& hit, std::uint32_t chart, bool front,
                 const Vec3& position, RandomStream& random, TexelBuffer& gathered);
    void lightRough(const Path& path, const RoughPoint& at, RandomStream& random,
                    TexelBuffer& gathered) const;
    Vec3 punctualIn(const RoughPoint& at, RandomStream& random) const;
    Vec3 skyIn(const RoughPoint& at, RandomStream& random) const;
    Vec3 outsideSeen(const Path& path, const Vec3& direction) const;
    void passGlass(Path path, const Vec3& direction, const Hit& hit, bool front,
                   const Vec3& position, RandomStream& random);
    Ray texelRay(std::size_t texel, const Vec2& sample, RandomStream& random) const;
    bool isPlainMirror(std::uint32_t chart) const;
    bool isWithinGlass(const MirrorSight& sight) const;

    const Scene& scene_;
    const RayScene& rays_;
    const Unwrap& unwrap_;
    const LightSources& sources_;
    std::vector<Path> paths_, nextPaths_;
    std::vector<Ray> queue_, nextQueue_;
    std::vector<Hit> hits_;
};

}  // namespace vlf
