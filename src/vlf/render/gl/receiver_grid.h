#pragma once
// Which receivers of changed light may lie at a place: a coarse grid over the room, so that a
// shader looks at one or two of them.

#include "vlf/math/bounds.h"
#include "vlf/render/gl/shaders/shared.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vlf::gl {

class ReceiverGrid {
  public:
    explicit ReceiverGrid(const Bounds& room);

    /// `places` are eight corners around each of the receivers, the most changed first; they reach
    /// `tolerance` metres farther.
    void fill(std::span<const shared::ReceiverData> receivers,
              std::span<const std::array<Vec3, 8>> places, float tolerance);

    /// Of each cell, x first, then y: the numbers of up to four receivers, plus one, from the
    /// lowest byte on; 0: no more.
    const std::vector<std::uint32_t>& cells() const { return cells_; }

    /// Lower corner; cells a metre.
    Vec4 origin() const { return Vec4(lower_, 0); }
    Vec4 scale() const { return Vec4(1.0f / cell_, 0); }

  private:
    bool meets(const shared::ReceiverData& receiver, const Vec3& middle, float tolerance) const;

    Vec3 lower_, cell_;
    std::vector<std::uint32_t> cells_;
};

}  // namespace vlf::gl
