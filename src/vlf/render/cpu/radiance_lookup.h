#pragma once
// What a mirror shows, by pure lookup in the radiance field: constant time, no ray is traced.
//
// Plain: the subfields of the three directions around the one to the eye, bilinear in their cells
// (J. Mortensen et al., "Real-time global illumination in the CAVE", VRST 2007). Depth-corrected:
// what is seen at distance d in the mirror lies, as a virtual image, at q = p - ω d behind it; each
// subfield is sampled not at p but where it shows q.

#include "vlf/field/direction_set.h"
#include "vlf/field/light_field.h"

#include <cstdint>
#include <vector>

namespace vlf {

enum class LookupKind { plain, depthCorrected };

/// A point of a mirror chart. `normal` is the unit geometric normal there on the chart's side.
struct MirrorPoint {
    std::uint32_t chart = kNoChart;
    Vec3 position{0};
    Vec3 normal{0};
};

/// Reads the radiance field of a light field, which must outlive it. Safe to use from several
/// threads.
class MirrorLookup {
  public:
    /// Precondition: !field.radiance.empty().
    explicit MirrorLookup(const LightField& field);

    /// Specular radiance (W·m⁻²·sr⁻¹, mirror reflectance included, without the diffuse part) that
    /// leaves `point` in unit direction `toEye`. Zero where the field has nothing of the chart.
    Vec3 mirrorRadiance(const MirrorPoint& point, const Vec3& toEye, LookupKind kind) const;

  private:
    struct View;
    struct Sight;

    View viewOf(std::uint32_t direction, float weight, const MirrorPoint& point,
                const Vec3& toEye) const;
    Vec3 plain(const std::array<View, 3>& views) const;
    Vec3 depthCorrected(const std::array<View, 3>& views) const;

    const RadianceField& radiance_;
    DirectionSet directions_;
    std::vector<ParallelSubfield> subfields_;  ///< of each line; both senses share it
};

}  // namespace vlf
