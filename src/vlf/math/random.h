#pragma once
// Counter-based random numbers: a value is a pure function of its key and index, so results do
// not depend on threads or order of evaluation.

#include "vlf/math/vector.h"

#include <cstdint>

namespace vlf {

/// Mixes 64 bits (finaliser of SplitMix64, Steele et al., OOPSLA 2014).
inline std::uint64_t mixBits(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

/// The top 24 bits of x as a float in [0, 1).
inline float toUnitFloat(std::uint64_t x) {
    return static_cast<float>(x >> 40) * 0x1p-24f;
}

/// A stream of random numbers that belongs to `key` (a texel, a direction, a pixel) and `seed`.
class RandomStream {
  public:
    RandomStream(std::uint64_t seed, std::uint64_t key)
        : state_(mixBits(seed + 0x9e3779b97f4a7c15ull) ^ mixBits(key * 0xd1342543de82ef95ull + 1)) {}

    std::uint64_t nextBits() { return mixBits(state_ += 0x9e3779b97f4a7c15ull); }

    /// Uniform in [0, 1).
    float next() { return toUnitFloat(nextBits()); }
    Vec2 next2() {
        const float x = next();
        return {x, next()};
    }

  private:
    std::uint64_t state_;
};

/// i-th point of the R2 sequence (Roberts 2018: generalised golden ratio), shifted by `shift`
/// modulo 1. Low-discrepancy in the unit square.
inline Vec2 r2Point(std::uint32_t i, const Vec2& shift) {
    const double x = shift.x + 0.7548776662466927 * i;
    const double y = shift.y + 0.5698402909980532 * i;
    const Vec2 p(static_cast<float>(x - std::floor(x)), static_cast<float>(y - std::floor(y)));
    return {p.x < 1.0f ? p.x : 0.0f, p.y < 1.0f ? p.y : 0.0f};
}

}  // namespace vlf
