#pragma once
// How large a scene may be.

#include "vlf/base/error.h"

#include <fmt/format.h>

#include <cstddef>

namespace vlf {

/// Most triangles of a scene.
inline constexpr std::size_t kMaxTriangles = std::size_t{1} << 25;

/// Largest coordinate in metres: beyond it areas overflow single precision.
inline constexpr float kMaxCoordinate = 1e9;

/// Throws InputError if a scene of `count` triangles read from `path` would be too large.
inline void checkTriangleCount(std::size_t count, const std::string& path) {
    if (count > kMaxTriangles)
        throw InputError({path, 0, ""}, fmt::format("{} triangles; at most {} are supported", count,
                                                    kMaxTriangles));
}

}  // namespace vlf
