#include "texel_gather.h"

#include "vlf/base/parallel.h"
#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/propagate/ray_gather.h"

#include <algorithm>

namespace vlf::bench {

namespace {

// Texels whose rays form packets, all of one direction: so many of a row, each kStride apart, so
// that neighbours have directions of their own and their noise can be told from their light.
constexpr std::size_t kPacket = 8, kStride = 3;
constexpr std::size_t kRunsPerTask = 10;
constexpr int kRaysAtOnce = 16;  // of each texel of a packet
constexpr float kMinThroughput = 1e-4f;

std::uint32_t texelAt(const Unwrap& unwrap, const Chart& chart, const Vec3& p) {
    const Vec2 t = chart.texelCoordinates(p);
    const auto x =
        static_cast<std::uint32_t>(std::clamp(t.x, 0.0f, static_cast<float>(chart.width) - 1.0f));
    const auto y =
        static_cast<std::uint32_t>(std::clamp(t.y, 0.0f, static_cast<float>(chart.height) - 1.0f));
    return (chart.y + y) * unwrap.atlasWidth + chart.x + x;
}

float fraction(float x) {
    return std::min(x - std::floor(x), 0.99999994f);
}

/// Point k of the n of Hammersley's set, shifted modulo 1. (The R2 sequence, which need not know n,
/// has 1.2 times its error here.)
Vec2 hammersleyPoint(int k, int n, const Vec2& shift) {
    float inverse = 0, digit = 0.5f;  // k with its binary digits behind the point, in reverse
    for (int rest = k; rest > 0; rest /= 2, digit /= 2)
        inverse += static_cast<float>(rest % 2) * digit;
    const float even = (static_cast<float>(k) + 0.5f) / static_cast<float>(n);
    return {fraction(even + shift.x), fraction(inverse + shift.y)};
}

}  // namespace

struct TexelGather::Path {
    std::uint32_t receiver;  // atlas index
    int reflections = 0;
    bool planarOnly = true;  // all of these so far
    Vec3 throughput{1};
};

/// A point of a texel from which rays leave.
struct TexelGather::Start {
    Vec3 origin, surface;  ///< just off the surface; its geometric normal on the texel's side
    Frame frame;           ///< about the shading normal

    /// Along `local`, in the frame; a direction below the surface is drawn again.
    Ray ray(const Vec3& local, RandomStream& random) const {
        Vec3 direction = frame.toWorld(local);
        while (glm::dot(direction, surface) <= 0)
            direction = frame.toWorld(sampleCosineHemisphere(random.next2()));
        return {origin, direction};
    }
};

struct TexelGather::Queue {
    std::vector<Path> paths;
    std::vector<Ray> rays;
    std::vector<Hit> hits;

    void add(const Path& path, const Ray& ray) {
        paths.push_back(path);
        rays.push_back(ray);
    }
    void clear() {
        paths.clear();
        rays.clear();
    }
};

TexelGather::TexelGather(const BakeState& state) : state_(state) {
    for (std::uint32_t t = 0; t < state.scene.triangles.size(); ++t)
        normals_.push_back(geometricNormal(state.scene, t));
}

std::vector<TexelGather::Start> TexelGather::startsOf(std::size_t texel) const {
    const Unwrap& unwrap = state_.unwrap;
    const std::uint32_t chart = unwrap.texelChart[texel];
    std::vector<Start> starts;
    for (const SurfacePoint& p : unwrap.points.of(texel)) {
        const bool front = unwrap.triangleCharts[p.triangle].front == chart;
        const Vec3 surface = normals_[p.triangle] * (front ? 1.0f : -1.0f);
        Vec3 normal = shadingNormalAt(state_.scene, p.triangle, p.barycentric);
        if (glm::dot(normal, surface) < 0) normal = -normal;
        starts.push_back(
            {positionAt(state_.scene, p.triangle, p.barycentric) + state_.rays.epsilon() * surface,
             surface, frameFromNormal(normal)});
    }
    return starts;
}

void TexelGather::gather(const TexelBuffer& radiance, int count, std::uint64_t seed,
                         TexelBuffer& gathered) const {
    constexpr std::size_t kRun = kPacket * kStride;
    const std::size_t runs = (state_.unwrap.texels.size() + kRun - 1) / kRun;
    parallelFor(runs, kRunsPerTask, [&](std::size_t run) {
        for (std::size_t i = 0; i < kStride; ++i)
            gatherPacket(run * kRun + i, count, seed, radiance, gathered);
    });
}

/// Of every kStride-th texel from `first` on.
void TexelGather::gatherPacket(std::size_t first, int count, std::uint64_t seed,
                               const TexelBuffer& radiance, TexelBuffer& gathered) const {
    RandomStream random(seed, first);
    const Vec2 shift = random.next2();
    std::vector<std::uint32_t> texels;
    std::vector<std::vector<Start>> starts;
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
        const std::size_t i = first + lane * kStride;
        if (i >= state_.unwrap.texels.size()) break;
        texels.push_back(state_.unwrap.texels[i]);
        starts.push_back(startsOf(i));
    }
    Queue queue;
    for (int k = 0; k < count; ++k) {
        const Vec3 local = sampleCosineHemisphere(hammersleyPoint(k, count, shift));
        const auto point = static_cast<std::uint32_t>(random.nextBits());
        for (std::size_t lane = 0; lane < texels.size(); ++lane) {
            const std::vector<Start>& from = starts[lane];
            const Start& start = from[point % static_cast<std::uint32_t>(from.size())];
            queue.add({texels[lane]}, start.ray(local, random));
        }
        if (k % kRaysAtOnce == kRaysAtOnce - 1 || k == count - 1) trace(queue, radiance, gathered);
    }
}

/// Follows the queue's paths to their ends, and empties it.
void TexelGather::trace(Queue& queue, const TexelBuffer& radiance, TexelBuffer& gathered) const {
    Queue reflected;
    while (!queue.rays.empty()) {
        queue.hits.resize(queue.rays.size());
        state_.rays.closest(queue.rays, queue.hits);
        for (std::size_t i = 0; i < queue.hits.size(); ++i)
            arrive(queue.paths[i], queue.rays[i], queue.hits[i], radiance, gathered, reflected);
        std::swap(queue, reflected);
        reflected.clear();
    }
}

void TexelGather::arrive(const Path& path, const Ray& ray, const Hit& hit,
                         const TexelBuffer& radiance, TexelBuffer& gathered,
                         Queue& reflected) const {
    const float counts = path.reflections == 0 ? 1.0f : 0.0f;
    if (!hit) return gathered.add(path.receiver, Vec3(0), counts);
    const bool front = glm::dot(normals_[hit.triangle], ray.direction) < 0;
    const TriangleCharts& charts = state_.unwrap.triangleCharts[hit.triangle];
    const std::uint32_t chart = front ? charts.front : charts.back;
    if (chart == kNoChart) return;
    const Vec3 position = ray.origin + hit.t * ray.direction;
    const std::uint32_t texel = texelAt(state_.unwrap, state_.unwrap.charts[chart], position);
    if (path.reflections == 0 && radiance.weight(texel) <= 0) return;
    const Vec3 seen = radiance.rgb(texel) + emissionSeen(path, hit, front);
    gathered.add(path.receiver, path.throughput * seen, counts);
    if (path.reflections < kMaxReflections && state_.scene.material(hit.triangle).isMirror())
        reflect(path, ray, hit, front, reflected);
}

/// What the direct light does not hold already.
Vec3 TexelGather::emissionSeen(const Path& path, const Hit& hit, bool front) const {
    if (state_.sources.covers(path.reflections, path.planarOnly)) return Vec3(0);
    const Material& material = state_.scene.material(hit.triangle);
    if (!material.isEmitter() || !(front || material.emitsBothSides)) return Vec3(0);
    return emittedRadiance(state_.scene, material,
                           uvAt(state_.scene, hit.triangle, hit.barycentric));
}

void TexelGather::reflect(Path path, const Ray& ray, const Hit& hit, bool front,
                          Queue& reflected) const {
    const Scene& scene = state_.scene;
    const TriangleCharts& charts = state_.unwrap.triangleCharts[hit.triangle];
    const bool planar = state_.sources.planarMirror[front ? charts.front : charts.back] != 0;
    path.throughput *= mirrorReflectance(scene, scene.material(hit.triangle),
                                         uvAt(scene, hit.triangle, hit.barycentric));
    path.planarOnly = path.planarOnly && planar;
    ++path.reflections;
    const Vec3 side = normals_[hit.triangle] * (front ? 1.0f : -1.0f);
    Vec3 normal = planar ? side : shadingNormalAt(scene, hit.triangle, hit.barycentric);
    if (glm::dot(normal, side) < 0) normal = -normal;
    const Vec3 direction = glm::reflect(ray.direction, normal);
    if (glm::dot(direction, side) <= 0 || maxComponent(path.throughput) < kMinThroughput) return;
    const Vec3 position = ray.origin + hit.t * ray.direction;
    reflected.add(path, {position + state_.rays.epsilon() * side, direction});
}

}  // namespace vlf::bench
