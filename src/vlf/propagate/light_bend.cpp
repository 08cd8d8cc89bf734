#include "vlf/propagate/light_bend.h"

#include "vlf/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf {

namespace {

// Square error to squared second differences, where light bends evenly and at an edge of shadow.
constexpr double kEvenBend = 0.017, kEdgeBend = 0.09;
// Powers of the texels' size with which it falls in either case.
constexpr double kEvenPower = 4, kEdgePower = 1;

constexpr float kOwnNoise = 0.75f;  // of a texel's; chosen on cornell and two-rooms

float squared(const Vec3& v) {
    return glm::dot(v, v);
}

/// A chart's light on its grid of texels.
class LightGrid {
  public:
    struct Texel {
        Vec3 light{0};
        float noise = 0, area = 0;  // area 0: unknown
        float seen = 0;             // 1: somebody may see it
        std::uint32_t block = kNoBlock;
    };

    LightGrid(int width, int height)
        : width_(width), height_(height), texels_(static_cast<std::size_t>(width) * height) {}

    int width() const { return width_; }
    int height() const { return height_; }
    Texel& at(int x, int y) { return texels_[static_cast<std::size_t>(y) * width_ + x]; }
    const Texel& at(int x, int y) const {
        return texels_[static_cast<std::size_t>(y) * width_ + x];
    }

    /// Means of 2 x 2.
    LightGrid halved() const {
        LightGrid half((width_ + 1) / 2, (height_ + 1) / 2);
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                const Texel& from = at(x, y);
                Texel& to = half.at(x / 2, y / 2);
                to.light += from.area * from.light;
                to.noise += from.area * from.area * from.noise;
                to.area += from.area;
                to.seen = std::max(to.seen, from.seen);
                if (to.block == kNoBlock) to.block = from.block;
            }
        for (Texel& t : half.texels_) {
            if (t.area <= 0) continue;
            t.light /= t.area;
            t.noise /= t.area * t.area;
        }
        return half;
    }

    /// Squared second differences less noise. Beyond an edge light is shown as before it.
    float bend(int x, int y) const {
        const Texel& t = at(x, y);
        const auto beside = [&](int dx, int dy) -> const Texel& {
            const int i = x + dx, j = y + dy;
            if (i < 0 || j < 0 || i >= width_ || j >= height_ || at(i, j).area <= 0) return t;
            return at(i, j);
        };
        float sum = 0;
        for (const auto& [dx, dy] : {std::array{1, 0}, std::array{0, 1}}) {
            const Texel &a = beside(dx, dy), &b = beside(-dx, -dy);
            const float own = static_cast<float>((&a != &t) + (&b != &t));
            const float noise =
                (&a != &t ? a.noise : 0) + (&b != &t ? b.noise : 0) + own * own * t.noise;
            sum += squared(a.light + b.light - 2.0f * t.light) - kOwnNoise * noise;
        }
        return sum;
    }

  private:
    int width_, height_;
    std::vector<Texel> texels_;
};

const SurfacePoint& middleOf(const Unwrap& unwrap, std::size_t i) {
    const auto points = unwrap.points.of(i);
    return points[points.size() / 2];
}

/// Whether something stands before all of a texel, closer than it is wide: nobody looks in there.
bool isCovered(const BakeState& state, std::size_t i) {
    const Unwrap& u = state.unwrap;
    const Chart& chart = u.charts[u.texelChart[i]];
    const auto points = u.points.of(i);
    return std::all_of(points.begin(), points.end(), [&](const SurfacePoint& p) {
        const Vec3 position = positionAt(state.scene, p.triangle, p.barycentric);
        return state.rays.occluded(
            {position + state.rays.epsilon() * chart.normal, chart.normal, 0, chart.texelSize()});
    });
}

std::vector<LightGrid> gridsOf(const BakeState& state, const BlockOf& blockOf) {
    const Unwrap& u = state.unwrap;
    std::vector<LightGrid> grids;
    for (const Chart& chart : u.charts)
        grids.emplace_back(static_cast<int>(chart.width), static_cast<int>(chart.height));
    parallelFor(u.texels.size(), 256, [&](std::size_t i) {
        if (maxComponent(state.reflectance[i]) <= 0) return;
        const Chart& chart = u.charts[u.texelChart[i]];
        grids[u.texelChart[i]].at(static_cast<int>(u.texels[i] % u.atlasWidth - chart.x),
                                  static_cast<int>(u.texels[i] / u.atlasWidth - chart.y)) = {
            .light = state.irradiance[i],
            .noise = state.directVariance[i] + state.indirectVariance[i],
            .area = u.texelArea(i),
            .seen = isCovered(state, i) ? 0.0f : 1.0f,
            .block = kNoBlock};
    });
    for (std::size_t i = 0; i < u.texels.size(); ++i) {
        const Chart& chart = u.charts[u.texelChart[i]];
        const SurfacePoint& p = middleOf(u, i);
        LightGrid::Texel& texel =
            grids[u.texelChart[i]].at(static_cast<int>(u.texels[i] % u.atlasWidth - chart.x),
                                      static_cast<int>(u.texels[i] / u.atlasWidth - chart.y));
        if (texel.area > 0)
            texel.block = blockOf(p.triangle, positionAt(state.scene, p.triangle, p.barycentric));
    }
    return grids;
}

}  // namespace

double BendBlock::squareError(double texelSize) const {
    if (fine <= 0) return 0;
    const double power =
        std::clamp(std::log2(std::max(coarse, fine) / fine), kEdgePower, kEvenPower);
    const double evenness = (power - kEdgePower) / (kEvenPower - kEdgePower);
    return kEdgeBend * std::pow(kEvenBend / kEdgeBend, evenness) * fine *
           std::pow(texelSize / std::sqrt(area / texels), power);
}

std::vector<BendBlock> findBend(const BakeState& state, const BlockOf& blockOf) {
    std::vector<BendBlock> blocks;
    const auto forTexels = [&](const LightGrid& grid, const auto& visit) {
        for (int y = 0; y < grid.height(); ++y)
            for (int x = 0; x < grid.width(); ++x)
                if (const LightGrid::Texel& t = grid.at(x, y); t.block != kNoBlock) {
                    if (t.block >= blocks.size()) blocks.resize(t.block + 1);
                    visit(blocks[t.block], t, double{t.area} * t.seen * grid.bend(x, y));
                }
    };
    for (const LightGrid& grid : gridsOf(state, blockOf)) {
        forTexels(grid, [](BendBlock& b, const LightGrid::Texel& t, double bend) {
            b.area += t.area;
            b.texels += 1;
            b.fine += bend;
        });
        forTexels(grid.halved(),
                  [](BendBlock& b, const LightGrid::Texel&, double bend) { b.coarse += bend; });
    }
    return blocks;
}

}  // namespace vlf
