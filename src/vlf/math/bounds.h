#pragma once
// Axis-aligned box and bounding sphere.

#include "vlf/math/vector.h"

#include <glm/common.hpp>

#include <limits>

namespace vlf {

/// Axis-aligned box; empty (lower > upper) until something is added.
struct Bounds {
    Vec3 lower{std::numeric_limits<float>::max()};
    Vec3 upper{std::numeric_limits<float>::lowest()};

    void add(const Vec3& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    bool empty() const { return lower.x > upper.x; }
    Vec3 centre() const { return 0.5f * (lower + upper); }
    Vec3 size() const { return empty() ? Vec3(0) : upper - lower; }
};

}  // namespace vlf
