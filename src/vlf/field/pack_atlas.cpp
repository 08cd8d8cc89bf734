#include "vlf/field/pack_atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vlf {

AtlasSize packCharts(std::vector<Chart>& charts) {
    std::vector<std::uint32_t> order(charts.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return charts[a].height > charts[b].height;
    });
    double area = 0;
    std::uint32_t widest = 1;
    for (const Chart& c : charts) {
        area += static_cast<double>(c.width + 2 * kGutter) * (c.height + 2 * kGutter);
        widest = std::max(widest, c.width + 2 * kGutter);
    }
    AtlasSize size{std::max(widest, static_cast<std::uint32_t>(std::ceil(std::sqrt(1.05 * area)))),
                   0};
    std::uint32_t x = 0, shelf = 0;
    for (const std::uint32_t i : order) {
        Chart& c = charts[i];
        if (x + c.width + 2 * kGutter > size.width) {
            x = 0;
            shelf = size.height;
        }
        c.x = x + kGutter;
        c.y = shelf + kGutter;
        x += c.width + 2 * kGutter;
        size.height = std::max(size.height, shelf + c.height + 2 * kGutter);
    }
    return size;
}

}  // namespace vlf
