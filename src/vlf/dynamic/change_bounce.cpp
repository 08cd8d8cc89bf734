#include "vlf/dynamic/change_bounce.h"

#include "vlf/base/parallel.h"
#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

constexpr std::size_t kShotsPerBlock = 16;

/// Flux that a texel has to send, W, and by how many rays.
struct Shot {
    std::uint32_t texel;
    Vec3 flux;
    int rays;
};

/// Flux that has come to a texel.
struct Arrival {
    std::uint32_t texel;
    Vec3 flux;
};

float size(const Vec3& flux) {
    return luminance(glm::abs(flux));
}

/// The texels of the largest flux, those of less than half a ray left out. Returns all flux.
float dealRays(const RoomTexels& room, const Coverage& coverage,
               const std::vector<std::pair<std::uint32_t, Vec3>>& changes, int rays,
               std::vector<Shot>& shots) {
    shots.clear();
    float all = 0;
    for (const auto& [texel, change] : changes) {
        const Vec3 flux =
            room.reflectance[texel] * change * (room.area[texel] * coverage.uncovered(texel));
        shots.push_back({texel, flux, 0});
        all += size(flux);
    }
    if (all <= 0) shots.clear();
    for (Shot& shot : shots)
        shot.rays = static_cast<int>(std::lround(static_cast<float>(rays) * size(shot.flux) / all));
    std::erase_if(shots, [](const Shot& shot) { return shot.rays == 0; });
    return all;
}

void addRays(const Scene& scene, const RayScene& roomRays, const RoomTexels& room,
             const Coverage& coverage, const Shot& shot, std::vector<Ray>& rays) {
    const std::uint32_t entry = room.entryOf[shot.texel];
    const LightReceiver texel = texelReceiver(scene, room.unwrap, entry);
    const auto points = coverage.points(room, entry);
    const Vec2 shift = RandomStream(0, shot.texel).next2();
    for (int k = 0; k < shot.rays; ++k) {
        const SurfacePoint& p = points[static_cast<std::size_t>(k) % points.size()];
        const Vec3 normal = texel.side * geometricNormal(scene, p.triangle);
        rays.push_back({positionAt(scene, p.triangle, p.barycentric) + roomRays.epsilon() * normal,
                        frameFromNormal(normal).toWorld(sampleCosineHemisphere(
                            r2Point(static_cast<std::uint32_t>(k), shift)))});
    }
}

}  // namespace

void bounceChange(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                  const Coverage& coverage, const SightObjects& objects,
                  const BounceParams& params, RoomChange& change) {
    std::vector<std::pair<std::uint32_t, Vec3>> changes;
    for (const std::uint32_t t : change.texels) changes.emplace_back(t, change.change[t]);
    std::vector<Shot> shots;
    float first = 0;
    for (int bounce = 0; bounce < params.bounces; ++bounce) {
        const float flux = dealRays(room, coverage, changes, params.rays, shots);
        if (bounce == 0) first = flux;
        if (flux <= params.tolerance * first) return;
        const std::size_t blocks = (shots.size() + kShotsPerBlock - 1) / kShotsPerBlock;
        std::vector<std::vector<Arrival>> arrivals(blocks);
        parallelFor(blocks, 1, [&](std::size_t block) {
            std::vector<Ray> queue;
            std::vector<Vec3> carried;
            const std::size_t end = std::min(shots.size(), (block + 1) * kShotsPerBlock);
            for (std::size_t i = block * kShotsPerBlock; i < end; ++i) {
                addRays(scene, rays, room, coverage, shots[i], queue);
                carried.resize(queue.size(), shots[i].flux / static_cast<float>(shots[i].rays));
            }
            SightTracer tracer(scene, rays, room);
            tracer.setObjects(objects);
            for (const Sight& sight : tracer.trace(queue))
                if (sight.texel != kNoTexel && sight.covered)
                    arrivals[block].push_back({sight.texel, sight.throughput * carried[sight.ray]});
        });
        changes.clear();
        for (const std::vector<Arrival>& block : arrivals)
            for (const Arrival& a : block) {
                const float area = room.area[a.texel] * coverage.uncovered(a.texel);
                if (area <= 0) continue;
                change.add(a.texel, a.flux / area);
                changes.emplace_back(a.texel, a.flux / area);
            }
    }
}

}  // namespace vlf
