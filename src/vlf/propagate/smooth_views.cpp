#include "vlf/propagate/smooth_views.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vlf {

namespace {

constexpr float kSmoothing = 0.4f;  // radius of the mean, of the width of the lobe
constexpr int kMaxReach = 8;        // cells

/// Which cell lies where.
class CellMap {
  public:
    /// Precondition: there are cells.
    explicit CellMap(std::span<const MirrorCell> cells) {
        first_ = last_ = {cells.front().x, cells.front().y};
        for (const MirrorCell& c : cells) {
            first_ = glm::min(first_, glm::ivec2(c.x, c.y));
            last_ = glm::max(last_, glm::ivec2(c.x, c.y));
        }
        const glm::ivec2 size = last_ - first_ + 1;
        at_.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), -1);
        for (std::size_t i = 0; i < cells.size(); ++i)
            at_[place(cells[i].x, cells[i].y)] = static_cast<std::int32_t>(i);
    }

    /// Calls visit(index, offset) for all cells up to `reach` from this one in x and in y.
    template <class Visit>
    void around(const MirrorCell& cell, int reach, const Visit& visit) const {
        const glm::ivec2 middle(cell.x, cell.y);
        const glm::ivec2 low = glm::max(middle - reach, first_);
        const glm::ivec2 high = glm::min(middle + reach, last_);
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x)
                if (const std::int32_t i = at_[place(x, y)]; i >= 0)
                    visit(static_cast<std::size_t>(i), Vec2(x - cell.x, y - cell.y));
    }

  private:
    std::size_t place(int x, int y) const {
        return static_cast<std::size_t>(y - first_.y) *
                   static_cast<std::size_t>(last_.x - first_.x + 1) +
               static_cast<std::size_t>(x - first_.x);
    }

    glm::ivec2 first_{0}, last_{0};
    std::vector<std::int32_t> at_;
};

}  // namespace

void smoothViews(std::vector<MirrorView>& views, std::span<const MirrorCell> cells,
                 std::span<const ViewPoint> points, float roughness, float cellSize) {
    if (cells.empty()) return;
    const CellMap map(cells);
    const std::vector<MirrorView> noisy = views;
    const float turn = kSmoothing * roughness;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const float radius = turn * noisy[i].distance / cellSize;
        const int reach = std::min(kMaxReach, static_cast<int>(2 * radius));
        if (reach == 0) continue;
        Vec3 radiance(0);
        float weights = 0, nearness = 0;
        map.around(cells[i], reach, [&](std::size_t j, const Vec2& offset) {
            if (noisy[j].distance <= 0) return;
            const Vec2 away = offset / radius;
            const Vec3 turned = (points[j].normal - points[i].normal) / turn;
            const float w = std::exp(-0.5f * (glm::dot(away, away) + glm::dot(turned, turned)));
            radiance += w * noisy[j].radiance;
            nearness += w / noisy[j].distance;
            weights += w;
        });
        views[i] = {radiance / weights, weights / nearness};
    }
}

}  // namespace vlf
