#pragma once
// Light that comes to an object from the room around it, in spherical harmonics: what precomputed
// transfer makes irradiance of.

#include "vlf/dynamic/emitter_points.h"
#include "vlf/dynamic/lit_object.h"
#include "vlf/dynamic/prt_transfer.h"
#include "vlf/dynamic/room_texels.h"
#include "vlf/dynamic/sight.h"
#include "vlf/math/spherical_harmonics.h"
#include "vlf/scene/light_beam.h"
#include "vlf/trace/ray_instances.h"

#include <array>
#include <span>
#include <vector>

namespace vlf {

/// How emitters count.
enum class IncidentEmitters {
    sampled,  ///< at points of theirs
    met,      ///< where directions happen to meet them
    none,     ///< not at all: their light is to be sampled at the vertices, as LightGatherer does
};

struct IncidentSettings {
    int lines = 129;       ///< of the direction set at the middle of a small object
    int cornerLines = 33;  ///< at each corner of a large one
    IncidentEmitters emitters = IncidentEmitters::sampled;
    int emitterPoints = 16;       ///< of all emitters, and of the bright sky, at the middle
    int cornerEmitterPoints = 8;  ///< at each corner
    float largeFrom = 0.02f;      ///< radius of a large object, relative to the room's
};

/// Incident radiance in an object's space.
struct IncidentLight {
    bool uniform = true;              ///< corners[0] is that all over the object
    std::array<Sh<Vec3>, 8> corners;  ///< of the object's box, numbered as in applyTransfer
};

void applyTransfer(const PrtTransfer& transfer, const IncidentLight& light,
                   std::span<Vec3> irradiance);

/// Finds it. Refers to what it is given.
class IncidentLightFinder {
  public:
    IncidentLightFinder(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                        const IncidentSettings& settings = {});

    /// Memory of one thread, kept from call to call.
    struct Scratch {
        explicit Scratch(const IncidentLightFinder& finder)
            : tracer(finder.scene_, finder.rays_, finder.room_) {}

        SightTracer tracer;
        Sights sights;
        std::vector<Ray> rays;
        std::vector<InstanceHit> hits;
        std::vector<std::uint8_t> blocked, blockedByObjects;
        std::vector<Vec3> passed;
        std::vector<Vec3> seen;
        std::vector<float> solidAngles;
        std::vector<std::uint32_t> points;
        std::vector<LightBeam> beams;
    };

    /// For an object with this box, in its own space, at `pose`. `radiance` is what the room's
    /// covered texels reflect, by atlas index. Other objects are seen outside the object's own box
    /// and not in mirrors.
    void find(const Bounds& box, const Pose& pose, std::span<const Vec3> radiance,
              const SightObjects& others, Scratch& scratch, IncidentLight& light) const;

    /// At one point, in the world's directions, with `lines` and `emitterPoints` of the settings.
    Sh<Vec3> at(const Vec3& point, std::span<const Vec3> radiance, Scratch& scratch) const;

  private:
    /// Where and how light is sampled.
    struct Pattern {
        std::vector<Vec3> directions;
        std::vector<Sh<float>> weights;  ///< of what is seen along them, in each coefficient
        EmitterPoints emitters;
        std::vector<LightBeam> sky;  ///< of its bright part
    };
    /// What is to be left out: an object that is about the point.
    struct Body {
        const Bounds* box = nullptr;
        const Pose* pose = nullptr;
        const SightObjects* others = nullptr;
    };

    static Pattern makePattern(const Scene& scene, const LightSources& sources, int lines,
                               int emitterPoints, int number);
    Sh<Vec3> sample(const Vec3& point, const Pattern& pattern, std::span<const Vec3> radiance,
                    const Body& body, Scratch& scratch) const;
    void look(const Pattern& pattern, std::span<const Vec3> radiance, const Body& body,
              Scratch& scratch) const;
    void addEmitters(const Vec3& point, const Pattern& pattern, const Body& body, Scratch& scratch,
                     Sh<Vec3>& light) const;
    void addBeams(const Vec3& point, const Pattern& pattern, const Body& body, Scratch& scratch,
                  Sh<Vec3>& light) const;
    void findPassed(const Body& body, Scratch& scratch) const;
    bool isSeenOverMirrors(const Vec3& point, const EmitterPoint& emitter, const LightImage& image,
                           Vec3& throughput) const;
    Vec3 cornerPoint(const Bounds& box, const Pose& pose, int corner) const;

    const Scene& scene_;
    const RayScene& rays_;
    const RoomTexels& room_;
    float largeRadius_;
    IncidentEmitters emitters_;
    Pattern middle_;
    std::array<Pattern, 8> corners_;
};

}  // namespace vlf
