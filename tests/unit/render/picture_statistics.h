#pragma once
// Means of pictures and how far they are, in standard errors, from what they should be.

#include "vlf/render/cpu/path_tracer.h"

#include <cmath>

namespace vlf::test {

/// Beyond this many standard errors a correct estimator falls once in 16 000 tries.
inline constexpr double kMaxZ = 4;

struct MeanWithError {
    glm::dvec3 mean{0}, standardError{0};
};

/// Mean over the pixels of a picture with the error its own variance predicts.
inline MeanWithError pictureMean(const PathTraceResult& result) {
    const double n = static_cast<double>(result.image.pixels.size());
    glm::dvec3 sum(0), variance(0);
    for (const Vec3& p : result.image.pixels) sum += glm::dvec3(p);
    for (const Vec3& v : result.variance.pixels) variance += glm::dvec3(v);
    return {sum / n, glm::sqrt(variance) / n};
}

/// Largest |z| over the channels of a mean against the truth.
inline double largestZ(const MeanWithError& a, const glm::dvec3& truth) {
    const glm::dvec3 z = glm::abs(a.mean - truth) / a.standardError;
    return std::max(z.x, std::max(z.y, z.z));
}

/// Largest |z| over the channels of the difference of two independent means.
inline double largestZ(const MeanWithError& a, const MeanWithError& b) {
    const glm::dvec3 error =
        glm::sqrt(a.standardError * a.standardError + b.standardError * b.standardError);
    return largestZ({a.mean - b.mean, error}, glm::dvec3(0));
}

inline double relativeStandardError(const MeanWithError& a) {
    const glm::dvec3 e = a.standardError / a.mean;
    return std::max(e.x, std::max(e.y, e.z));
}

/// A picture from the scene's first camera.
inline PathTraceResult trace(const Scene& scene, int width, int height, int samples,
                             const PathOptions& paths = {}, std::uint64_t seed = 1) {
    PathTraceParams params;
    params.camera = scene.cameras.front();
    params.width = width;
    params.height = height;
    params.samplesPerPixel = samples;
    params.seed = seed;
    params.paths = paths;
    Progress progress;
    return pathTrace(scene, RayScene(scene), params, progress);
}

}  // namespace vlf::test
