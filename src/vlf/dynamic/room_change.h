#pragma once
// How objects change the irradiance of a room's texels.

#include "vlf/dynamic/room_texels.h"
#include "vlf/field/irradiance_atlas.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace vlf {

/// Of single texels, of all texels of a block or group (RoomTexels), and of all there are, hidden
/// ones left out.
/// Irradiance in W·m⁻².
class RoomChange {
  public:
    explicit RoomChange(const RoomTexels& room);

    /// Nothing has changed.
    void clear();

    /// `texel` is covered.
    void add(std::uint32_t texel, const Vec3& irradiance) {
        change_[texel] += irradiance;
        if (touched_[texel]) return;
        touched_[texel] = 1;
        groupTouched_[room_.groupOf[texel]] = 1;
        texels_.push_back(texel);
    }
    void addToBlock(std::uint32_t block, const Vec3& irradiance) {
        blocks_[block] += irradiance;
        everywhere_ = true;
    }
    void addToGroup(std::uint32_t group, const Vec3& irradiance) {
        groups_[group] += irradiance;
        everywhere_ = true;
    }
    void addToAll(const Vec3& irradiance) {
        all_ += irradiance;
        everywhere_ = true;
    }

    /// All texels that may have changed, and how much, by atlas texel; even over blocks and groups.
    std::span<const std::uint32_t> texels() const {
        return everywhere_ ? std::span<const std::uint32_t>(room_.unwrap.texels) : texels_;
    }
    Vec3 of(std::uint32_t texel) const { return change_[texel] + ofBlock(room_.blockOf[texel]); }

    /// Of all texels of a block alike, and whether single ones of a group have more than that.
    Vec3 ofBlock(std::uint32_t block) const { return blocks_[block] + groups_[block / 4] + all_; }
    bool variesIn(std::uint32_t group) const { return groupTouched_[group] != 0; }

    /// The radiance that the texels reflect with the change, by atlas texel. Here and below the
    /// change of blocks and groups is interpolated between them.
    void findRadiance(const IrradianceAtlas& own, std::vector<Vec3>& radiance);

    /// `own` with the change; texels that no surface covers change with the covered ones that they
    /// continue. Light does not become negative. `light` must be what the call before wrote, or
    /// `own`.
    void apply(const IrradianceAtlas& own, IrradianceAtlas& light);

  private:
    struct EvenChange;

    bool empty() const { return texels_.empty() && !everywhere_; }
    void findCorners();
    std::array<EvenChange, 4> evenChangeIn(std::uint32_t group) const;
    template <class Write>
    void forTexels(const IrradianceAtlas& own, Write write) const;
    template <class Write>
    void forRows(const IrradianceAtlas& own, const TexelGroup& group,
                 const std::array<EvenChange, 4>& even, Write write) const;

    const RoomTexels& room_;
    std::vector<Vec3> change_;
    std::vector<std::uint8_t> touched_, groupTouched_;
    std::vector<std::uint32_t> texels_;
    std::vector<Vec3> blocks_, groups_;
    std::vector<Vec3> blockCorners_, groupCorners_;  ///< by corner of the lattices
    Vec3 all_{0};
    bool everywhere_ = false;
    bool written_ = false;  ///< the last call of apply changed something
    std::vector<std::pair<std::uint32_t, std::uint32_t>> followers_;  ///< and what they follow
};

}  // namespace vlf
