#pragma once
// Delta transport: how an object changes the indirect light of the room.
//
// Along every line that crosses the object, two surfaces of the room that saw each other see the
// object instead: the exchange between them is taken out of the room's solution and the object's
// two exchanges are put in. Of the flux that a line stands for, A · dω · L, a texel gets the share
// of its area. That is soft shadow of indirect light and colour bleeding in one step. Direct light
// is taken out apart (soft_shadow.h), and what has changed bounces on (change_bounce.h).

#include "vlf/dynamic/coverage.h"
#include "vlf/dynamic/lit_room.h"
#include "vlf/dynamic/object_lines.h"
#include "vlf/dynamic/room_change.h"
#include "vlf/dynamic/sight.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// The lines of one object in one pose, and the texels at their ends.
class DeltaLines {
  public:
    /// Follows the lines into the room. What the object covers of it is left as it is. Objects
    /// other than `objects.own` that stand between it and a texel keep the texel to themselves. Of
    /// the emitters a mirror of the object shows nothing: caustics are left out.
    void trace(const ObjectLines& lines, const ObjectMesh& mesh, const Pose& pose,
               const LitRoom& room, const SightObjects& objects, const Coverage& coverage);

    /// Adds the change of irradiance to `change`. `ownRadiance`: diffuse radiance leaving each
    /// receiver of the object.
    void addTo(RoomChange& change, std::span<const Vec3> ownRadiance) const;

  private:
    /// What a line's light is dealt to: the farther from the object the more texels, so that single
    /// ones do not flicker as lines pass over them.
    enum class Unit : std::uint32_t { texel, block, group };

    /// A piece of the room that sees the object along a line.
    struct End {
        Unit unit;
        std::uint32_t number;  ///< of the texel, block or group
        std::uint32_t receiver;
        Vec3 lost;  ///< radiance seen before, less what a mirror of the object shows now
        Vec3 gain;  ///< irradiance per radiance, by the mirrors on the way
    };
    class Block;

    std::vector<std::vector<End>> blocks_;
};

}  // namespace vlf
