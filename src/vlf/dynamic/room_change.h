#pragma once
// How objects change the irradiance of a room's texels.

#include "vlf/dynamic/room_texels.h"
#include "vlf/field/irradiance_atlas.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

class RoomChange {
  public:
    explicit RoomChange(const RoomTexels& room);

    /// Nothing has changed.
    void clear();

    void add(std::uint32_t texel, const Vec3& irradiance) {
        change_[texel] += irradiance;
        if (touched_[texel]) return;
        touched_[texel] = 1;
        texels_.push_back(texel);
    }

    /// The texels that were added to, and by atlas texel how much.
    std::span<const std::uint32_t> texels() const { return texels_; }
    const Vec3& of(std::uint32_t texel) const { return change_[texel]; }

    /// Writes irradiance with the change into `light`, texels that no surface covers along with the
    /// covered ones they continue, and the radiance it makes the texels send. What was written
    /// before and is not changed any more becomes the room's own again. Light does not become
    /// negative.
    void apply(const RoomTexels& room, const IrradianceAtlas& own, IrradianceAtlas& light,
               std::vector<Vec3>& radiance);

  private:
    void set(const RoomTexels& room, std::uint32_t texel, const Vec3& change,
             const IrradianceAtlas& own, IrradianceAtlas& light, std::vector<Vec3>& radiance) const;

    std::vector<Vec3> change_;
    std::vector<std::uint8_t> touched_;
    std::vector<std::uint32_t> texels_, written_;
    std::vector<std::uint32_t> firstFollower_, followers_;  ///< by covered texel
};

}  // namespace vlf
