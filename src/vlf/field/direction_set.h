#pragma once
// Directions spread evenly over the sphere, with constant-time nearest and interpolation queries.
//
// The four triangles of the octahedron's upper half are subdivided n-fold and mapped to the sphere;
// antipodal points of the equator are identified. This gives l = 2·4ⁿ + 1 lines through the origin
// (129, 513, 2049, 8193 for n = 3..6), each used in both senses. After M. Slater, "Constant time
// queries on uniformly distributed points on a hemisphere", JGT 7(1), 2002, with one change: the
// octahedron is not projected centrally but by the equal-area map of P. Clarberg, "Fast Equal-Area
// Mapping of the (Hemi)Sphere using SIMD", JGT 13(3), 2008, which has a closed inverse.
//
// With m = 2ⁿ the points lie on rings k = 0..m of height y = 1 - (k/m)², 4k points equally spaced
// on each, ring 0 being the pole and ring m the equator. Their triangulation is Delaunay without
// obtuse triangles, so that the Voronoi cell of a point stays within its triangles. For l >= 129
// all solid angles lie within -11 % and +6 % of the mean, but for those of the two poles (-36 %).

#include "vlf/math/vector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vlf {

/// Three oriented directions v whose spherical triangle holds a direction d, and its weights w in
/// it: d is parallel to the sum of w·v; w >= 0, sum 1.
struct DirectionTriple {
    std::array<std::uint32_t, 3> index{};
    Vec3 weight{1, 0, 0};
};

/// l lines; oriented direction i < l is line i as stored (upper half space, +Y up), direction
/// l + i its opposite.
class DirectionSet {
  public:
    /// `lines` must be 2·4ⁿ + 1 with n in [0, 8]; throws InputError otherwise.
    explicit DirectionSet(int lines);

    /// Whether there is a set of so many lines.
    static bool exists(int lines);

    int lineCount() const { return static_cast<int>(weights_.size()); }
    int directionCount() const { return 2 * lineCount(); }

    /// Unit vector of oriented direction i in [0, directionCount()).
    const Vec3& direction(std::uint32_t i) const { return directions_[i]; }

    /// Solid angle (steradian) of the Voronoi cell of oriented direction i: the directions it is
    /// nearest to. All sum to 4π.
    float weight(std::uint32_t i) const { return weights_[i % weights_.size()]; }

    std::uint32_t opposite(std::uint32_t i) const {
        const auto l = static_cast<std::uint32_t>(lineCount());
        return i < l ? i + l : i - l;
    }

    /// The direction closest to unit vector d, i.e. of the largest dot product in float. Constant
    /// time: four candidates.
    std::uint32_t nearest(const Vec3& d) const;

    /// The spherical triangle around unit vector d, with weights that are continuous in d over the
    /// whole sphere. Constant time.
    DirectionTriple triple(const Vec3& d) const;

  private:
    /// A point of the triangulation: `ring` in [0, m], and how many points on from +X towards +Z.
    struct GridPoint {
        int ring = 0, position = 0;
    };
    struct Cell;

    std::uint32_t index(GridPoint p) const;
    std::array<GridPoint, 3> corners(const Cell& cell) const;
    void placeDirections();
    void computeWeights();

    int rings_ = 1;  ///< m
    std::vector<Vec3> directions_;
    std::vector<float> weights_;  ///< one per line
};

}  // namespace vlf
