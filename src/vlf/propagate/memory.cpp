#include "vlf/propagate/memory.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/unwrap/texel_size.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace vlf {

namespace {

// Bytes, measured: of the program; per triangle its vertices, faces, adjacency and acceleration
// structure; per atlas entry its points, accumulators and irradiances; per ray of a bundle the
// layers that it meets.
constexpr double kBase = 12e6, kPerTriangle = 255, kPerTexel = 420, kPerRay = 140;
constexpr double kPerTexelRefined = 160;    // accumulators that are kept as they are
constexpr double kPerSkyPixel = 36;         // itself, and twice what chooses by its brightness
constexpr double kAtlasOverhead = 1.6;      // gutters, gaps, texels cut by edges
constexpr double kRadianceOverhead = 1.25;  // whole tiles, guard band; measured for m = 4

/// What memory grows with.
struct BakeSize {
    double triangles, textureBytes, texels;
    MirrorElements elements;
    int cells;
    bool refined;
    std::array<const ScratchPlace*, 2> scratch;  // of the two radiance fields
    double rowBytes = 0;                         // of both, which are in memory always
};

MemoryNeed needOf(const BakeSize& size) {
    const double rays = static_cast<double>(size.cells) * size.cells * threadCount();
    const double transport = kBase + size.textureBytes + kPerTriangle * size.triangles +
                             (kPerTexel + (size.refined ? kPerTexelRefined : 0)) * size.texels +
                             kPerRay * rays + size.rowBytes;
    MemoryNeed need{.transport = static_cast<std::uint64_t>(transport)};
    const std::array<double, 2> elements{size.elements.perfect, size.elements.rough};
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto bytes = static_cast<std::uint64_t>(sizeof(RadianceElement) * elements[i]);
        const bool inFile = size.scratch[i] && bytes > size.scratch[i]->largest;
        (inFile ? need.scratch : need.radiance) += bytes;
    }
    return need;
}

double textureBytes(const Scene& scene) {
    double bytes = 0;
    for (const Texture& texture : scene.textures)
        bytes += static_cast<double>(texture.srgb8.size() + sizeof(Vec3) * texture.linear.size());
    bytes += kPerSkyPixel * static_cast<double>(scene.environment.picture.pixels.size());
    return bytes;
}

/// Elements of a radiance field: half of all directions see a side, at a mean cosine of one half.
double elements(const Scene& scene, MirrorKind kind, int lines, int cells) {
    double mirrors = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        if (scene.material(t).isSpecular(kind))
            mirrors += (scene.material(t).isPane() ? 2 : 1) * area(scene, t);
    const double cell = 2.0 * boundingSphere(scene).radius / (cells - 1);
    return kRadianceOverhead * 0.5 * lines * mirrors / (cell * cell);
}

double gibibytes(double bytes) {
    return bytes / (1024.0 * 1024 * 1024);
}

std::string text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.2g", value);
    return buffer;
}

void require(const MemoryNeed& need, const BakeParams& params, float texelSize,
             std::uint64_t bytes) {
    if (need.total() <= bytes) return;
    const double limit = static_cast<double>(bytes);
    std::string advice;
    if (static_cast<double>(need.radiance) > 0.5 * limit) {
        const double scale = std::sqrt(0.4 * limit / static_cast<double>(need.radiance));
        advice += " --radiance-cells " +
                  std::to_string(static_cast<int>(params.radianceCells * scale)) +
                  " --gloss-cells " + std::to_string(static_cast<int>(params.glossCells * scale));
    }
    if (static_cast<double>(need.transport) > 0.5 * limit)
        advice += " --texel " +
                  text(texelSize * std::sqrt(static_cast<double>(need.transport) / (0.4 * limit)));
    throw InputError("this bake needs about " + text(gibibytes(static_cast<double>(need.total()))) +
                     " GiB, more than the " + text(gibibytes(limit)) + " GiB allowed: try" +
                     advice);
}

}  // namespace

MirrorElements predictElements(const Scene& scene, const BakeParams& params) {
    return {elements(scene, MirrorKind::perfect, params.radianceDirections, params.radianceCells),
            elements(scene, MirrorKind::rough, params.glossDirections, params.glossCells)};
}

MemoryNeed predictMemory(const Scene& scene, const BakeParams& params,
                         const ScratchPlace* scratch) {
    const double texels =
        params.texelSize > 0 ? texelsNeeded(scene, params.texelSize) : params.texelBudget;
    return needOf({static_cast<double>(scene.triangles.size()),
                   textureBytes(scene),
                   kAtlasOverhead * texels,
                   predictElements(scene, params),
                   params.cells,
                   refines(params),
                   {scratch, scratch}});
}

MemoryNeed predictMemory(const BakeState& state) {
    const LightField field = unlitField(state);
    const auto [perfect, rough] = radianceParams(state.params);
    const auto scratchOf = [](const PartialRadiance& radiance) {
        return radiance.field.elements.get_allocator().place().get();
    };
    MirrorElements elements;
    double rowBytes = 0;
    for (const auto& [params, count] :
         {std::pair{perfect, &elements.perfect}, std::pair{rough, &elements.rough}}) {
        const RadianceSize size = estimateRadianceSize(state.scene, field, params);
        *count = static_cast<double>(size.elements);
        rowBytes += static_cast<double>(size.bytes - size.elements * sizeof(RadianceElement));
    }
    return needOf({static_cast<double>(state.scene.triangles.size()),
                   textureBytes(state.scene),
                   static_cast<double>(state.unwrap.atlasSize()),
                   elements,
                   state.params.cells,
                   refines(state.params),
                   {scratchOf(state.radiance), scratchOf(state.gloss)},
                   rowBytes});
}

void requireMemory(const Scene& scene, const BakeParams& params, std::uint64_t bytes,
                   const ScratchPlace* scratch) {
    const float texelSize =
        params.texelSize > 0 ? params.texelSize : texelSizeForBudget(scene, params.texelBudget);
    require(predictMemory(scene, params, scratch), params, texelSize, bytes);
}

void requireMemory(const BakeState& state, std::uint64_t bytes) {
    require(predictMemory(state), state.params, state.unwrap.texelSize, bytes);
}

}  // namespace vlf
