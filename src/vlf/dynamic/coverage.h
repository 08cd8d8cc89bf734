#pragma once
// The room's surface that objects lie on or that is within them: it is seen by nobody, and takes no
// part in light transport, as in a bake with the objects as parts of the room.

#include "vlf/dynamic/lit_object.h"
#include "vlf/dynamic/room_texels.h"
#include "vlf/field/irradiance_atlas.h"
#include "vlf/propagate/light_gatherer.h"
#include "vlf/trace/ray_instances.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

class Coverage {
  public:
    explicit Coverage(const RoomTexels& room);

    /// `rays` are those of the lit objects, `objects` spheres around them.
    void find(const Scene& scene, const RayScene& roomRays, const RoomTexels& room,
              const RayInstances& rays, std::span<const LitObject> lit,
              std::span<const Sphere> objects);

    /// Of a texel's area, by atlas texel, in [0, 1].
    float uncovered(std::uint32_t texel) const { return uncovered_[texel]; }

    /// The points of entry i of unwrap.texels that are not covered.
    std::span<const SurfacePoint> points(const RoomTexels& room, std::size_t i) const;

    /// Texels that are covered whole take irradiance from neighbours in their chart that are not,
    /// so that nothing of what they had shows at the edge of an object.
    void fill(const RoomTexels& room, IrradianceAtlas& light) const;

    /// Gives the texels that are covered, even in part, what they have in `own`.
    void restore(const RoomTexels& room, const IrradianceAtlas& own, IrradianceAtlas& light) const;

    /// Entries of which less than all is uncovered, in ascending order.
    std::span<const std::uint32_t> entries() const { return entries_; }

  private:
    std::vector<float> uncovered_;
    std::vector<std::uint32_t> entries_;
    std::vector<std::uint32_t> near_;   ///< entries that may be
    std::vector<std::uint32_t> first_;  ///< of entries_[k] in points_
    std::vector<SurfacePoint> points_;
};

}  // namespace vlf
