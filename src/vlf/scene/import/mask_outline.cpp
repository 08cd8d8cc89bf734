#include "vlf/scene/import/mask_outline.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace vlf {

namespace {

/// Crossings keep this distance, in steps, from the samples, so that outlines never touch.
constexpr double kLeastFraction = 1e-3;

/// Area below which a part or hole is left out: in square steps, and in squares of the edge.
constexpr double kLeastArea = 0.25, kLeastShare = 0.02;

/// The samples of a triangle and the lines between them: sample (i, j) has the weights i / steps
/// and j / steps, i + j <= steps.
class MaskGrid {
  public:
    /// A sample, or the crossing on the line from it to the right (1), up (2) or from its right
    /// neighbour to its upper one (3).
    using Node = std::uint32_t;

    MaskGrid(const Excess& excess, int steps, const std::array<glm::dvec2, 3>& shape)
        : steps_(steps), shape_(shape), excess_(static_cast<std::size_t>(steps + 1) * (steps + 1)) {
        for (int j = 0; j <= steps; ++j)
            for (int i = 0; i + j <= steps; ++i)
                excess_[index(i, j)] = excess(glm::dvec2(i, j) / static_cast<double>(steps));
    }

    MaskCover cover() const {
        bool any = false, all = true;
        for (int j = 0; j <= steps_; ++j)
            for (int i = 0; i + j <= steps_; ++i) (isSolid(i, j) ? any : all) = isSolid(i, j);
        return all ? MaskCover::solid : any ? MaskCover::mixed : MaskCover::none;
    }

    /// Directed lines with the solid part on their left, sorted; nothing if there are too many.
    /// Every node of theirs begins one and ends one.
    std::optional<std::vector<std::pair<Node, Node>>> lines() const {
        std::vector<std::pair<Node, Node>> all;
        for (int j = 0; j < steps_; ++j) {
            for (int i = 0; i + j < steps_; ++i) {
                addCell(all, {{{i, j}, {i + 1, j}, {i, j + 1}}});
                if (i + j + 1 < steps_) addCell(all, {{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
            }
            if (all.size() > kMostOutlinePoints) return std::nullopt;
        }
        for (int k = 0; k < steps_; ++k) {
            addBorder(all, {k, 0}, {k + 1, 0});
            addBorder(all, {steps_ - k, k}, {steps_ - k - 1, k + 1});
            addBorder(all, {0, k + 1}, {0, k});
        }
        std::sort(all.begin(), all.end());
        return all;
    }

    OutlinePoint point(Node node) const {
        const int kind = static_cast<int>(node % 4), at = static_cast<int>(node / 4);
        const int i = at % (steps_ + 1), j = at / (steps_ + 1);
        glm::dvec2 p(i, j);
        if (kind == 1) p.x += crossing({i, j}, {i + 1, j});
        if (kind == 2) p.y += crossing({i, j}, {i, j + 1});
        if (kind == 3) {
            const double f = crossing({i + 1, j}, {i, j + 1});
            p += glm::dvec2(1 - f, f);
        }
        const bool onDiagonal = kind == 3 ? i + j + 1 == steps_ : kind == 0 && i + j == steps_;
        OutlinePoint result;
        result.weights = p / static_cast<double>(steps_);
        result.place = glm::vec2(shape_[0] + result.weights.x * (shape_[1] - shape_[0]) +
                                 result.weights.y * (shape_[2] - shape_[0]));
        result.sides = (j == 0 && kind < 2 ? 1u : 0u) | (onDiagonal ? 2u : 0u) |
                       (i == 0 && kind % 2 == 0 ? 4u : 0u);
        return result;
    }

  private:
    using Sample = std::array<int, 2>;

    std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * (steps_ + 1) + i; }
    float at(const Sample& s) const { return excess_[index(s[0], s[1])]; }
    bool isSolid(int i, int j) const { return excess_[index(i, j)] >= 0; }
    bool isSolid(const Sample& s) const { return at(s) >= 0; }

    Node node(const Sample& s, int kind = 0) const {
        return static_cast<Node>(4 * index(s[0], s[1]) + kind);
    }

    /// The crossing between neighbours.
    Node between(const Sample& a, const Sample& b) const {
        if (a[1] == b[1]) return node({std::min(a[0], b[0]), a[1]}, 1);
        if (a[0] == b[0]) return node({a[0], std::min(a[1], b[1])}, 2);
        return node({std::min(a[0], b[0]), std::min(a[1], b[1])}, 3);
    }

    /// How far from a to b the excess is 0.
    double crossing(const Sample& a, const Sample& b) const {
        const double f = static_cast<double>(at(a)) / (static_cast<double>(at(a)) - at(b));
        return std::clamp(f, kLeastFraction, 1 - kLeastFraction);
    }

    void addCell(std::vector<std::pair<Node, Node>>& all, const std::array<Sample, 3>& cell) const {
        for (int k = 0; k < 3; ++k) {
            const Sample &a = cell[k], &b = cell[(k + 1) % 3], &c = cell[(k + 2) % 3];
            if (isSolid(a) && !isSolid(b) && !isSolid(c))
                all.emplace_back(between(a, b), between(c, a));
            if (isSolid(a) && isSolid(b) && !isSolid(c))
                all.emplace_back(between(b, c), between(c, a));
        }
    }

    void addBorder(std::vector<std::pair<Node, Node>>& all, const Sample& a,
                   const Sample& b) const {
        if (!isSolid(a) && !isSolid(b)) return;
        all.emplace_back(isSolid(a) ? node(a) : between(a, b),
                         isSolid(b) ? node(b) : between(a, b));
    }

    int steps_;
    std::array<glm::dvec2, 3> shape_;
    std::vector<float> excess_;
};

/// Leaves out what lies between others on one edge of the triangle.
Outline withoutBorderPoints(const Outline& outline) {
    Outline kept;
    const std::size_t n = outline.size();
    for (std::size_t k = 0; k < n; ++k)
        if ((outline[(k + n - 1) % n].sides & outline[k].sides & outline[(k + 1) % n].sides) == 0)
            kept.push_back(outline[k]);
    return kept;
}

std::vector<Outline> linkedOutlines(
    const MaskGrid& grid, const std::vector<std::pair<MaskGrid::Node, MaskGrid::Node>>& lines,
    int steps) {
    const double leastArea = std::min(kLeastArea, kLeastShare * steps * steps);
    std::vector<Outline> outlines;
    std::vector<char> used(lines.size(), 0);
    for (std::size_t first = 0; first < lines.size(); ++first) {
        Outline outline;
        for (std::size_t k = first; !used[k];) {
            used[k] = 1;
            outline.push_back(grid.point(lines[k].first));
            const auto next = std::lower_bound(lines.begin(), lines.end(),
                                               std::pair{lines[k].second, MaskGrid::Node{0}});
            k = static_cast<std::size_t>(next - lines.begin());
        }
        if (outline.size() < 3) continue;
        outline = withoutBorderPoints(outline);
        if (std::abs(signedArea(outline)) >= leastArea) outlines.push_back(std::move(outline));
    }
    return outlines;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Squared distance of p from the line segment between a and b.
double squaredDistance(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double squared = glm::dot(along, along);
    const double f = squared > 0 ? std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0;
    const glm::dvec2 offset = p - (a + f * along);
    return glm::dot(offset, offset);
}

/// Marks the points of outline (taken as a ring) between first and last that must stay.
void keepBetween(const Outline& outline, std::size_t first, std::size_t last, double tolerance,
                 std::vector<char>& keep) {
    const std::size_t n = outline.size();
    std::vector<std::pair<std::size_t, std::size_t>> runs{{first, last}};
    while (!runs.empty()) {
        const auto [a, b] = runs.back();
        runs.pop_back();
        double most = tolerance * tolerance;
        std::size_t farthest = a;
        for (std::size_t k = a + 1; k < b; ++k) {
            const double d =
                squaredDistance(outline[k % n].place, outline[a % n].place, outline[b % n].place);
            if (d <= most) continue;
            most = d;
            farthest = k;
        }
        if (farthest == a) continue;
        keep[farthest % n] = 1;
        runs.emplace_back(a, farthest);
        runs.emplace_back(farthest, b);
    }
}

/// Marks two points far apart of an outline that has no fixed ones.
void keepTwo(const Outline& outline, std::vector<char>& keep) {
    std::size_t farthest = 0;
    double most = -1;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const glm::dvec2 offset = outline[k].place - outline[0].place;
        if (glm::dot(offset, offset) <= most) continue;
        most = glm::dot(offset, offset);
        farthest = k;
    }
    keep[0] = keep[farthest] = 1;
}

}  // namespace

double signedArea(const Outline& outline) {
    double twice = 0;
    for (std::size_t k = 0; k < outline.size(); ++k)
        twice += cross(outline[k].place, outline[(k + 1) % outline.size()].place);
    return 0.5 * twice;
}

std::optional<MaskedPart> solidPart(const Excess& excess, int steps,
                                    const std::array<glm::dvec2, 3>& shape) {
    const MaskGrid grid(excess, steps, shape);
    MaskedPart part;
    part.cover = grid.cover();
    if (part.cover != MaskCover::mixed) return part;
    const auto lines = grid.lines();
    if (!lines) return std::nullopt;
    part.outlines = linkedOutlines(grid, *lines, steps);
    return part;
}

Outline simplified(const Outline& outline, double tolerance) {
    std::vector<char> keep(outline.size(), 0);
    for (std::size_t k = 0; k < outline.size(); ++k) keep[k] = outline[k].sides != 0;
    if (std::find(keep.begin(), keep.end(), 1) == keep.end()) keepTwo(outline, keep);
    const std::vector<char> fixed = keep;
    const std::size_t n = outline.size();
    const auto start =
        static_cast<std::size_t>(std::find(fixed.begin(), fixed.end(), 1) - fixed.begin());
    for (std::size_t a = start, b = start + 1; b <= start + n; ++b) {
        if (!fixed[b % n]) continue;
        keepBetween(outline, a, b, tolerance, keep);
        a = b;
    }
    Outline result;
    for (std::size_t k = 0; k < n; ++k)
        if (keep[k]) result.push_back(outline[k]);
    return result;
}

}  // namespace vlf
