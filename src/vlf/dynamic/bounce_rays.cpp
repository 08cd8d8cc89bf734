#include "vlf/dynamic/bounce_rays.h"

#include "vlf/base/parallel.h"
#include "vlf/dynamic/sight.h"
#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <algorithm>
#include <bit>

namespace vlf {

namespace {

constexpr std::size_t kMostRays = 1u << 21;  // in all
constexpr std::size_t kFewest = 32, kMost = 256;
constexpr std::size_t kGroupsPerBlock = 16;
/// From this far on, in radii of a group, what arrives at one of its texels counts for them all,
/// and where rays lie farther apart than this many texels, for a block of them.
constexpr float kFar = 5;
constexpr int kSquare = 2;
constexpr float kSpread = 0.6f;

/// i's bits (of `count`, a power of two) in reverse, as a fraction of one.
float reversed(std::uint32_t i) {
    std::uint32_t result = 0;
    for (int bit = 0; bit < 16; ++bit) result |= (i >> bit & 1) << (15 - bit);
    return static_cast<float>(result) / 65536.0f;
}

/// Entry of unwrap.texels that ray i of a group starts from.
std::uint32_t startOf(const RoomTexels& room, const TexelGroup& group, std::uint32_t i) {
    const auto k = static_cast<std::uint32_t>(reversed(i) * static_cast<float>(group.count));
    return room.grouped[group.first + std::min(k, group.count - 1)];
}

Ray rayFrom(const Scene& scene, const RoomTexels& room, float epsilon, std::uint32_t entry,
            std::uint32_t i, const Vec2& shift) {
    const auto points = room.unwrap.points.of(entry);
    const SurfacePoint& p = points[(i * 7) % points.size()];
    const RoomTriangle& triangle = room.triangles[p.triangle];
    const bool front = triangle.charts.front == room.unwrap.texelChart[entry];
    const Vec3 normal = glm::normalize(front ? triangle.areaVector : -triangle.areaVector);
    return {positionAt(scene, p.triangle, p.barycentric) + epsilon * normal,
            frameFromNormal(normal).toWorld(sampleCosineHemisphere(r2Point(i, shift)))};
}

BounceRays::Arrival arrivalAt(const RoomTexels& room, std::uint32_t texel, float distance,
                              const Vec3& throughput) {
    using Unit = BounceRays::Unit;
    if (distance > kFar * room.groups[room.groupOf[texel]].bounds.radius)
        return {texel, Unit::group, 0, throughput};
    const Unwrap& unwrap = room.unwrap;
    const Chart& chart = unwrap.charts[unwrap.texelChart[room.entryOf[texel]]];
    const int reach = static_cast<int>(kSpread * distance / chart.texelSize() + 0.5f);
    if (reach > kSquare) return {texel, Unit::block, 0, throughput};
    return {texel, Unit::texel, static_cast<std::uint16_t>(reach), throughput};
}

struct Part {
    std::vector<std::uint32_t> ends;  ///< of the arrivals of each ray
    std::vector<BounceRays::Arrival> arrivals;
};

}  // namespace

BounceRays::BounceRays(const Scene& scene, const RayScene& rays, const RoomTexels& room) {
    const std::size_t groups = room.groups.size();
    if (groups == 0) return;
    perGroup_ = static_cast<int>(std::bit_floor(std::clamp(kMostRays / groups, kFewest, kMost)));
    launches_.resize(groups * perGroup_ + 1);
    std::vector<Part> parts(groups);
    parallelFor(groups, kGroupsPerBlock, [&](std::size_t g) {
        thread_local std::vector<Ray> queue;
        thread_local Sights sights;
        thread_local std::vector<std::pair<std::uint32_t, Arrival>> found;
        queue.clear(), found.clear();
        const Vec2 shift = RandomStream(0, g).next2();
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(perGroup_); ++i) {
            const std::uint32_t entry = startOf(room, room.groups[g], i);
            launches_[g * perGroup_ + i].texel = room.unwrap.texels[entry];
            queue.push_back(rayFrom(scene, room, rays.epsilon(), entry, i, shift));
        }
        SightTracer(scene, rays, room).trace(queue, sights);
        const auto add = [&](std::uint32_t ray, std::uint32_t texel, float distance,
                             const Vec3& throughput) {
            if (!room.hidden[texel])
                found.push_back({ray, arrivalAt(room, texel, distance, throughput)});
        };
        for (std::uint32_t i = 0; i < queue.size(); ++i)
            if (sights.texel[i] != kNoTexel) add(i, sights.texel[i], sights.distance[i], Vec3(1));
        for (const Sight& sight : sights.others)
            if (sight.texel != kNoTexel && sight.covered)
                add(sight.ray, sight.texel, sight.distance, sight.throughput);
        std::ranges::stable_sort(found, {}, &std::pair<std::uint32_t, Arrival>::first);
        std::size_t k = 0;
        for (std::uint32_t i = 0; i < queue.size(); ++i) {
            for (; k < found.size() && found[k].first == i; ++k)
                parts[g].arrivals.push_back(found[k].second);
            parts[g].ends.push_back(static_cast<std::uint32_t>(k));
        }
    });
    for (std::size_t g = 0; g < groups; ++g) {
        const auto first = static_cast<std::uint32_t>(arrivals_.size());
        for (int i = 0; i < perGroup_; ++i)
            launches_[g * perGroup_ + i + 1].first = first + parts[g].ends[i];
        arrivals_.insert(arrivals_.end(), parts[g].arrivals.begin(), parts[g].arrivals.end());
    }
}

}  // namespace vlf
