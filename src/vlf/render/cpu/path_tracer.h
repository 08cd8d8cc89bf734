#pragma once
// Pictures by path tracing, with their own measure of noise.

#include "vlf/base/progress.h"
#include "vlf/image/image.h"
#include "vlf/render/cpu/path_integrator.h"

#include <chrono>
#include <cstdint>
#include <vector>

namespace vlf {

struct PathTraceParams {
    Camera camera;
    int width = 640, height = 480;  ///< pixels
    int samplesPerPixel = 64;       ///< at most; 0: no limit
    double targetError = 0;         ///< stop once relativeError() is at most this; 0: never
    double maxSeconds = 0;          ///< stop after this time; 0: never
    std::uint64_t seed = 0;
    PathOptions paths;
};

/// Running sums over the samples of each pixel, row-major, row 0 at the top. Pixels may differ in
/// their number of samples after an interruption.
struct PathTraceState {
    int width = 0, height = 0;
    std::vector<std::uint32_t> samples;
    std::vector<glm::dvec3> sum;           ///< of radiance
    std::vector<glm::dvec3> sumOfSquares;  ///< of radiance, per channel
};

PathTraceState makePathTraceState(int width, int height);

/// Adds `count` samples to every pixel: a box filter of one pixel, random numbers keyed by seed,
/// pixel and sample, so that n + m samples are the same picture as n and then m, with any number of
/// threads. Stops early, with some pixels left out, when progress is cancelled or `deadline`
/// passes. Throws InputError if params.camera has no view.
void traceSamples(
    PathTraceState& state, const PathIntegrator& integrator, const PathTraceParams& params,
    int count, Progress& progress,
    std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max());

/// Mean radiance per pixel, W·m⁻²·sr⁻¹; black where there is no sample.
Image meanImage(const PathTraceState& state);

/// Variance of meanImage(), estimated from the spread of each pixel's samples (the square of its
/// standard error); 0 where there are fewer than two samples.
Image varianceOfMean(const PathTraceState& state);

/// Expected relative error of the picture through noise: the root of the mean of
/// variance / (mean² + 0.01) over pixels and channels, which is what the root of relMSE against the
/// noiseless picture would be. Infinite before every pixel has two samples.
double relativeError(const PathTraceState& state);

enum class PathTraceStop { samples, error, time, cancelled };

struct PathTraceResult {
    Image image;
    Image variance;              ///< of the mean
    double samplesPerPixel = 0;  ///< mean over the picture
    double relativeError = 0;
    double seconds = 0;
    PathTraceStop stop = PathTraceStop::samples;  ///< why it ended
};

/// Traces until the first of the limits in params is reached or progress is cancelled; what has
/// been traced by then is returned in every case. Throws InputError if the camera has no view or no
/// limit is set.
PathTraceResult pathTrace(const Scene& scene, const RayScene& rays, const PathTraceParams& params,
                          Progress& progress);

}  // namespace vlf
