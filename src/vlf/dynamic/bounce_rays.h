#pragma once
// Where the light that texels reflect comes to: a few rays from each group of texels, always the
// same, so that what arrives changes as evenly as what is sent.

#include "vlf/dynamic/room_texels.h"
#include "vlf/trace/ray_scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

class BounceRays {
  public:
    /// What light that arrives is dealt to: the farther it comes from the more texels, or single
    /// ones would flicker.
    enum class Unit : std::uint16_t { texel, block, group };
    /// Where a ray, or a part of it, comes to.
    struct Arrival {
        std::uint32_t texel = 0;  ///< not hidden
        Unit unit = Unit::texel;
        std::uint16_t reach = 0;  ///< of a texel: so far those about it share what it gets
        Vec3 throughput{1};       ///< of the mirrors on the way
    };
    struct Launch {
        std::uint32_t texel = 0;  ///< covered; each of a group comes up as often as any other
        std::uint32_t first = 0;  ///< of its arrivals
    };

    /// None.
    BounceRays() = default;

    /// 256 a group, fewer in rooms of very many.
    BounceRays(const Scene& scene, const RayScene& rays, const RoomTexels& room);

    bool empty() const { return perGroup_ == 0; }

    /// A power of two, at least 32.
    int perGroup() const { return perGroup_; }

    /// Those of a group, cosine-distributed; the first 2ⁿ of them are as well spread as any.
    std::span<const Launch> of(std::uint32_t group) const {
        return {launches_.data() + std::size_t{group} * perGroup_,
                static_cast<std::size_t>(perGroup_)};
    }
    std::span<const Arrival> arrivals(const Launch& launch) const {
        return {arrivals_.data() + launch.first, arrivals_.data() + (&launch)[1].first};
    }

  private:
    int perGroup_ = 0;
    std::vector<Launch> launches_;  ///< and one more, for its `first`
    std::vector<Arrival> arrivals_;
};

}  // namespace vlf
