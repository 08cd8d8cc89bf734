#pragma once
// Delta transport: how an object changes the indirect light of the room.
//
// Along every line that crosses the object, two surfaces of the room that saw each other see the
// object instead: the exchange between them is taken out of the room's solution and the object's
// two exchanges are put in. Of the flux that a line stands for, A · dω · L, a texel gets the share
// of its area. That is soft shadow of indirect light and colour bleeding in one step. Direct light
// is taken out apart (soft_shadow.h); light changed by the object that bounces once more is left
// out, but for what comes back to the object.

#include "vlf/dynamic/coverage.h"
#include "vlf/dynamic/object_lines.h"
#include "vlf/dynamic/sight.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// The lines of one object in one pose, and the texels at their ends.
class DeltaLines {
  public:
    /// Follows the lines into the room. `texelRadiance`: of the room without objects.
    /// What the object lies on is left as it is. Objects other than `objects.own` that stand
    /// between it and a texel keep the texel to themselves.
    void trace(const ObjectLines& lines, const Pose& pose, const Scene& scene, const RayScene& rays,
               const RoomTexels& room, const SightObjects& objects, const Coverage& coverage,
               std::span<const Vec3> texelRadiance);

    /// Adds the change of irradiance (W·m⁻²) to `change`, by atlas texel; the texels it changes for
    /// the first time, by `touched`, are appended to `texels`. `ownRadiance`: diffuse radiance
    /// leaving each receiver.
    void addTo(std::span<Vec3> change, std::span<std::uint8_t> touched,
               std::vector<std::uint32_t>& texels, std::span<const Vec3> ownRadiance) const;

    std::size_t bytes() const;

  private:
    /// A texel that sees the object along a line, where it saw `lost`.
    struct End {
        std::uint32_t texel;
        std::uint32_t receiver;
        Vec3 lost;  ///< radiance
        Vec3 gain;  ///< irradiance per radiance, by the mirrors on the way
    };
    std::vector<std::vector<End>> blocks_;
};

}  // namespace vlf
