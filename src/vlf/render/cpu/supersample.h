#pragma once
// Antialiased pictures from anything that gives rays a colour.

#include "vlf/base/progress.h"
#include "vlf/image/image.h"
#include "vlf/render/cpu/camera_rays.h"

#include <cstdint>
#include <functional>
#include <span>

namespace vlf {

/// Gives each camera ray a colour and returns how many rays it traced for that; `perPixel` rays in
/// a row are of one pixel. Called from several threads; a colour must depend on the rays of its
/// pixel alone.
using RayShader =
    std::function<std::uint64_t(std::span<const Ray> rays, int perPixel, std::span<Vec3> colors)>;

/// Point i of n x n within a pixel, in [0, 1]², down and to the right. No two share a row or column
/// of the finest grid, so that edges of any slope are met in n² steps [A. Kensler, Correlated
/// multi-jittered sampling, 2013, fig. 1].
inline Vec2 samplePoint(int i, int n) {
    const int column = i % n, row = i / n;
    return {(column + (row + 0.5f) / n) / n, (row + (column + 0.5f) / n) / n};
}

/// Means over square pixels of up to n x n rays, n in [1, 16]: every pixel gets the smaller of n
/// and 2 a side, and n a side where these or the neighbouring pixels differ by more than a few per
/// cent. `traced` is the number of rays that `shade` reported. Throws Cancelled.
/// [D. Mitchell, Generating antialiased images at low sampling densities, SIGGRAPH 1987]
Image supersample(const CameraRays& camera, int width, int height, int n, const RayShader& shade,
                  Progress& progress, std::uint64_t& traced);

}  // namespace vlf
