#include "vlf/render/gl/atlas_fit.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/field/pack_atlas.h"

#include <algorithm>
#include <string>

namespace vlf {

namespace {

std::vector<Chart> shrunk(std::vector<Chart> charts, std::uint32_t factor) {
    const auto f = static_cast<float>(factor);
    for (Chart& c : charts) {
        c.uAxis /= f;
        c.vAxis /= f;
        c.uOffset /= f;
        c.vOffset /= f;
        c.width = (c.width + factor - 1) / factor;
        c.height = (c.height + factor - 1) / factor;
    }
    return charts;
}

/// The mean of the texels of `chart` that texel (x, y) of the shrunk chart stands for; gutters are
/// the chart's own or, of a shrunk one, repeat its edge.
Vec3 meanOf(const IrradianceAtlas& atlas, const Chart& chart, int x, int y, int factor) {
    if (factor == 1)
        return atlas.at(chart.x + static_cast<std::uint32_t>(x),
                        chart.y + static_cast<std::uint32_t>(y));
    const auto part = [&](int i, std::uint32_t size) {
        const int texels = static_cast<int>(size), most = (texels - 1) / factor;
        const int first = std::clamp(i, 0, most) * factor;
        return std::pair(first, std::min(first + factor, texels));
    };
    const auto [firstX, endX] = part(x, chart.width);
    const auto [firstY, endY] = part(y, chart.height);
    Vec3 sum(0);
    for (int j = firstY; j < endY; ++j)
        for (int i = firstX; i < endX; ++i)
            sum += atlas.at(chart.x + static_cast<std::uint32_t>(i),
                            chart.y + static_cast<std::uint32_t>(j));
    return sum / static_cast<float>((endX - firstX) * (endY - firstY));
}

}  // namespace

AtlasFit::AtlasFit(const LightField& field, std::uint32_t maxSide)
    : original_(field.charts),
      triangleCharts_(field.triangleCharts),
      width_(field.atlas.width),
      height_(field.atlas.height) {
    std::uint32_t longest = 1;
    for (const Chart& c : original_) longest = std::max({longest, c.width, c.height});
    for (; std::max(width_, height_) > maxSide; ++factor_) {
        if (factor_ > longest)
            throw InputError("the room has " + std::to_string(original_.size()) +
                             " charts of light, too many for a texture of " +
                             std::to_string(maxSide) +
                             " texels along a side; render with --backend cpu");
        charts_ = shrunk(original_, factor_);
        const AtlasSize size = packCharts(charts_);
        width_ = size.width;
        height_ = size.height;
        if (std::max(width_, height_) <= maxSide) break;
    }
}

LightField AtlasFit::layout() const {
    LightField field;
    field.charts = unchanged() ? original_ : charts_;
    field.triangleCharts = triangleCharts_;
    field.atlas.width = width_;
    field.atlas.height = height_;
    return field;
}

IrradianceAtlas AtlasFit::fit(const IrradianceAtlas& atlas) const {
    IrradianceAtlas fitted{width_, height_, {}};
    fitted.irradiance.resize(std::size_t{width_} * height_, Vec3(0));
    constexpr int g = kGutter;
    parallelFor(charts_.size(), [&](std::size_t c) {
        const Chart& chart = charts_[c];
        for (int y = -g; y < static_cast<int>(chart.height) + g; ++y)
            for (int x = -g; x < static_cast<int>(chart.width) + g; ++x)
                fitted.irradiance[fitted.index(chart.x + static_cast<std::uint32_t>(x),
                                               chart.y + static_cast<std::uint32_t>(y))] =
                    meanOf(atlas, original_[c], x, y, static_cast<int>(factor_));
    });
    return fitted;
}

}  // namespace vlf
