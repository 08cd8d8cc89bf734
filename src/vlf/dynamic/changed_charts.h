#pragma once
// Where objects have changed the light of a room, for mirrors that look up what they show: the
// radiance field knows nothing of objects, so that what it says is multiplied by the change of
// irradiance at the place that is seen.

#include "vlf/field/light_field.h"
#include "vlf/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// A chart of the room whose irradiance is another one with the objects. A point p of the world
/// lies on it if lower <= dot(Chart::normal, p) <= upper, with some tolerance, and its texel
/// coordinates lie in [first, last].
struct ChangedChart {
    std::uint32_t chart = kNoChart;
    bool planar = false;         ///< then lower == upper
    float lower = 0, upper = 0;  ///< metres
    Vec2 first{0}, last{0};      ///< texel coordinates around all texels that have changed
    float change = 0;            ///< sum over these of the change of luminance of irradiance
};

/// The charts with the greatest changes. Charts of lamps and of surfaces that only mirror are left
/// out: what is seen there does not follow irradiance.
class ChangedCharts {
  public:
    static constexpr std::size_t kMaxCharts = 32;
    static constexpr float kNoticeable = 0.01f;  ///< change of a texel, relative
    static constexpr float kMaxFactor = 16;

    /// The field must outlive it. Precondition: the field is of the scene.
    ChangedCharts(const Scene& scene, const LightField& field);

    /// Compares the room's irradiance with the objects in it and without.
    void update(const IrradianceAtlas& with, const IrradianceAtlas& without);

    /// At most kMaxCharts, the most changed first.
    std::span<const ChangedChart> charts() const { return changed_; }

    /// Metres between a surface and a place on it as the radiance field tells it: three cells.
    float tolerance() const { return tolerance_; }

    /// By how much irradiance has changed, in [0, kMaxFactor]; 1 where there was none.
    static Vec3 factorOf(const Vec3& with, const Vec3& without);

    /// The factor of radiance, in [0, kMaxFactor], that a ray of unit direction sees `distance`
    /// metres from its origin. 1 where nothing has changed. The atlases are those of update().
    Vec3 factor(const Vec3& origin, const Vec3& direction, float distance,
                const IrradianceAtlas& with, const IrradianceAtlas& without) const;

  private:
    struct Place {
        const Chart* chart = nullptr;
        Vec2 texel{0};
    };
    Place find(const Vec3& origin, const Vec3& direction, float distance) const;

    const LightField& field_;
    std::vector<ChangedChart> all_;      ///< of every chart, what does not change
    std::vector<std::uint8_t> follows_;  ///< whether what is seen of a chart follows irradiance
    std::vector<ChangedChart> changed_;
    float tolerance_ = 0;
};

}  // namespace vlf
