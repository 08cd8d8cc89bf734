#include "vlf/propagate/memory.h"

#include "vlf/base/error.h"
#include "vlf/unwrap/texel_size.h"

#include <cmath>
#include <cstdio>
#include <string>

namespace vlf {

namespace {

// Bytes, measured: per texel its points, accumulators and irradiances; per triangle its vertices,
// faces, adjacency and acceleration structure.
constexpr double kPerTexel = 620, kPerTriangle = 900, kBase = 60e6;
constexpr double kAtlasOverhead = 1.3;     // gutters, gaps, texels cut by edges
constexpr double kElementBytes = 6;        // RadianceElement
constexpr double kRadianceOverhead = 1.4;  // whole tiles, guard band; measured for m = 8

/// Elements of a radiance field: half of all directions see a side, at a mean cosine of one half.
double elements(const Scene& scene, MirrorKind kind, int lines, int cells) {
    double mirrors = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        if (scene.material(t).isMirror(kind)) mirrors += area(scene, t);
    const double cell = 2.0 * boundingSphere(scene).radius / (cells - 1);
    return 0.5 * lines * mirrors / (cell * cell);
}

double gibibytes(double bytes) {
    return bytes / (1024.0 * 1024 * 1024);
}

std::string text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.2g", value);
    return buffer;
}

}  // namespace

MemoryNeed predictMemory(const Scene& scene, const BakeParams& params) {
    const double texels =
        params.texelSize > 0 ? texelsNeeded(scene, params.texelSize) : params.texelBudget;
    MemoryNeed need;
    need.transport =
        static_cast<std::uint64_t>(kBase + kAtlasOverhead * kPerTexel * texels +
                                   kPerTriangle * static_cast<double>(scene.triangles.size()));
    const double count =
        elements(scene, MirrorKind::perfect, params.radianceDirections, params.radianceCells) +
        elements(scene, MirrorKind::rough, params.glossDirections, params.glossCells);
    need.radiance = static_cast<std::uint64_t>(kRadianceOverhead * kElementBytes * count);
    return need;
}

void requireMemory(const Scene& scene, const BakeParams& params, std::uint64_t bytes) {
    const MemoryNeed need = predictMemory(scene, params);
    if (need.total() <= bytes) return;
    const double limit = static_cast<double>(bytes);
    std::string advice;
    if (static_cast<double>(need.radiance) > 0.5 * limit) {
        const double scale = std::sqrt(0.4 * limit / static_cast<double>(need.radiance));
        advice +=
            " --radiance-cells " + std::to_string(static_cast<int>(params.radianceCells * scale)) +
            " --gloss-cells " + std::to_string(static_cast<int>(params.glossCells * scale));
    }
    if (static_cast<double>(need.transport) > 0.5 * limit) {
        const double size =
            params.texelSize > 0 ? params.texelSize : texelSizeForBudget(scene, params.texelBudget);
        advice += " --texel " +
                  text(size * std::sqrt(static_cast<double>(need.transport) / (0.4 * limit)));
    }
    throw InputError("this bake needs about " + text(gibibytes(static_cast<double>(need.total()))) +
                     " GiB, more than the " + text(gibibytes(limit)) + " GiB allowed: try" +
                     advice);
}

}  // namespace vlf
