#pragma once
// Directions spread evenly over the sphere, with constant-time nearest and interpolation queries.
//
// The four triangles of the octahedron's upper half are subdivided n-fold and projected to the
// sphere; antipodal points of the equator are identified. This gives l = 2·4ⁿ + 1 lines through
// the origin (129, 513, 2049, 8193 for n = 3..6), each used in both senses. After M. Slater,
// "Constant time queries on uniformly distributed points on a hemisphere", JGT 7(1), 2002.

#include "vlf/math/vector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vlf {

/// Three oriented directions whose spherical triangle holds a direction, and its weights in it
/// (>= 0, sum 1).
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

    int lineCount() const { return static_cast<int>(lines_.size()); }
    int directionCount() const { return 2 * lineCount(); }

    /// Unit vector of oriented direction i in [0, directionCount()).
    Vec3 direction(std::uint32_t i) const {
        const auto l = static_cast<std::uint32_t>(lineCount());
        return i < l ? lines_[i] : -lines_[i - l];
    }

    /// Solid angle (steradian) of the cell of oriented direction i; all sum to 4π.
    float weight(std::uint32_t i) const { return weights_[i % lines_.size()]; }

    std::uint32_t opposite(std::uint32_t i) const {
        const auto l = static_cast<std::uint32_t>(lineCount());
        return i < l ? i + l : i - l;
    }

    /// The direction closest to unit vector d. Constant time.
    std::uint32_t nearest(const Vec3& d) const;

    /// The spherical triangle around unit vector d, with barycentric weights. Constant time.
    DirectionTriple triple(const Vec3& d) const;

  private:
    int subdivision_ = 0;  ///< edges along one side of an octahedron face: 2ⁿ
    std::vector<Vec3> lines_;
    std::vector<float> weights_;
};

}  // namespace vlf
