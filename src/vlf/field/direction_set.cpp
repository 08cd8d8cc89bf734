#include "vlf/field/direction_set.h"

#include "vlf/base/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <glm/common.hpp>

namespace vlf {

/// A triangle of one octant of the upper half, between rings `row` and `row + 1`: an "up" triangle
/// has one corner on the upper ring, a "down" triangle two. `column` counts along the ring from
/// the octant's first meridian.
struct DirectionSet::Cell {
    int octant = 0, row = 0, column = 0;
    bool up = true;

    bool exists(int rings) const {
        return row < rings && column >= 0 && column <= (up ? row : row - 1);
    }

    /// The cell across the edge opposite corner i (see corners()).
    Cell across(int i) const {
        if (up) return {octant, row + (i == 0), column - (i == 1), false};
        return {octant, row - (i == 2), column + (i == 0), true};
    }
};

namespace {

constexpr int kMaxSubdivision = 8;

int ringsFor(int lines) {
    for (int n = 0; n <= kMaxSubdivision; ++n)
        if (lines == 2 * (1 << 2 * n) + 1) return 1 << n;
    throw InputError("a direction set cannot have " + std::to_string(lines) +
                     " lines: use 129, 513, 2049 or 8193");
}

/// Inverse of the equal-area map: where a direction of the upper half lies in the grid.
struct GridCoordinates {
    float ring;   ///< in [0, m]
    float turns;  ///< around +Y from +X towards +Z, in quarter turns, in [0, 4]
};

/// Angle of (x, z) in quarter turns, in [0, 4], to within 1e-5 (Abramowitz and Stegun 4.4.49):
/// enough to tell a cell, for the lookups correct what lies that close to a cell's border.
float quarterTurns(float x, float z) {
    const float ax = std::abs(x), az = std::abs(z), larger = std::max(ax, az);
    const float t = larger > 0 ? std::min(ax, az) / larger : 0, s = t * t;
    const float octantAngle =
        t *
        (0.9998660f + s * (-0.3302995f + s * (0.1801410f + s * (-0.0851330f + s * 0.0208351f))));
    const float octantTurns = octantAngle * (2 / kPi);
    const float quadrantTurns = az > ax ? 1 - octantTurns : octantTurns;
    const float halfTurns = x < 0 ? 2 - quadrantTurns : quadrantTurns;
    return z < 0 ? 4 - halfTurns : halfTurns;
}

GridCoordinates toGrid(const Vec3& d, int rings) {
    // sqrt(1 - y) would lose all digits near the pole.
    const float ring = rings * std::sqrt((d.x * d.x + d.z * d.z) / (1 + d.y));
    return {std::min(ring, static_cast<float>(rings)), quarterTurns(d.x, d.z)};
}

/// Area of a spherical triangle (Van Oosterom and Strackee 1983).
double sphericalArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return 2 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))),
                          1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

/// Weights, up to a common factor, of the three corners at d; negative beyond the opposite edge.
/// Taking the differences first keeps them exact for small triangles.
Vec3 triangleWeights(const Vec3& d, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = a - d, v = b - d, w = c - d;
    return {glm::dot(d, glm::cross(v, w)), glm::dot(d, glm::cross(w, u)),
            glm::dot(d, glm::cross(u, v))};
}

int smallestComponent(const Vec3& w) {
    return w.x < w.y ? (w.x < w.z ? 0 : 2) : (w.y < w.z ? 1 : 2);
}

}  // namespace

bool DirectionSet::exists(int lines) {
    for (int n = 0; n <= kMaxSubdivision; ++n)
        if (lines == 2 * (1 << 2 * n) + 1) return true;
    return false;
}

DirectionSet::DirectionSet(int lines)
    : rings_(ringsFor(lines)), directions_(2 * lines), weights_(lines) {
    placeDirections();
    computeWeights();
}

std::uint32_t DirectionSet::index(GridPoint p) const {
    if (p.ring == 0) return 0;
    const int perRing = 4 * p.ring, first = 1 + 2 * p.ring * (p.ring - 1);
    const int position = p.position < perRing ? p.position : p.position - perRing;
    // Of the equator only the first half is stored; the other half is its opposite.
    const bool opposite = p.ring == rings_ && position >= 2 * rings_;
    return first + (opposite ? position - 2 * rings_ + lineCount() : position);
}

std::array<DirectionSet::GridPoint, 3> DirectionSet::corners(const Cell& cell) const {
    const GridPoint upper{cell.row, cell.octant * cell.row + cell.column};
    const GridPoint lower{cell.row + 1, cell.octant * (cell.row + 1) + cell.column};
    const GridPoint lowerNext{lower.ring, lower.position + 1};
    if (cell.up) return {upper, lowerNext, lower};
    return {upper, GridPoint{upper.ring, upper.position + 1}, lowerNext};
}

void DirectionSet::placeDirections() {
    directions_[0] = {0, 1, 0};
    for (int ring = 1; ring <= rings_; ++ring) {
        const double r = static_cast<double>(ring) / rings_;
        const double y = 1 - r * r, horizontal = r * std::sqrt(2 - r * r);
        for (int i = 0; i < ring; ++i) {
            const double phi = 0.5 * std::numbers::pi * i / ring;
            double x = horizontal * std::cos(phi), z = horizontal * std::sin(phi);
            for (int octant = 0; octant < (ring == rings_ ? 2 : 4); ++octant) {
                directions_[index({ring, octant * ring + i})] = Vec3(glm::dvec3(x, y, z));
                x = -std::exchange(z, x);
            }
        }
    }
    const auto half = directions_.begin() + lineCount();
    std::transform(directions_.begin(), half, half, [](const Vec3& d) { return -d; });
}

void DirectionSet::computeWeights() {
    std::vector<double> area(weights_.size(), 0.0);
    // The circumcentre of a triangle is a corner of its corners' Voronoi cells and, with an edge,
    // spans a triangle that the edge's ends share equally.
    const auto addTriangle = [&](const Cell& cell) {
        std::array<std::uint32_t, 3> id;
        std::array<glm::dvec3, 3> v;
        for (int i = 0; i < 3; ++i) {
            id[i] = index(corners(cell)[i]);
            v[i] = glm::normalize(glm::dvec3(direction(id[i])));
        }
        const glm::dvec3 centre = glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0]));
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            const double half = 0.5 * sphericalArea(v[i], v[j], centre);
            area[id[i] % weights_.size()] += half;
            area[id[j] % weights_.size()] += half;
        }
    };
    for (int octant = 0; octant < 4; ++octant)
        for (int row = 0; row < rings_; ++row)
            for (int column = 0; column <= row; ++column) {
                addTriangle({octant, row, column, true});
                if (column < row) addTriangle({octant, row, column, false});
            }
    std::copy(area.begin(), area.end(), weights_.begin());
}

std::uint32_t DirectionSet::nearest(const Vec3& d) const {
    const Vec3 up = d.y < 0 ? -d : d;
    const GridCoordinates at = toGrid(up, rings_);
    // On one ring, the nearest point is the nearest in angle; of the rings, one of the two around.
    std::uint32_t best = 0;
    float largest = -2;
    const int upper = std::min(static_cast<int>(at.ring), rings_ - 1);
    for (int ring = upper; ring <= upper + 1; ++ring) {
        const int before = std::min(static_cast<int>(at.turns * ring), 4 * ring - 1);
        for (int position = before; position <= before + 1; ++position) {
            const std::uint32_t i = index({ring, std::max(position, 0)});
            if (const float dot = glm::dot(up, direction(i)); dot > largest) {
                largest = dot;
                best = i;
            }
        }
    }
    return d.y < 0 ? opposite(best) : best;
}

DirectionTriple DirectionSet::triple(const Vec3& d) const {
    const Vec3 up = d.y < 0 ? -d : d;
    const GridCoordinates at = toGrid(up, rings_);
    Cell cell;
    cell.octant = std::min(static_cast<int>(at.turns), 3);
    cell.row = std::min(static_cast<int>(at.ring), rings_ - 1);
    const float along = (at.turns - cell.octant) * at.ring;
    cell.column = std::clamp(static_cast<int>(along), 0, cell.row);
    cell.up = along - cell.column <= at.ring - cell.row || cell.column == cell.row;

    // Edges are great circles on the sphere but not in the grid: the triangle may be a neighbour.
    constexpr int kMaxSteps = 3;
    DirectionTriple result;
    for (int step = 0;; ++step) {
        const std::array<GridPoint, 3> corner = corners(cell);
        for (int i = 0; i < 3; ++i) result.index[i] = index(corner[i]);
        result.weight = triangleWeights(up, direction(result.index[0]), direction(result.index[1]),
                                        direction(result.index[2]));
        const int outside = smallestComponent(result.weight);
        if (result.weight[outside] >= 0 || step == kMaxSteps) break;
        const Cell next = cell.across(outside);
        if (!next.exists(rings_)) break;
        cell = next;
    }
    result.weight = glm::max(result.weight, Vec3(0));
    result.weight /= result.weight.x + result.weight.y + result.weight.z;
    if (d.y < 0)
        for (std::uint32_t& i : result.index) i = opposite(i);
    return result;
}

}  // namespace vlf
