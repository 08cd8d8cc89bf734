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
constexpr double kPortion = 2.5e-8;  // of the room's flux, that a ray carries
constexpr double kFewestRays = 1024, kMostRays = 32768;
/// From this far on, in radii of a group, what arrives at one of its texels counts for them all:
/// few rays would make single far texels flicker.
constexpr float kFar = 5;
constexpr float kSpread = 0.12f;

float size(const Vec3& flux) {
    return maxComponent(glm::abs(flux));  // a ray of any colour carries no more than another
}

Vec3 fluxOf(const RoomChange& change, std::uint32_t texel, const RoomTexels& room,
            const Coverage& coverage) {
    return room.reflectance[texel] * change.of(texel) *
           (room.area[texel] * coverage.uncovered(texel));
}

}  // namespace

/// Systematic sampling: along the texels one after the other a ray for every portion of flux.
void ChangeBounce::aim(const RoomChange& change, const Scene& scene, float epsilon,
                       const RoomTexels& room, const Coverage& coverage, float roomFlux) {
    rays_.clear(), carried_.clear(), flux_.clear();
    double all = 0;
    for (const std::uint32_t t : change.texels()) {
        flux_.push_back(fluxOf(change, t, room, coverage));
        all += size(flux_.back());
    }
    if (all <= 0) return;
    const double portion =
        std::clamp<double>(kPortion * roomFlux, all / kMostRays, all / kFewestRays);
    double passed = 0.5 * portion;
    for (std::size_t i = 0; i < flux_.size(); ++i) {
        const Vec3& flux = flux_[i];
        if (flux == Vec3(0)) continue;
        passed += size(flux);
        const auto count = static_cast<int>(passed / portion);
        if (count == 0) continue;
        passed -= count * portion;
        const std::uint32_t t = change.texels()[i];
        const std::uint32_t entry = room.entryOf[t];
        const std::span<const SurfacePoint> points = coverage.points(room, entry);
        if (points.empty()) continue;
        const Vec3 carried = flux * static_cast<float>(portion / size(flux));
        const Vec2 shift = RandomStream(0, t).next2();
        for (int k = 0; k < count; ++k) {
            const SurfacePoint& p = points[static_cast<std::size_t>(k) % points.size()];
            const RoomTriangle& triangle = room.triangles[p.triangle];
            const bool front = triangle.charts.front == room.unwrap.texelChart[entry];
            const Vec3 normal = glm::normalize(front ? triangle.areaVector : -triangle.areaVector);
            rays_.push_back({positionAt(scene, p.triangle, p.barycentric) + epsilon * normal,
                             frameFromNormal(normal).toWorld(sampleCosineHemisphere(
                                 r2Point(static_cast<std::uint32_t>(k), shift)))});
            carried_.push_back(carried);
        }
    }
}

void ChangeBounce::shoot(const Scene& scene, const RayScene& roomRays, const RoomTexels& room,
                         const SightObjects& objects) {
    const std::size_t blocks = (rays_.size() + kRaysPerBlock - 1) / kRaysPerBlock;
    if (arrivals_.size() < blocks) arrivals_.resize(blocks);
    for (std::vector<Arrival>& block : arrivals_) block.clear();
    parallelFor(blocks, 1, [&](std::size_t block) {
        const std::size_t first = block * kRaysPerBlock;
        const std::size_t count = std::min(kRaysPerBlock, rays_.size() - first);
        SightTracer tracer(scene, roomRays, room);
        tracer.setObjects(objects);
        thread_local Sights sights;
        tracer.trace({rays_.data() + first, count}, sights);
        for (std::size_t i = 0; i < count; ++i)
            if (sights.texel[i] != kNoTexel)
                arrivals_[block].push_back(
                    {sights.texel[i], sights.distance[i], carried_[first + i]});
        for (const Sight& sight : sights.others)
            if (sight.texel != kNoTexel && sight.covered)
                arrivals_[block].push_back(
                    {sight.texel, sight.distance, sight.throughput * carried_[first + sight.ray]});
    });
}

/// Over a square of texels around the one it has come to that is as wide as rays lie apart there.
void ChangeBounce::spread(const Arrival& arrival, const RoomTexels& room,
                          const Coverage& coverage) {
    const Unwrap& unwrap = room.unwrap;
    const Chart& chart = unwrap.charts[unwrap.texelChart[room.entryOf[arrival.texel]]];
    const int reach = static_cast<int>(kSpread * arrival.distance / chart.texelSize());
    const auto x = static_cast<int>(arrival.texel % unwrap.atlasWidth - chart.x);
    const auto y = static_cast<int>(arrival.texel / unwrap.atlasWidth - chart.y);
    square_.clear();
    float area = 0;
    for (int v = std::max(0, y - reach); v <= std::min<int>(chart.height - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min<int>(chart.width - 1, x + reach); ++u) {
            const std::uint32_t t = (chart.y + v) * unwrap.atlasWidth + chart.x + u;
            const float seen = room.area[t] * coverage.uncovered(t);
            if (seen <= 0) continue;
            area += seen;
            square_.push_back(t);
        }
    for (const std::uint32_t t : square_) near_.push_back({t, arrival.flux / area});
}

void ChangeBounce::collect(const RoomTexels& room, const Coverage& coverage) {
    Vec3 again(0);
    for (const std::vector<Arrival>& block : arrivals_)
        for (const Arrival& a : block) {
            again += room.reflectance[a.texel] * a.flux;
            const std::uint32_t g = room.groupOf[a.texel];
            const TexelGroup& group = room.groups[g];
            if (a.distance > kFar * group.bounds.radius) {
                if (!std::exchange(groupListed_[g], 1)) changedGroups_.push_back(g);
                groups_[g] += a.flux / group.area;
                continue;
            }
            spread(a, room, coverage);
        }
    ambient_ = room.totalArea > 0 ? again * room.gain() / room.totalArea : Vec3(0);
}

void ChangeBounce::clear() {
    for (const std::uint32_t g : changedGroups_) groups_[g] = Vec3(0), groupListed_[g] = 0;
    changedGroups_.clear();
    near_.clear();
    ambient_ = Vec3(0);
}

void ChangeBounce::find(const RoomChange& change, const Scene& scene, const RayScene& roomRays,
                        const RoomTexels& room, const Coverage& coverage,
                        const SightObjects& objects, float roomFlux) {
    groups_.resize(room.groups.size(), Vec3(0));
    groupListed_.resize(room.groups.size(), 0);
    clear();
    aim(change, scene, roomRays.epsilon(), room, coverage, roomFlux);
    shoot(scene, roomRays, room, objects);
    collect(room, coverage);
}

void ChangeBounce::addTo(RoomChange& change, float leastAmbient) const {
    for (const TexelChange& t : near_) change.add(t.texel, t.irradiance);
    for (const std::uint32_t g : changedGroups_) change.addToGroup(g, groups_[g]);
    if (size(ambient_) > leastAmbient) change.addToAll(ambient_);
}

}  // namespace vlf
