#include "vlf/render/cpu/texel_reference.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"

#include <algorithm>

namespace vlf {

namespace {

/// Samples between two reports of progress, roughly.
constexpr std::size_t kSamplesPerPass = 1 << 20;
constexpr int kSamplesPerCheck = 256;  // whether it is cancelled

IrradianceEstimate summarise(const glm::dvec3& sum, const glm::dvec3& sumOfSquares,
                             std::uint32_t samples) {
    if (samples == 0) return {};
    const double n = samples;
    const glm::dvec3 mean = sum / n;
    const glm::dvec3 variance = glm::max(sumOfSquares / n - mean * mean, 0.0);
    return {Vec3(mean), Vec3(glm::sqrt(variance / std::max(n - 1, 1.0))), samples};
}

IrradianceEstimate estimateTexel(const PathIntegrator& integrator, TexelArea points,
                                 std::size_t texel, const SideIsOpen& isOpen,
                                 const IrradianceParams& params, const Progress& progress) {
    if (points.empty()) return {};
    glm::dvec3 sum(0), sumOfSquares(0);
    std::uint32_t samples = 0;
    for (int i = 0; i < params.samplesPerTexel; ++i) {
        if (i % kSamplesPerCheck == 0) progress.check();
        RandomStream random(params.seed, (std::uint64_t(texel) << 32) | std::uint32_t(i));
        const SidePoint& point = points[random.nextBits() % points.size()];
        const std::optional<Vec3> irradiance = integrator.irradiance(point, isOpen, random);
        if (!irradiance) continue;
        const glm::dvec3 value(*irradiance);
        sum += value;
        sumOfSquares += value * value;
        ++samples;
    }
    return summarise(sum, sumOfSquares, samples);
}

void requirePoints(const Scene& scene, std::span<const TexelArea> texels) {
    for (const TexelArea points : texels)
        for (const SidePoint& point : points)
            if (point.triangle >= scene.triangles.size())
                throw InputError("a texel names triangle " + std::to_string(point.triangle) +
                                 ", but the scene has " + std::to_string(scene.triangles.size()));
}

}  // namespace

std::vector<IrradianceEstimate> estimateIrradiance(const Scene& scene, const RayScene& rays,
                                                   std::span<const TexelArea> texels,
                                                   const SideIsOpen& isOpen,
                                                   const IrradianceParams& params,
                                                   Progress& progress) {
    if (params.samplesPerTexel < 1) throw InputError("samples per texel must be at least 1");
    requirePoints(scene, texels);
    const PathIntegrator integrator(scene, rays, params.paths);
    std::vector<IrradianceEstimate> estimates(texels.size());
    const std::size_t pass = 1 + kSamplesPerPass / static_cast<std::size_t>(params.samplesPerTexel);
    progress.stage("path tracing texels");
    for (std::size_t begin = 0; begin < texels.size(); begin += pass) {
        parallelFor(std::min(pass, texels.size() - begin), [&](std::size_t i) {
            const std::size_t texel = begin + i;
            estimates[texel] =
                estimateTexel(integrator, texels[texel], texel, isOpen, params, progress);
        });
        progress.check();
        progress.update(double(std::min(begin + pass, texels.size())) / double(texels.size()));
    }
    return estimates;
}

}  // namespace vlf
