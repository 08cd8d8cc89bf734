#include "vlf/propagate/mirror_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf {

namespace {

constexpr float kMinCosine = 1e-3f;  // sides more grazing than this show nothing
constexpr float kGuard = 1.01f;      // cells, a little more than the one that is needed
constexpr float kEdge = 1e-4f;       // of a triangle's height: on its edge
constexpr float kMaxGuard = 2;  // of the cell size on the chart, where it is seen at grazing angles

float cross(const Vec2& a, const Vec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Point of segment ab closest to p, as a fraction of ab.
float closestOnSegment(const Vec2& a, const Vec2& b, const Vec2& p) {
    const Vec2 ab = b - a;
    return std::clamp(glm::dot(p - a, ab) / std::max(glm::dot(ab, ab), 1e-20f), 0.0f, 1.0f);
}

}  // namespace

/// A triangle in cell coordinates, counter-clockwise or not.
struct MirrorCellFinder::Projected {
    std::array<Vec2, 3> corner;
    Vec3 nearness{0};  ///< of the corners
    float area = 0;    ///< twice, signed

    Vec2 lower() const { return glm::min(corner[0], glm::min(corner[1], corner[2])); }
    Vec2 upper() const { return glm::max(corner[0], glm::max(corner[1], corner[2])); }

    /// Cells whose centres lie within the guard of the bounding rectangle.
    CellRange range(int cells) const {
        const Vec2 lo = glm::ceil(lower() - (kGuard + 0.5f)),
                   hi = glm::floor(upper() + (kGuard - 0.5f));
        const auto clampCell = [&](float v) {
            return static_cast<int>(std::clamp(v, 0.0f, static_cast<float>(cells)));
        };
        return {clampCell(lo.x), clampCell(lo.y), clampCell(hi.x + 1), clampCell(hi.y + 1)};
    }

    /// Smallest and largest x within kGuard of the triangle's part with y in [low, high].
    Vec2 extent(float low, float high) const {
        Vec2 x(Candidate::kNone, -Candidate::kNone);
        const auto add = [&](float v) {
            x = {std::min(x.x, v - kGuard), std::max(x.y, v + kGuard)};
        };
        for (int i = 0; i < 3; ++i) {
            const Vec2 &a = corner[i], &b = corner[(i + 1) % 3];
            if (std::max(a.y, b.y) < low || std::min(a.y, b.y) > high) continue;
            for (const float y : {low, high})
                add(glm::mix(a.x, b.x,
                             a.y == b.y ? 0.0f : std::clamp((y - a.y) / (b.y - a.y), 0.0f, 1.0f)));
            if (a.y == b.y) add(b.x);
        }
        return x;
    }

    /// Whether the square of half-width kGuard around p overlaps; p lies in the grown rectangle.
    bool guards(const Vec2& p) const {
        const float turn = area > 0 ? 1.0f : -1.0f;
        for (int i = 0; i < 3; ++i) {
            const Vec2 edge = corner[(i + 1) % 3] - corner[i];
            if (turn * cross(edge, p - corner[i]) < -kGuard * (std::abs(edge.x) + std::abs(edge.y)))
                return false;
        }
        return true;
    }

    /// Weights of the second and third corner at p.
    Vec2 barycentric(const Vec2& p) const {
        return Vec2(cross(p - corner[0], corner[2] - corner[0]),
                    cross(corner[1] - corner[0], p - corner[0])) /
               area;
    }

    Vec2 at(const Vec2& b) const {
        return (1 - b.x - b.y) * corner[0] + b.x * corner[1] + b.y * corner[2];
    }

    /// The same of the triangle's point closest to p.
    Vec2 closest(const Vec2& p) const {
        const Vec2 b = barycentric(p);
        if (b.x >= 0 && b.y >= 0 && b.x + b.y <= 1) return b;
        const float s = closestOnSegment(corner[0], corner[1], p);
        const float t = closestOnSegment(corner[1], corner[2], p);
        const float u = closestOnSegment(corner[2], corner[0], p);
        Vec2 best(0);
        float nearest = Candidate::kNone;
        for (const Vec2& c : {Vec2(s, 0), Vec2(1 - t, t), Vec2(0, 1 - u)}) {
            const Vec2 off = at(c) - p;
            if (glm::dot(off, off) < nearest) nearest = glm::dot(off, off), best = c;
        }
        return best;
    }
};

std::vector<MirrorChart> mirrorCharts(const Scene& scene, const LightField& field,
                                      MirrorKind kind) {
    std::vector<std::uint32_t> place(field.charts.size(), kNoChart);
    std::vector<MirrorChart> mirrors;
    for (std::uint32_t c = 0; c < field.charts.size(); ++c)
        if (scene.materials[field.charts[c].material].isSpecular(kind)) {
            place[c] = static_cast<std::uint32_t>(mirrors.size());
            mirrors.push_back({c, field.charts[c].planar, {}});
        }
    const auto add = [&](std::uint32_t chart, std::uint32_t triangle, bool front) {
        if (!front && scene.material(triangle).isSolidGlass()) return;
        if (chart != kNoChart && place[chart] != kNoChart)
            mirrors[place[chart]].sides.push_back(
                {triangle, front, geometricNormal(scene, triangle) * (front ? 1.0f : -1.0f)});
    };
    for (std::uint32_t t = 0; t < field.triangleCharts.size(); ++t) {
        add(field.triangleCharts[t].front, t, true);
        add(field.triangleCharts[t].back, t, false);
    }
    return mirrors;
}

bool MirrorCellFinder::project(const MirrorChart::Side& side, const ParallelSubfield& subfield,
                               const Vec3& toEye, Projected& projected) const {
    if (glm::dot(side.normal, toEye) < kMinCosine) return false;
    for (int i = 0; i < 3; ++i) {
        const Vec3& p = scene_.position(side.triangle, i);
        projected.corner[i] = subfield.cellCoordinates(p);
        projected.nearness[i] = glm::dot(p, toEye);
    }
    projected.area =
        cross(projected.corner[1] - projected.corner[0], projected.corner[2] - projected.corner[0]);
    return std::abs(projected.area) > 1e-12f;
}

MirrorCellFinder::CellRange MirrorCellFinder::range(const MirrorChart& chart,
                                                    const ParallelSubfield& subfield,
                                                    const Vec3& toEye) const {
    CellRange all{subfield.cells, subfield.cells, 0, 0};
    Projected triangle;
    for (const MirrorChart::Side& side : chart.sides) {
        if (!project(side, subfield, toEye, triangle)) continue;
        const CellRange r = triangle.range(subfield.cells);
        all = {std::min(all.x0, r.x0), std::min(all.y0, r.y0), std::max(all.x1, r.x1),
               std::max(all.y1, r.y1)};
    }
    return all;
}

TileCover MirrorCellFinder::tiles(const MirrorChart& chart, const ParallelSubfield& subfield,
                                  const Vec3& toEye, int m) const {
    const CellRange all = range(chart, subfield, toEye);
    TileCover cover;
    if (all.x0 >= all.x1 || all.y0 >= all.y1) return cover;
    cover.firstRow = all.y0 / m;
    cover.spans.assign((all.y1 - 1) / m - cover.firstRow + 1, {subfield.cells, 0});
    Projected triangle;
    for (const MirrorChart::Side& side : chart.sides) {
        if (!project(side, subfield, toEye, triangle)) continue;
        const CellRange r = triangle.range(subfield.cells);
        for (int row = r.y0 / m; row * m < r.y1; ++row) {
            const Vec2 x = triangle.extent(row * m + 0.5f - kGuard, (row + 1) * m - 0.5f + kGuard);
            const int first = std::max(r.x0, static_cast<int>(std::floor(x.x)));
            const int last = std::min(r.x1 - 1, static_cast<int>(std::floor(x.y)));
            if (x.x > x.y || first > last) continue;
            TileSpan& span = cover.spans[row - cover.firstRow];
            span = {std::min(span.begin, first / m), std::max(span.end, last / m + 1)};
        }
    }
    // Between parts of a chart that lie one above the other.
    for (TileSpan& span : cover.spans)
        if (span.begin >= span.end) span = {all.x0 / m, all.x0 / m + 1};
    return cover;
}

void MirrorCellFinder::cover(const Projected& triangle, std::uint32_t side) {
    const CellRange r = triangle.range(1 << 14);
    for (int y = std::max(r.y0, range_.y0); y < std::min(r.y1, range_.y1); ++y)
        for (int x = std::max(r.x0, range_.x0); x < std::min(r.x1, range_.x1); ++x) {
            const Vec2 centre(x + 0.5f, y + 0.5f);
            if (!triangle.guards(centre)) continue;
            const Vec2 b = triangle.closest(centre);
            const Vec2 off = triangle.at(b) - centre;
            const bool within = glm::dot(off, off) < 1e-6f;
            const float outside = within ? 0 : glm::dot(off, off);
            const float nearness = glm::dot(triangle.nearness, Vec3(1 - b.x - b.y, b.x, b.y));
            Candidate& best =
                candidates_[static_cast<std::size_t>(y - range_.y0) * (range_.x1 - range_.x0) + x -
                            range_.x0];
            if (outside < best.outside || (outside == best.outside && nearness > best.nearness))
                best = {outside, nearness, side, b};
        }
}

MirrorCell MirrorCellFinder::cellAt(const MirrorChart& chart, const ParallelSubfield& subfield,
                                    const Vec3& toEye, int x, int y,
                                    const Candidate& candidate) const {
    const MirrorChart::Side& side = chart.sides[candidate.side];
    const Vec2& b = candidate.barycentric;
    const bool onEdge = std::min({b.x, b.y, 1 - b.x - b.y}) < kEdge;
    MirrorCell cell{x, y, side.triangle, side.front, b, Vec3(0), onEdge};
    cell.position = positionAt(scene_, side.triangle, candidate.barycentric);
    if (!chart.planar) return cell;
    // On to where the cell's ray meets the plane.
    const Vec2 missing = Vec2(x + 0.5f, y + 0.5f) - subfield.cellCoordinates(cell.position);
    const float perCell = 1 / glm::dot(subfield.xAxis, subfield.xAxis);
    Vec3 step = perCell * (missing.x * subfield.xAxis + missing.y * subfield.yAxis);
    step -= toEye * (glm::dot(step, side.normal) / glm::dot(toEye, side.normal));
    const float furthest = kMaxGuard * std::sqrt(perCell);
    cell.position += step * std::min(1.0f, furthest / std::max(glm::length(step), 1e-20f));
    return cell;
}

const std::vector<MirrorCell>& MirrorCellFinder::find(const MirrorChart& chart,
                                                      const ParallelSubfield& subfield,
                                                      const Vec3& toEye) {
    cells_.clear();
    range_ = range(chart, subfield, toEye);
    if (range_.x0 >= range_.x1 || range_.y0 >= range_.y1) return cells_;
    candidates_.assign(static_cast<std::size_t>(range_.x1 - range_.x0) * (range_.y1 - range_.y0),
                       {});
    Projected triangle;
    for (std::uint32_t i = 0; i < chart.sides.size(); ++i)
        if (project(chart.sides[i], subfield, toEye, triangle)) cover(triangle, i);
    const Candidate* candidate = candidates_.data();
    for (int y = range_.y0; y < range_.y1; ++y)
        for (int x = range_.x0; x < range_.x1; ++x, ++candidate)
            if (candidate->outside < Candidate::kNone)
                cells_.push_back(cellAt(chart, subfield, toEye, x, y, *candidate));
    return cells_;
}

}  // namespace vlf
