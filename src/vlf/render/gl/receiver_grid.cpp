#include "vlf/render/gl/receiver_grid.h"

#include <algorithm>

namespace vlf::gl {

namespace {

constexpr int kSide = shared::kGridSide;
constexpr std::uint32_t kFull = 0xff000000u;

}  // namespace

ReceiverGrid::ReceiverGrid(const Bounds& room)
    : lower_(room.lower),
      cell_(glm::max(room.size(), Vec3(1e-6f)) / static_cast<float>(kSide)),
      cells_(static_cast<std::size_t>(kSide) * kSide * kSide) {}

void ReceiverGrid::fill(std::span<const shared::ReceiverData> receivers,
                        std::span<const std::array<Vec3, 8>> places, float tolerance) {
    std::fill(cells_.begin(), cells_.end(), 0u);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        Vec3 lower(places[i][0]), upper(places[i][0]);
        for (const Vec3& corner : places[i])
            lower = glm::min(lower, corner), upper = glm::max(upper, corner);
        const auto cellOf = [&](const Vec3& p) {
            return glm::clamp(glm::ivec3(glm::floor((p - lower_) / cell_)), 0, kSide - 1);
        };
        const glm::ivec3 first = cellOf(lower - tolerance), last = cellOf(upper + tolerance);
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) {
                    std::uint32_t& cell =
                        cells_[static_cast<std::size_t>((z * kSide + y) * kSide + x)];
                    if (cell & kFull ||
                        !meets(receivers[i], lower_ + (Vec3(x, y, z) + 0.5f) * cell_, tolerance))
                        continue;
                    int byte = 0;
                    while (cell >> (8 * byte) & 0xff) ++byte;
                    cell |= static_cast<std::uint32_t>(i + 1) << (8 * byte);
                }
    }
}

/// Whether the receiver may come into the cell.
bool ReceiverGrid::meets(const shared::ReceiverData& r, const Vec3& middle, float tolerance) const {
    const auto reach = [&](const Vec3& axis) {
        return 0.5f * glm::dot(glm::abs(axis), cell_) + tolerance * glm::length(axis);
    };
    const Vec3 u(r.uAxis), v(r.vAxis), n(r.normal);
    const Vec3 at(glm::dot(u, middle) + r.uAxis.w, glm::dot(v, middle) + r.vAxis.w,
                  glm::dot(n, middle));
    const Vec3 margin(reach(u), reach(v), reach(n));
    const Vec3 lower(r.range.x, r.range.y, r.normal.w), upper(r.range.z, r.range.w, r.place.z);
    return glm::all(glm::lessThanEqual(lower - margin, at)) &&
           glm::all(glm::lessThanEqual(at, upper + margin));
}

}  // namespace vlf::gl
