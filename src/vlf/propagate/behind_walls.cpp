#include "vlf/propagate/behind_walls.h"

#include "vlf/base/parallel.h"
#include "vlf/unwrap/wall_between.h"

#include <algorithm>
#include <utility>

namespace vlf {

namespace {

constexpr float kDark = 1e-2f;  // to its neighbours; a few rays slip through where edges meet

class WallSides {
  public:
    WallSides(const BakeState& state, const IrradianceAtlas& atlas,
              const std::vector<std::uint8_t>& known)
        : state_(state), atlas_(atlas), known_(known) {}

    /// The mean of the texel's neighbours that are not dark to the brightest.
    std::pair<Vec3, float> lightAround(const ChartTexel& texel) const {
        float brightest = 0;
        forNeighbours(texel, [&](std::uint32_t n) {
            brightest = std::max(brightest, maxComponent(atlas_.irradiance[n]));
        });
        Vec3 sum(0);
        float count = 0;
        forNeighbours(texel, [&](std::uint32_t n) {
            if (maxComponent(atlas_.irradiance[n]) <= kDark * brightest) return;
            sum += atlas_.irradiance[n];
            count += 1;
        });
        return {sum, count};
    }

    /// The mean of those to which the texel, at whose surface is `anchor`, is dark and from which a
    /// wall parts it.
    std::pair<Vec3, float> lightBeyondWall(const ChartTexel& texel, const Vec3& anchor) const {
        const Chart& chart = state_.unwrap.charts[texel.chart];
        const float own = maxComponent(atlas_.irradiance[texel.texel]);
        const Vec3 centre = chart.pointAt(centreOf(chart, texel.texel), anchor);
        Vec3 sum(0);
        float count = 0;
        forNeighbours(texel, [&](std::uint32_t n) {
            const Vec3& light = atlas_.irradiance[n];
            if (maxComponent(light) <= 0 || own > kDark * maxComponent(light)) return;
            const Vec3 other = chart.pointAt(centreOf(chart, n), anchor);
            if (!wallBetween(state_.rays, chart, centre, other)) return;
            sum += light;
            count += 1;
        });
        return {sum, count};
    }

  private:
    Vec2 centreOf(const Chart& chart, std::uint32_t texel) const {
        return {static_cast<float>(texel % atlas_.width - chart.x) + 0.5f,
                static_cast<float>(texel / atlas_.width - chart.y) + 0.5f};
    }

    /// Those with a value, in the texel's chart.
    template <class Visit>
    void forNeighbours(const ChartTexel& texel, Visit visit) const {
        const Chart& c = state_.unwrap.charts[texel.chart];
        const std::uint32_t x = texel.texel % atlas_.width, y = texel.texel / atlas_.width;
        for (std::uint32_t j = std::max(y - 1, c.y); j <= std::min(y + 1, c.y + c.height - 1); ++j)
            for (std::uint32_t i = std::max(x - 1, c.x); i <= std::min(x + 1, c.x + c.width - 1);
                 ++i)
                if (const auto n = static_cast<std::uint32_t>(atlas_.index(i, j));
                    n != texel.texel && known_[n])
                    visit(n);
    }

    const BakeState& state_;
    const IrradianceAtlas& atlas_;
    const std::vector<std::uint8_t>& known_;
};

/// What texel i of `count` is given: the mean of `lightOf(i)`, a sum and a number.
template <class LightOf>
std::vector<std::pair<Vec3, float>> lightOfAll(std::size_t count, LightOf lightOf) {
    std::vector<std::pair<Vec3, float>> light(count);
    parallelFor(count, 1024, [&](std::size_t i) { light[i] = lightOf(i); });
    return light;
}

}  // namespace

void continueBehindWalls(const BakeState& state, IrradianceAtlas& atlas,
                         std::vector<std::uint8_t>& known) {
    const Unwrap& u = state.unwrap;
    const WallSides sides(state, atlas, known);
    const auto give = [&](std::uint32_t texel, const std::pair<Vec3, float>& light) {
        if (light.second <= 0) return;
        atlas.irradiance[texel] = light.first / light.second;
        known[texel] = 1;
    };
    const auto divided = lightOfAll(u.divided.size(),
                                    [&](std::size_t i) { return sides.lightAround(u.divided[i]); });
    for (std::size_t i = 0; i < divided.size(); ++i) give(u.divided[i].texel, divided[i]);
    // Light may lie in the next texel but one, beyond one that the wall divides.
    const auto dark = lightOfAll(u.texels.size(), [&](std::size_t i) -> std::pair<Vec3, float> {
        if (!known[u.texels[i]] || !u.charts[u.texelChart[i]].planar) return {};
        const SurfacePoint& p = u.points.of(i)[0];
        return sides.lightBeyondWall({u.texels[i], u.texelChart[i]},
                                     positionAt(state.scene, p.triangle, p.barycentric));
    });
    for (std::size_t i = 0; i < dark.size(); ++i) give(u.texels[i], dark[i]);
}

}  // namespace vlf
