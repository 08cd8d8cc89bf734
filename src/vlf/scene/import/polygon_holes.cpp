#include "vlf/scene/import/polygon_holes.h"

#include "vlf/scene/import/polygon.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace vlf {

namespace {

using Point = glm::dvec2;

double cross(const Point& a, const Point& b) {
    return a.x * b.y - a.y * b.x;
}

/// Twice the signed area of a triangle: positive if counter-clockwise.
double turn(const Point& a, const Point& b, const Point& c) {
    return cross(b - a, c - a);
}

/// Whether two segments that share no corner have a point in common, or nearly so.
bool meet(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point lower = glm::max(glm::min(a, b), glm::min(c, d));
    const Point upper = glm::min(glm::max(a, b), glm::max(c, d));
    if (lower.x > upper.x || lower.y > upper.y) return false;
    return turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0;
}

double signedArea(const Ring& ring) {
    double twice = 0;
    for (std::size_t k = 0; k < ring.size(); ++k)
        twice += cross(ring[k], ring[(k + 1) % ring.size()]);
    return 0.5 * twice;
}

bool contains(const Ring& ring, const Point& p) {
    bool inside = false;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point &a = ring[k], &b = ring[(k + 1) % ring.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

struct Edge {
    Point a, b;
    double left, right;
};

std::vector<Edge> edgesFromTheLeft(std::span<const Ring> rings) {
    std::vector<Edge> edges;
    for (const Ring& ring : rings)
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Point &a = ring[k], &b = ring[(k + 1) % ring.size()];
            edges.push_back({a, b, std::min(a.x, b.x), std::max(a.x, b.x)});
        }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& a, const Edge& b) { return a.left < b.left; });
    return edges;
}

bool shareCorner(const Edge& e, const Edge& f) {
    return e.a == f.a || e.a == f.b || e.b == f.a || e.b == f.b;
}

/// An outer ring and the holes in it: indices of corners, counted through all rings.
struct Part {
    std::vector<int> corners;
    double area = 0;
    const Ring* outer = nullptr;
    std::vector<std::vector<int>> holes;
};

class RegionCutter {
  public:
    explicit RegionCutter(std::span<const Ring> rings) {
        for (const Ring& ring : rings) points_.insert(points_.end(), ring.begin(), ring.end());
        sortIntoParts(rings);
    }

    std::optional<std::vector<std::array<int, 3>>> run() {
        std::vector<std::array<int, 3>> triangles;
        for (Part& part : parts_) {
            if (!joinHoles(part) || part.corners.size() > kMaxRegionCorners) return std::nullopt;
            if (!clipEars(part, triangles)) return std::nullopt;
        }
        return triangles;
    }

  private:
    void sortIntoParts(std::span<const Ring> rings) {
        std::vector<std::pair<const Ring*, std::vector<int>>> holes;
        int first = 0;
        for (const Ring& ring : rings) {
            std::vector<int> corners(ring.size());
            std::iota(corners.begin(), corners.end(), first);
            first += static_cast<int>(ring.size());
            const double area = signedArea(ring);
            if (area > 0)
                parts_.push_back({std::move(corners), area, &ring, {}});
            else
                holes.emplace_back(&ring, std::move(corners));
        }
        for (auto& [ring, corners] : holes)
            if (Part* part = smallestAround(ring->front())) {
                part->area += signedArea(*ring);
                part->holes.push_back(std::move(corners));
            }
    }

    Part* smallestAround(const Point& p) {
        Part* smallest = nullptr;
        double least = std::numeric_limits<double>::max();
        for (Part& part : parts_) {
            const double area = signedArea(*part.outer);
            if (area >= least || !contains(*part.outer, p)) continue;
            least = area;
            smallest = &part;
        }
        return smallest;
    }

    /// Joins each hole by two equal edges, to and fro; the one farthest to the right first, by its
    /// rightmost corner, to the nearest corner that can be seen from there.
    bool joinHoles(Part& part) {
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t h = 0; h < part.holes.size(); ++h) {
            auto& hole = part.holes[h];
            std::rotate(hole.begin(),
                        std::max_element(hole.begin(), hole.end(),
                                         [&](int a, int b) { return points_[a].x < points_[b].x; }),
                        hole.end());
            order.emplace_back(-points_[hole[0]].x, h);
        }
        std::sort(order.begin(), order.end());
        std::vector<std::pair<int, int>> edges;
        addEdges(part.corners, edges);
        for (const auto& hole : part.holes) addEdges(hole, edges);
        for (const auto& [x, h] : order)
            if (!join(part, part.holes[h], edges)) return false;
        return true;
    }

    static void addEdges(const std::vector<int>& ring, std::vector<std::pair<int, int>>& edges) {
        for (std::size_t k = 0; k < ring.size(); ++k)
            edges.emplace_back(ring[k], ring[(k + 1) % ring.size()]);
    }

    bool join(Part& part, const std::vector<int>& hole, std::vector<std::pair<int, int>>& edges) {
        const Point& from = points_[hole[0]];
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t k = 0; k < part.corners.size(); ++k) {
            const Point offset = points_[part.corners[k]] - from;
            order.emplace_back(glm::dot(offset, offset), k);
        }
        std::sort(order.begin(), order.end());
        for (const auto& [squared, k] : order) {
            const int to = part.corners[k];
            if (!opensTowards(part.corners, k, from) || !isFree(hole[0], to, edges)) continue;
            std::vector<int> bridge(hole.begin(), hole.end());
            bridge.insert(bridge.end(), {hole[0], to});
            part.corners.insert(part.corners.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                                bridge.begin(), bridge.end());
            edges.emplace_back(hole[0], to);
            return true;
        }
        return false;
    }

    /// Whether p lies, seen from corner k of a ring, between its two edges, on their left.
    bool opensTowards(const std::vector<int>& ring, std::size_t k, const Point& p) const {
        const std::size_t n = ring.size();
        const Point &before = points_[ring[(k + n - 1) % n]], &here = points_[ring[k]],
                    &after = points_[ring[(k + 1) % n]];
        const bool leftOfFirst = turn(before, here, p) > 0, leftOfSecond = turn(here, after, p) > 0;
        return turn(before, here, after) > 0 ? leftOfFirst && leftOfSecond
                                             : leftOfFirst || leftOfSecond;
    }

    bool isFree(int from, int to, const std::vector<std::pair<int, int>>& edges) const {
        return std::none_of(edges.begin(), edges.end(), [&](const std::pair<int, int>& e) {
            if (e.first == from || e.first == to || e.second == from || e.second == to)
                return false;
            return meet(points_[from], points_[to], points_[e.first], points_[e.second]);
        });
    }

    /// False if a triangle comes out the wrong way round, or the area is another.
    bool clipEars(const Part& part, std::vector<std::array<int, 3>>& triangles) const {
        std::vector<Vec3> corners;
        for (const int c : part.corners) corners.emplace_back(points_[c].x, points_[c].y, 0);
        double sum = 0;
        for (const auto& ear : triangulatePolygon(corners)) {
            const std::array<int, 3> t{part.corners[ear[0]], part.corners[ear[1]],
                                       part.corners[ear[2]]};
            const double twice = turn(points_[t[0]], points_[t[1]], points_[t[2]]);
            if (twice < -1e-6 * part.area) return false;
            sum += 0.5 * twice;
            if (twice > 0) triangles.push_back(t);
        }
        return std::abs(sum - part.area) <= 1e-6 * part.area;
    }

    std::vector<Point> points_;
    std::vector<Part> parts_;
};

}  // namespace

bool areSimple(std::span<const Ring> rings) {
    const std::vector<Edge> edges = edgesFromTheLeft(rings);
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = i + 1; j < edges.size() && edges[j].left <= edges[i].right; ++j)
            if (!shareCorner(edges[i], edges[j]) &&
                meet(edges[i].a, edges[i].b, edges[j].a, edges[j].b))
                return false;
    return true;
}

std::optional<std::vector<std::array<int, 3>>> triangulateRegion(std::span<const Ring> rings) {
    return RegionCutter(rings).run();
}

}  // namespace vlf
