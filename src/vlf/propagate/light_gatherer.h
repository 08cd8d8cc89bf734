#pragma once
// Direct light at a point or a small piece of surface: samples of the emitters and of their images
// in planar mirrors.

#include "vlf/math/pose.h"
#include "vlf/propagate/direct_refinement.h"
#include "vlf/propagate/light_sources.h"
#include "vlf/trace/ray_scene.h"
#include "vlf/unwrap/unwrap.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace vlf {

class RandomStream;

/// What receives light: points of the surface of `scene`, which `pose` puts into the world.
struct LightReceiver {
    const Scene* scene = nullptr;
    const Pose* pose = nullptr;  ///< null: `scene` is in the world
    std::span<const SurfacePoint> points;
    Vec3 centre{0}, normal{0};  ///< in the world
    float radius = 0;
    bool planar = true;     ///< else normals vary so much that the mean says little
    float side = 1;         ///< -1: the side against the winding normals
    std::uint64_t key = 0;  ///< of its random numbers
};

/// Entry i of unwrap.texels.
LightReceiver texelReceiver(const Scene& scene, const Unwrap& unwrap, std::size_t i);

/// ∫ (n·ω)⁺ / π over the directions above the surface, n being the shading normal. Divided by
/// it a receiver's response integrates to one, as that of the bundles' ratio does.
inline float receiverLobe(const Vec3& shading, const Vec3& geometric) {
    return 0.5f * (1 + glm::dot(shading, geometric));
}

/// Whether lines from within `receiver` to within `image`, what is seen of something in a planar
/// mirror (with its LightSources::mirrorOffset), may cross the rectangle of the mirror.
bool mayBeSeenIn(const Chart& mirror, float offset, const Sphere& receiver, const Sphere& image);

/// Marks rays that something in the way of `lights` blocks, besides the room: blocked[i] = 1.
/// Others are left alone.
using ExtraOccluder = std::function<void(std::span<const Ray>, std::span<std::uint8_t> blocked)>;

/// Samples the light of `sources`. Refers to what it is given; copies are for other threads.
class LightGatherer {
  public:
    /// `scene`, `rays` and `unwrap` are those of the room, with the sources' emitters.
    LightGatherer(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
                  const LightSources& sources, std::uint64_t seed)
        : scene_(scene), rays_(rays), unwrap_(unwrap), sources_(sources), seed_(seed) {}

    /// Things in the room that its rays do not know of.
    void setExtraOccluder(ExtraOccluder occluder) { extra_ = std::move(occluder); }

    /// Of LightSources::images only those whose entry is not 0 count from now on; empty: all.
    void setImages(std::span<const std::uint8_t> counted) { counted_ = counted; }

    /// Where lights are many, they are weighed once for all of these neighbours, which come next;
    /// an empty span: each receiver for itself again.
    void weighTogether(std::span<const LightReceiver> receivers);

    /// Roughly the luminance of the unoccluded irradiance, W·m⁻²; zero only if it certainly is.
    /// Reads of the receiver only its bounds and normal.
    float likelyEffect(const LightReceiver& r, const LightImage& image) const;

    /// Irradiance by about `samples` shadow rays; `pass` tells independent estimates of the same
    /// receiver apart.
    DirectEstimate irradiance(const LightReceiver& receiver, int samples, std::uint64_t pass);

    /// That part of the room's own irradiance there that the extra occluder takes away.
    Vec3 irradianceBlocked(const LightReceiver& receiver, int samples);

  private:
    struct Point {
        Vec3 position, shading, geometric;
    };
    /// Where light comes from: a place, or a unit direction of infinitely far.
    struct Target {
        Vec3 at;
        bool distant;
    };
    struct Sample {
        float geometry;
        Vec3 radiance, throughput;  // throughput: of mirrors or panes on the way; 0 if occluded
        bool odd;                   // in which half of the samples it is
    };
    enum class Counts { seen, blockedByExtra };
    /// What the images are likely to do, which tells how many samples are theirs.
    struct Weights {
        std::vector<float> effects;  ///< of all
        float sum = 0;
        std::vector<std::uint32_t> apart,
            together;             ///< images that have samples of their own; share
        std::vector<float> upTo;  ///< of those that share, the effect up to and including each

        void clear() {
            effects.clear(), apart.clear(), together.clear(), upTo.clear();
            sum = 0;
        }
    };

    DirectEstimate estimateAll(const LightReceiver& r, int samples, std::uint64_t pass);
    void weigh(const LightReceiver& receiver, Weights& weights) const;
    DirectEstimate gatherTogether(const LightReceiver& r, const Weights& weights, int n,
                                  RandomStream& random);
    float likelyPunctual(const LightReceiver& r, const LightImage& image) const;
    float likelySky(const LightReceiver& r, const LightImage& image) const;
    bool mayBeSeenInMirror(const LightReceiver& r, const LightImage& image) const;
    Point surfacePoint(const LightReceiver& r, std::size_t i) const;
    static std::size_t pointNumber(const LightReceiver& r, int j, int n, float rotation);
    Point pointOf(const LightReceiver& r, int j, int n, float rotation) const;
    DirectEstimate gather(const LightReceiver& r, const LightImage& image, int n,
                          RandomStream& random);
    bool isCompact(const LightReceiver& r, const LightImage& image) const;
    DirectEstimate gatherBySamples(const LightReceiver& r, const LightImage& image, int n,
                                   RandomStream& random);
    DirectEstimate gatherByFormFactor(const LightReceiver& r, const LightImage& image, int n,
                                      RandomStream& random);
    DirectEstimate meanOfSamples(int n) const;
    float nearReach(const LightReceiver& r, const LightImage& image) const;
    void drawNearSamples(const LightReceiver& r, const Light& light, int n, float reach,
                         RandomStream& random);
    void drawSamples(const LightReceiver& r, const LightImage& image, int n, float reach,
                     RandomStream& random);
    DirectEstimate gatherBeams(const LightReceiver& r, const LightImage& image, int n,
                               RandomStream& random);
    void drawPunctualSamples(const LightReceiver& r, const LightImage& image, int n,
                             RandomStream& random);
    void drawSkySamples(const LightReceiver& r, const LightImage& image, int n,
                        RandomStream& random);
    /// The j-th.
    void addSample(int j, const Point& p, const LightImage& image, const Target& target,
                   float geometry, const Vec3& radiance);
    void findVisible();
    void keepBlockedByExtra();
    bool extraBlocks(const Ray& ray);
    float formFactor(const LightReceiver& r, const Light& light, const LightImage& image) const;
    float formFactor(const Point& p, const Light& light, const LightImage& image) const;
    Ray shadowRay(const Vec3& origin, const Target& target) const;
    bool mayCrossMirrors(const Vec3& p, const LightImage& image, const Target& target) const;
    Vec3 followImage(const Point& p, const LightImage& image, const Target& target);

    const Scene& scene_;
    const RayScene& rays_;
    const Unwrap& unwrap_;
    const LightSources& sources_;
    std::uint64_t seed_;
    ExtraOccluder extra_;
    std::span<const std::uint8_t> counted_;
    Counts counts_ = Counts::seen;
    std::optional<Weights> shared_;
    struct Memory {
        Weights weights;
        std::vector<Ray> shadowRays;
        std::vector<std::uint8_t> blocked, blockedByExtra;
        std::vector<Vec3> passed;
        std::vector<Sample> samples;
    };
    Memory memory_;  ///< the thread's while it works
};

}  // namespace vlf
