#pragma once
// A flat surface of the room that a ray soon meets, as it is met by parallels to that ray.

#include "vlf/dynamic/room_texels.h"
#include "vlf/field/chart.h"
#include "vlf/math/pose.h"
#include "vlf/trace/ray_scene.h"

#include <cstdint>
#include <optional>

namespace vlf {

class NearPlace {
  public:
    /// Where `ray`, which starts on a body in `pose`, meets a covered texel at a distance; nothing
    /// if its chart is not flat.
    static std::optional<NearPlace> of(const Ray& ray, float distance, std::uint32_t texel,
                                       const Pose& pose, const RoomTexels& room);

    /// The texel that the parallel through another point of the body meets, `offset` in the body's
    /// space from where the ray starts; kNoTexel if the chart covers none there.
    std::uint32_t texelFrom(const Vec3& offset, const RoomTexels& room) const;

  private:
    NearPlace(const Chart& chart, const Ray& ray, const Vec3& place, const Pose& pose);

    const Chart* chart_;
    Vec2 at_;               ///< texel coordinates of the ray's own place
    Vec3 alongU_, alongV_;  ///< their change with the offset
};

}  // namespace vlf
