#pragma once
// From the atlas back to the list of texels.

#include "vlf/unwrap/unwrap.h"

#include <cstdint>
#include <vector>

namespace vlf {

/// Finds texels beside one another. The unwrap must outlive it.
class TexelNeighbours {
  public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    explicit TexelNeighbours(const Unwrap& unwrap)
        : unwrap_(unwrap), entryOf_(unwrap.atlasSize(), kNone) {
        for (std::size_t i = 0; i < unwrap.texels.size(); ++i)
            entryOf_[unwrap.texels[i]] = static_cast<std::uint32_t>(i);
    }

    /// Entry of unwrap.texels dx columns and dy rows from entry i, each at most one, if it is of
    /// the same chart; else kNone. The gutter keeps all neighbours within the atlas.
    std::uint32_t beside(std::size_t i, int dx, int dy) const {
        const auto texel = static_cast<std::int64_t>(unwrap_.texels[i]);
        const auto pitch = static_cast<std::int64_t>(unwrap_.atlasWidth);
        const std::uint32_t n = entryOf_[static_cast<std::size_t>(texel + dy * pitch + dx)];
        return n != kNone && unwrap_.texelChart[n] == unwrap_.texelChart[i] ? n : kNone;
    }

  private:
    const Unwrap& unwrap_;
    std::vector<std::uint32_t> entryOf_;
};

}  // namespace vlf
