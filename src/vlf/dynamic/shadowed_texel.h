#pragma once
// Direct light of the room's emitters that objects take from one texel.

#include "vlf/dynamic/obstruction.h"
#include "vlf/propagate/light_gatherer.h"
#include "vlf/trace/ray_instances.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

struct ShadowSampling {
    int samples = 64;  ///< of the emitters, from a texel, at most
    float slight = 0;  ///< luminance, W·m⁻²: an error that does not matter
};

/// Of texels that lie together. One for each thread. Refers to what it is given.
class ShadowedTexel {
  public:
    /// `casters` are the objects that stand in `obstructions`, `shadows` those that may hide
    /// something from one of the texels, image by image.
    ShadowedTexel(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                  const RayInstances& casters, const Obstructions& obstructions,
                  std::span<const MayHide> shadows, const ShadowSampling& sampling);

    /// Irradiance, W·m⁻² >= 0.
    Vec3 loss(const LightReceiver& receiver);

  private:
    /// An object that hides a part of a light which seems larger than it.
    struct Spot {
        std::uint32_t image;
        const Obstruction::Object* object;
        int step;  ///< every so many of the object's patches
    };
    struct Point {
        Vec3 position, shading, geometric;
    };
    /// A ray from the texel to an object, as if there were no mirrors, and how it goes on.
    struct Look {
        Ray ray;
        float weight;
        float met;           ///< distance of the object
        Vec3 throughput{1};  ///< of the mirrors that it has met
    };

    int stepFor(float taken) const;
    void sort(const LightReceiver& receiver);
    void sort(const LightReceiver& receiver, std::span<const MayHide> ofImage);
    void findPoints(const LightReceiver& receiver);
    Vec3 behind(const Spot& spot);
    std::span<const Point> foldedPoints(const Spot& spot);
    void aim(const Spot& spot);
    void keepThoseThatMeet(const Spot& spot);
    void reflect(const Spot& spot, int mirror);
    void findHits();
    void findHitsBehindPanes();
    template <class Keep>
    void keepLooks(Keep keep);
    Vec3 emissionAt(const Hit& hit, const Vec3& direction, std::uint32_t light) const;

    const Scene& scene_;
    const RayScene& rays_;
    const RoomTexels& room_;
    const RayInstances& casters_;
    const Obstructions& obstructions_;
    std::span<const MayHide> shadows_;
    ShadowSampling sampling_;
    LightGatherer gatherer_;
    bool anySampled_ = false;
    struct Memory {
        std::vector<std::uint8_t> sampled;  ///< by image
        std::vector<Spot> spots;
        std::vector<Point> points;  ///< of the texel
        std::vector<Point> folded;
        std::vector<Look> looks;
        std::vector<Ray> queue;
        std::vector<InstanceHit> hits;
        std::vector<Hit> roomHits;
        std::vector<std::uint8_t> blocked;
    };
    Memory memory_;  ///< the thread's during loss()
};

}  // namespace vlf
