#include "vlf/render/cpu/path_tracer.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/render/cpu/camera_rays.h"

#include <algorithm>
#include <limits>

namespace vlf {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTile = 16;  ///< pixels

/// Paths between two reports of progress, roughly.
constexpr int kPathsPerPass = 1 << 20;

/// Fewer samples than this say too little about their own spread to stop by it.
constexpr int kMinSamplesToJudge = 16;

void tracePixel(PathTraceState& state, const PathIntegrator& integrator, const CameraRays& camera,
                std::uint64_t seed, std::size_t pixel, int count) {
    const int x = static_cast<int>(pixel % state.width), y = static_cast<int>(pixel / state.width);
    for (int i = 0; i < count; ++i) {
        RandomStream random(seed, (std::uint64_t(pixel) << 32) | state.samples[pixel]);
        const Vec2 offset = random.next2();
        const Ray ray = camera.ray(x + offset.x, y + offset.y);
        const glm::dvec3 radiance(integrator.radiance(ray, random));
        state.sum[pixel] += radiance;
        state.sumOfSquares[pixel] += radiance * radiance;
        ++state.samples[pixel];
    }
}

/// Unbiased estimate of the variance of the mean of n samples, from their sums.
glm::dvec3 varianceOfMean(const glm::dvec3& sum, const glm::dvec3& sumOfSquares, double n) {
    if (n < 2) return glm::dvec3(0);
    const glm::dvec3 mean = sum / n;
    return glm::max(sumOfSquares / n - mean * mean, 0.0) / (n - 1);
}

int fewestSamples(const PathTraceState& state) {
    return static_cast<int>(*std::min_element(state.samples.begin(), state.samples.end()));
}

void requireLimit(const PathTraceParams& params) {
    if (params.samplesPerPixel < 0 || !(params.targetError >= 0) || !(params.maxSeconds >= 0))
        throw InputError(
            "samples, error and seconds of a path-traced picture must not be negative");
    if (params.samplesPerPixel == 0 && params.targetError == 0 && params.maxSeconds == 0)
        throw InputError("a path-traced picture needs a limit: samples, error or seconds");
}

/// Samples of the next pass: few at first, so that small errors and times are met closely.
int passSize(const PathTraceParams& params, int done) {
    const int full = std::max(1, kPathsPerPass / std::max(1, params.width * params.height));
    const int pass = std::min(full, std::max(1, done));
    return params.samplesPerPixel > 0 ? std::min(pass, params.samplesPerPixel - done) : pass;
}

double fractionDone(const PathTraceParams& params, int samples, double seconds, double error) {
    double fraction = 0;
    if (params.samplesPerPixel > 0) fraction = double(samples) / params.samplesPerPixel;
    if (params.maxSeconds > 0) fraction = std::max(fraction, seconds / params.maxSeconds);
    // The error falls with the root of the number of samples.
    if (params.targetError > 0 && error > 0)
        fraction = std::max(fraction, std::pow(params.targetError / error, 2.0));
    return std::min(fraction, 1.0);
}

Clock::time_point deadlineOf(const PathTraceParams& params, Clock::time_point start) {
    // Beyond this many seconds, the clock's own range would be left.
    if (params.maxSeconds <= 0 || params.maxSeconds > 1e9) return Clock::time_point::max();
    return start + std::chrono::duration_cast<Clock::duration>(
                       std::chrono::duration<double>(params.maxSeconds));
}

PathTraceResult resultOf(const PathTraceState& state, double seconds, PathTraceStop stop) {
    PathTraceResult result{meanImage(state), varianceOfMean(state)};
    double samples = 0;
    for (const std::uint32_t n : state.samples) samples += n;
    result.samplesPerPixel = samples / static_cast<double>(state.samples.size());
    result.relativeError = relativeError(state);
    result.seconds = seconds;
    result.stop = stop;
    return result;
}

}  // namespace

PathTraceState makePathTraceState(int width, int height) {
    const std::size_t pixels = static_cast<std::size_t>(width) * height;
    return {width, height, std::vector<std::uint32_t>(pixels),
            std::vector<glm::dvec3>(pixels, glm::dvec3(0)),
            std::vector<glm::dvec3>(pixels, glm::dvec3(0))};
}

void traceSamples(PathTraceState& state, const PathIntegrator& integrator,
                  const PathTraceParams& params, int count, Progress& progress,
                  Clock::time_point deadline) {
    const CameraRays camera(params.camera, state.width, state.height);
    const int columns = (state.width + kTile - 1) / kTile;
    const int rows = (state.height + kTile - 1) / kTile;
    parallelFor(static_cast<std::size_t>(columns) * rows, [&](std::size_t tile) {
        const int x0 = kTile * static_cast<int>(tile % columns);
        const int y0 = kTile * static_cast<int>(tile / columns);
        for (int y = y0; y < std::min(y0 + kTile, state.height); ++y) {
            if (progress.cancelled() || Clock::now() >= deadline) return;
            for (int x = x0; x < std::min(x0 + kTile, state.width); ++x)
                tracePixel(state, integrator, camera, params.seed,
                           static_cast<std::size_t>(y) * state.width + x, count);
        }
    });
}

Image meanImage(const PathTraceState& state) {
    Image image(state.width, state.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = Vec3(state.sum[i] / std::max(1.0, double(state.samples[i])));
    return image;
}

Image varianceOfMean(const PathTraceState& state) {
    Image image(state.width, state.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] =
            Vec3(varianceOfMean(state.sum[i], state.sumOfSquares[i], state.samples[i]));
    return image;
}

double relativeError(const PathTraceState& state) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < state.sum.size(); ++i) {
        const double n = state.samples[i];
        if (n < 2) return std::numeric_limits<double>::infinity();
        const glm::dvec3 mean = state.sum[i] / n;
        sum += varianceOfMean(state.sum[i], state.sumOfSquares[i], n) / (mean * mean + 0.01);
    }
    return std::sqrt((sum.x + sum.y + sum.z) / (3.0 * static_cast<double>(state.sum.size())));
}

PathTraceResult pathTrace(const Scene& scene, const RayScene& rays, const PathTraceParams& params,
                          Progress& progress) {
    requireLimit(params);
    const PathIntegrator integrator(scene, rays, params.paths);
    PathTraceState state = makePathTraceState(params.width, params.height);
    const Clock::time_point start = Clock::now(), deadline = deadlineOf(params, start);
    const auto elapsed = [&] {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    progress.stage("path tracing");
    for (int done = 0;; done = fewestSamples(state)) {
        const double error = done > 0 && params.targetError > 0 ? relativeError(state) : 0;
        progress.update(fractionDone(params, done, elapsed(), error));
        const auto stop = [&](PathTraceStop why) { return resultOf(state, elapsed(), why); };
        if (progress.cancelled()) return stop(PathTraceStop::cancelled);
        if (params.samplesPerPixel > 0 && done >= params.samplesPerPixel)
            return stop(PathTraceStop::samples);
        if (params.targetError > 0 && done >= kMinSamplesToJudge && error <= params.targetError)
            return stop(PathTraceStop::error);
        if (Clock::now() >= deadline) return stop(PathTraceStop::time);
        traceSamples(state, integrator, params, passSize(params, done), progress, deadline);
    }
}

}  // namespace vlf
