#pragma once
// What a mirror shows, by pure lookup in the radiance field: constant time, no ray is traced.
//
// Plain: the subfields of the three directions around the one to the eye, bilinear in their cells
// (J. Mortensen et al., "Real-time global illumination in the CAVE", VRST 2007). Depth-corrected:
// what is seen at distance d in the mirror lies, as a virtual image, at q = p - ω d behind it; each
// subfield is sampled not at p but where it shows q. A subfield is then a height field of virtual
// points, and the line of sight is followed to where it meets it. What a rough mirror shows has no
// edges: there one mean depth corrects all samples.

#include "vlf/field/direction_set.h"
#include "vlf/field/light_field.h"
#include "vlf/scene/scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

enum class LookupKind { plain, depthCorrected };

/// A point of a mirror chart. `normal` is the unit geometric normal there on the chart's side.
struct MirrorPoint {
    std::uint32_t chart = kNoChart;
    Vec3 position{0};
    Vec3 normal{0};
};

/// What a mirror shows at a point.
struct SeenInMirror {
    Vec3 radiance{0};    ///< W·m⁻²·sr⁻¹, mirror reflectance included, without the diffuse part
    float distance = 0;  ///< metres from the mirror along the reflected ray; 0: not known
};

/// Reads a radiance field, which must outlive it. Safe to use from several threads.
class MirrorLookup {
  public:
    /// Precondition: !radiance.empty(). `frame`: of its light field; `kind`: of the mirrors in it.
    MirrorLookup(const FieldFrame& frame, const RadianceField& radiance,
                 MirrorKind kind = MirrorKind::perfect);

    /// What is seen at `point` from where unit direction `toEye` leads. Black where the field has
    /// nothing of the chart.
    SeenInMirror see(const MirrorPoint& point, const Vec3& toEye, LookupKind kind) const;

    Vec3 mirrorRadiance(const MirrorPoint& point, const Vec3& toEye, LookupKind kind) const {
        return see(point, toEye, kind).radiance;
    }

  private:
    class View;
    using Views = std::array<View, 3>;
    struct Layer;

    View viewOf(std::uint32_t direction, float weight, const MirrorPoint& point,
                const Vec3& toEye) const;
    SeenInMirror linear(const Views& views, float s) const;
    SeenInMirror depthCorrected(const Views& views) const;
    SeenInMirror meanDepthCorrected(const Views& views) const;
    Layer layerAt(const Views& views, float s) const;

    const RadianceField& radiance_;
    MirrorKind kind_;
    DirectionSet directions_;
    std::vector<ParallelSubfield> subfields_;  ///< of each line; both senses share it
    float tolerance_;                          ///< metres between points of one surface
};

}  // namespace vlf
