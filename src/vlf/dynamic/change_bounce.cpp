#include "vlf/dynamic/change_bounce.h"

#include "vlf/base/parallel.h"
#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

constexpr std::size_t kRaysPerBlock = 256;

float size(const Vec3& flux) {
    return luminance(glm::abs(flux));
}

}  // namespace

/// Rays in proportion to flux; texels of less than half a ray send nothing.
void ChangeBounce::deal(std::span<const TexelChange> sources, const RoomTexels& room,
                        const Coverage& coverage, int rays) {
    shots_.clear();
    float all = 0;
    for (const auto& [texel, change] : sources) {
        const float area = room.area[texel] * coverage.uncovered(texel);
        shots_.push_back({texel, room.reflectance[texel] * change * area, 0});
        all += size(shots_.back().flux);
    }
    const float perRay = all / static_cast<float>(rays);
    for (Shot& shot : shots_)
        if (perRay > 0) shot.rays = static_cast<int>(std::lround(size(shot.flux) / perRay));
    std::erase_if(shots_, [](const Shot& shot) { return shot.rays == 0; });
}

void ChangeBounce::aim(const Shot& shot, const Scene& scene, float epsilon, const RoomTexels& room,
                       const Coverage& coverage) {
    const std::uint32_t entry = room.entryOf[shot.texel];
    const std::span<const SurfacePoint> points = coverage.points(room, entry);
    const std::uint32_t chart = room.unwrap.texelChart[entry];
    const Vec2 shift = RandomStream(0, shot.texel).next2();
    for (int k = 0; k < shot.rays; ++k) {
        const SurfacePoint& p = points[static_cast<std::size_t>(k) % points.size()];
        const RoomTriangle& triangle = room.triangles[p.triangle];
        const float side = triangle.charts.front == chart ? 1.0f : -1.0f;
        const Vec3 normal = side * glm::normalize(triangle.areaVector);
        rays_.push_back({positionAt(scene, p.triangle, p.barycentric) + epsilon * normal,
                         frameFromNormal(normal).toWorld(sampleCosineHemisphere(
                             r2Point(static_cast<std::uint32_t>(k), shift)))});
        carried_.push_back(shot.flux / static_cast<float>(shot.rays));
    }
}

void ChangeBounce::shoot(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                         const SightObjects& objects) {
    const std::size_t blocks = (rays_.size() + kRaysPerBlock - 1) / kRaysPerBlock;
    if (arrivals_.size() < blocks) arrivals_.resize(blocks);
    for (std::vector<Arrival>& block : arrivals_) block.clear();
    parallelFor(blocks, 1, [&](std::size_t block) {
        const std::size_t first = block * kRaysPerBlock;
        const std::size_t count = std::min(kRaysPerBlock, rays_.size() - first);
        SightTracer tracer(scene, rays, room);
        tracer.setObjects(objects);
        thread_local Sights sights;
        tracer.trace({rays_.data() + first, count}, sights);
        for (std::size_t i = 0; i < count; ++i)
            if (sights.texel[i] != kNoTexel)
                arrivals_[block].push_back({sights.texel[i], carried_[first + i]});
        for (const Sight& sight : sights.others)
            if (sight.texel != kNoTexel && sight.covered)
                arrivals_[block].push_back(
                    {sight.texel, sight.throughput * carried_[first + sight.ray]});
    });
}

void ChangeBounce::add(std::span<const TexelChange> sources, const Scene& scene,
                       const RayScene& rays, const RoomTexels& room, const Coverage& coverage,
                       const SightObjects& objects, const BounceParams& params,
                       RoomChange& change) {
    for (int bounce = 0; bounce < params.bounces; ++bounce) {
        deal(bounce == 0 ? sources : std::span<const TexelChange>(next_), room, coverage,
             params.rays);
        rays_.clear(), carried_.clear(), next_.clear();
        for (const Shot& shot : shots_) aim(shot, scene, rays.epsilon(), room, coverage);
        shoot(scene, rays, room, objects);
        for (const std::vector<Arrival>& block : arrivals_)
            for (const Arrival& a : block) {
                const float area = room.area[a.texel] * coverage.uncovered(a.texel);
                if (area <= 0) continue;
                next_.push_back({a.texel, a.flux / area});
                change.add(a.texel, a.flux / area);
            }
    }
}

}  // namespace vlf
