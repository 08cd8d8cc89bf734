#include "vlf/dynamic/spread_texels.h"

#include <utility>

namespace vlf {

void spreadOverChart(const Chart& chart, std::uint32_t atlasWidth, std::uint32_t none,
                     std::vector<std::uint32_t>& map) {
    std::vector<std::uint32_t> front;
    const auto forEach = [&](auto visit) {
        for (std::uint32_t y = chart.y - kGutter; y < chart.y + chart.height + kGutter; ++y)
            for (std::uint32_t x = chart.x - kGutter; x < chart.x + chart.width + kGutter; ++x)
                visit(x, y);
    };
    forEach([&](std::uint32_t x, std::uint32_t y) {
        if (map[y * atlasWidth + x] != none) front.push_back(y * atlasWidth + x);
    });
    while (!front.empty()) {
        std::vector<std::uint32_t> next;
        for (const std::uint32_t t : front)
            for (const auto& [dx, dy] :
                 {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)}) {
                const std::uint32_t x = t % atlasWidth + dx, y = t / atlasWidth + dy;
                if (x < chart.x - kGutter || y < chart.y - kGutter ||
                    x >= chart.x + chart.width + kGutter || y >= chart.y + chart.height + kGutter)
                    continue;
                std::uint32_t& found = map[y * atlasWidth + x];
                if (found != none) continue;
                found = map[t];
                next.push_back(y * atlasWidth + x);
            }
        front = std::move(next);
    }
}

}  // namespace vlf
