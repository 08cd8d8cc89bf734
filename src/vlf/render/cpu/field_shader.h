#pragma once
// What camera rays see in a baked room: reflected light from the irradiance atlas, mirrors by
// tracing their reflections or by looking them up in the radiance field.

#include "vlf/field/light_field.h"
#include "vlf/render/cpu/radiance_lookup.h"
#include "vlf/render/cpu/surface.h"

#include <cstdint>
#include <optional>
#include <span>

namespace vlf {

/// How light that mirrors reflect is found.
enum class MirrorMethod { traced, lookedUp };

/// The chart of the side a point lies on; kNoChart if that side needs none.
std::uint32_t chartAt(const LightField& field, const SidePoint& point);

/// Refers to scene, rays and field, which must outlive it. Safe to use from several threads.
class FieldShader {
  public:
    /// Throws InputError if the field is not of this scene, or if mirrors are to be looked up in a
    /// field that holds no radiance of them.
    FieldShader(const Scene& scene, const RayScene& rays, const LightField& field,
                MirrorMethod mirrors = MirrorMethod::traced,
                LookupKind lookup = LookupKind::depthCorrected);

    /// Radiance (W·m⁻²·sr⁻¹) that arrives along each of `rays` from where it points; black from
    /// outside the scene and from sides without a chart. Returns the number of rays traced.
    std::uint64_t radiance(std::span<const Ray> rays, std::span<Vec3> radiance) const;

  private:
    struct Path;
    struct Queue;

    void follow(const Path& path, const Ray& ray, const Hit& hit, std::span<Vec3> radiance,
                Queue& next) const;
    Vec3 ownRadiance(const Surface& surface, const Chart& chart) const;

    const Scene& scene_;
    const RayScene& rays_;
    const LightField& field_;
    LookupKind lookup_;
    std::optional<MirrorLookup> lookedUp_;  ///< set where mirrors are looked up
};

}  // namespace vlf
