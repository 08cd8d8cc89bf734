#include "vlf/propagate/fill_atlas.h"

#include "vlf/propagate/behind_walls.h"

namespace vlf {

namespace {

/// Chart-wise dilation: every texel of the chart and its gutter without a value takes the mean of
/// its neighbours that have one, ring by ring.
class Dilation {
  public:
    Dilation(IrradianceAtlas& atlas, std::vector<std::uint8_t>& known)
        : atlas_(atlas), known_(known) {}

    void fill(const Chart& chart) {
        std::vector<std::size_t> missing = unknownTexels(chart);
        while (!missing.empty()) {
            std::vector<std::size_t> left;
            std::vector<std::pair<std::size_t, Vec3>> found;
            for (const std::size_t t : missing) {
                const auto [sum, count] = neighbours(chart, t);
                if (count > 0)
                    found.emplace_back(t, sum / count);
                else
                    left.push_back(t);
            }
            if (found.empty()) return;  // a chart nothing is known of stays black
            for (const auto& [t, value] : found) {
                atlas_.irradiance[t] = value;
                known_[t] = 1;
            }
            missing = std::move(left);
        }
    }

  private:
    std::vector<std::size_t> unknownTexels(const Chart& c) const {
        std::vector<std::size_t> unknown;
        for (std::uint32_t y = c.y - kGutter; y < c.y + c.height + kGutter; ++y)
            for (std::uint32_t x = c.x - kGutter; x < c.x + c.width + kGutter; ++x)
                if (!known_[atlas_.index(x, y)]) unknown.push_back(atlas_.index(x, y));
        return unknown;
    }

    std::pair<Vec3, float> neighbours(const Chart& c, std::size_t texel) const {
        const auto x = static_cast<std::int64_t>(texel % atlas_.width);
        const auto y = static_cast<std::int64_t>(texel / atlas_.width);
        Vec3 sum(0);
        float count = 0;
        for (std::int64_t j = y - 1; j <= y + 1; ++j)
            for (std::int64_t i = x - 1; i <= x + 1; ++i) {
                if (i < c.x - kGutter || j < c.y - kGutter || i >= c.x + c.width + kGutter ||
                    j >= c.y + c.height + kGutter)
                    continue;
                const std::size_t n = static_cast<std::size_t>(j) * atlas_.width + i;
                if (!known_[n]) continue;
                sum += atlas_.irradiance[n];
                count += 1;
            }
        return {sum, count};
    }

    IrradianceAtlas& atlas_;
    std::vector<std::uint8_t>& known_;
};

}  // namespace

IrradianceAtlas fillAtlas(const BakeState& state) {
    const Unwrap& unwrap = state.unwrap;
    IrradianceAtlas atlas{unwrap.atlasWidth, unwrap.atlasHeight,
                          std::vector<Vec3>(unwrap.atlasSize(), Vec3(0))};
    std::vector<std::uint8_t> known(unwrap.atlasSize(), 0);
    const bool swept = state.report.sweeps > 0;  // else all have direct light alone
    for (std::size_t i = 0; i < unwrap.texels.size(); ++i) {
        if (swept && !state.reached[i]) continue;
        atlas.irradiance[unwrap.texels[i]] = state.irradiance[i];
        known[unwrap.texels[i]] = 1;
    }
    continueBehindWalls(state, atlas, known);
    // Twice: the first pass gives every chart a border, which the links then read.
    const auto dilateAll = [&] {
        std::vector<std::uint8_t> reached = known;
        Dilation dilation(atlas, reached);
        for (const Chart& chart : unwrap.charts) dilation.fill(chart);
    };
    dilateAll();
    std::vector<Vec3> linked(unwrap.seams.size());
    for (std::size_t i = 0; i < linked.size(); ++i)
        linked[i] = atlas.sample(unwrap.charts[unwrap.seams[i].chart], unwrap.seams[i].coordinates);
    for (std::size_t i = 0; i < linked.size(); ++i) {
        atlas.irradiance[unwrap.seams[i].texel] = linked[i];
        known[unwrap.seams[i].texel] = 1;
    }
    dilateAll();
    return atlas;
}

}  // namespace vlf
