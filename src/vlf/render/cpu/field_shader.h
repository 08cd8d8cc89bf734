#pragma once
// What camera rays see in a baked room: reflected light from the irradiance atlas, mirrors by
// tracing their reflections or by looking them up in the radiance field; and the objects in it.

#include "vlf/dynamic/changed_charts.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/dynamic/reflection_probe.h"
#include "vlf/field/light_field.h"
#include "vlf/render/cpu/hard_shadows.h"
#include "vlf/render/cpu/lamp_light.h"
#include "vlf/render/cpu/radiance_lookup.h"
#include "vlf/render/cpu/surface.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace vlf {

/// How light that mirrors reflect is found.
///
/// Traced, the light that a rough mirror reflects is an estimate from rays of its lobe and towards
/// lamps where the field has too few directions for it; where the lobe is wide it is looked up, and
/// so are rough mirrors that another one shows. Looked up, no ray is traced through the room
/// for it: a mirror of the room shows the radiance field, multiplied by the change of irradiance at
/// the place seen, and the objects before that place, which reflected rays are traced among; a
/// mirror object shows its reflection probe, and likewise the objects before what the probe shows.
enum class MirrorMethod { traced, lookedUp };

/// The chart of the side a point lies on; kNoChart if that side needs none.
std::uint32_t chartAt(const LightField& field, const SidePoint& point);

/// Refers to scene, rays, field and objects, which must outlive it and not change. Safe to use from
/// several threads.
class FieldShader {
  public:
    static constexpr int kProbeSize = 128;  ///< texels along a face of a mirror object's probe

    /// `objects`: up to date, of this room; null: none. Throws InputError if the field is not of
    /// this scene, or if mirrors are to be looked up in a field that holds no radiance of them:
    /// rough ones always.
    FieldShader(const Scene& scene, const RayScene& rays, const LightField& field,
                MirrorMethod mirrors = MirrorMethod::traced,
                LookupKind lookup = LookupKind::depthCorrected,
                const DynamicRoom* objects = nullptr);

    /// Radiance (W·m⁻²·sr⁻¹) that arrives along each of `rays` from where it points; the
    /// environment's from outside the scene, black from sides without a chart. Of rough mirrors
    /// that are traced an estimate, for which the `perPixel` rays in a row of each pixel share
    /// their samples. Returns the number of rays traced.
    std::uint64_t radiance(std::span<const Ray> rays, std::span<Vec3> radiance,
                           int perPixel = 1) const;

  private:
    struct Path;
    struct Picture;
    struct Queue;
    struct RoomPoint;

    void closestObjects(std::span<const Ray> rays, std::vector<InstanceHit>& hits) const;
    std::optional<RoomPoint> roomPoint(const Path& path, const Ray& ray, const Hit& hit) const;
    void followRoom(const Path& path, const Ray& ray, const Hit& hit, const Picture& picture,
                    Queue& next) const;
    void followObject(const Path& path, const Ray& ray, const InstanceHit& hit,
                      const Picture& picture, Queue& next) const;

    void followLobe(const Path& path, const Ray& ray, const Surface& surface,
                    const Picture& picture, Queue& next) const;

    Vec3 skySeen(const Path& path, const Vec3& direction) const;
    Vec3 emitterSeen(const Path& path, const SidePoint& point, const Ray& ray,
                     const Hit& hit) const;

    bool tracesLobe(const Surface& surface, const Ray& ray) const;
    bool followGlass(const Path& path, const Ray& ray, const Hit& hit, const Picture& picture,
                     Queue& next) const;
    Vec3 lookUpRoom(const Ray& ray, const Hit& hit) const;
    Vec3 lookUpSurface(const Ray& ray, const Hit& hit) const;
    Vec3 lookUpMirror(const RoomPoint& point, const Ray& ray) const;
    Vec3 lookUpGloss(const RoomPoint& point, const Ray& ray) const;
    Vec3 inChangedLight(const SeenInMirror& sight, const Ray& reflected) const;
    Vec3 lookUpObject(const Ray& ray, const InstanceHit& hit, int reflections) const;
    InstanceHit closestObject(const Ray& ray, float before) const;

    void fillProbes();
    const IrradianceAtlas& atlas() const;
    bool looksUp() const { return mirrors_ == MirrorMethod::lookedUp; }

    const Scene& scene_;
    const RayScene& rays_;
    const LightField& field_;
    MirrorMethod mirrors_;
    LookupKind lookup_;
    const DynamicRoom* objects_;
    HardShadows shadows_;
    std::optional<MirrorLookup> lookedUp_;  ///< set where mirrors are looked up
    std::optional<MirrorLookup> gloss_;     ///< set where there are rough mirrors
    std::optional<LampLight> lamps_;        ///< set where these are traced
    std::optional<ChangedCharts> changed_;  ///< set where there are objects and one of these
    std::vector<ReflectionProbe> probes_;   ///< of each lit object; empty where it is no mirror
};

}  // namespace vlf
