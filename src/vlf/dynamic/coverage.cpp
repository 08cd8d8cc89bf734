#include "vlf/dynamic/coverage.h"

#include <algorithm>

namespace vlf {

namespace {

/// A gap narrower than this part of a texel is none.
constexpr float kContact = 0.02f;

bool touches(const Sphere& a, const Sphere& b) {
    const float reach = a.radius + b.radius;
    const Vec3 d = a.centre - b.centre;
    return glm::dot(d, d) < reach * reach;
}

bool touchesAny(const Sphere& sphere, std::span<const Sphere> objects) {
    return std::any_of(objects.begin(), objects.end(),
                       [&](const Sphere& object) { return touches(sphere, object); });
}

/// Entries of which a part may lie in or under one of the objects, in ascending order.
void findEntriesNear(const Scene& scene, const RoomTexels& room, std::span<const Sphere> objects,
                     std::vector<std::uint32_t>& entries) {
    entries.clear();
    for (const TexelGroup& group : room.groups) {
        if (!touchesAny(group.bounds, objects)) continue;
        for (std::uint32_t g = group.first; g < group.first + group.count; ++g) {
            const LightReceiver texel = texelReceiver(scene, room.unwrap, room.grouped[g]);
            if (touchesAny({texel.centre, texel.radius}, objects))
                entries.push_back(room.grouped[g]);
        }
    }
    std::sort(entries.begin(), entries.end());
}

/// Whether an object lies on a point or around it: the first surface met on the way out is at once
/// there or shows its inner side.
bool isCovered(const Vec3& point, const Vec3& normal, float gap, const RayInstances& rays,
               std::span<const LitObject> lit) {
    const InstanceHit found = rays.closest({point - gap * normal, normal});
    if (!found) return false;
    if (found.hit.t < 2 * gap) return true;
    const LitObject& object = lit[found.instance];
    const Vec3 winding = object.pose.direction(areaVector(object.mesh->scene, found.hit.triangle));
    return object.mesh->closed && glm::dot(winding, normal) > 0;
}

}  // namespace

Coverage::Coverage(const RoomTexels& room) : uncovered_(room.source.size(), 1) {}

void Coverage::find(const Scene& scene, const RayScene& roomRays, const RoomTexels& room,
                    const RayInstances& rays, std::span<const LitObject> lit,
                    std::span<const Sphere> objects) {
    for (const std::uint32_t i : entries_) uncovered_[room.unwrap.texels[i]] = 1;
    entries_.clear(), points_.clear(), first_.assign(1, 0);
    findEntriesNear(scene, room, objects, near_);
    for (const std::uint32_t i : near_) {
        const LightReceiver texel = texelReceiver(scene, room.unwrap, i);
        const float gap = std::max(kContact * texel.radius, 4 * roomRays.epsilon());
        const std::size_t before = points_.size();
        for (const SurfacePoint& p : texel.points)
            if (!isCovered(positionAt(scene, p.triangle, p.barycentric),
                           texel.side * geometricNormal(scene, p.triangle), gap, rays, lit))
                points_.push_back(p);
        const std::size_t left = points_.size() - before;
        if (left == texel.points.size()) {
            points_.resize(before);
            continue;
        }
        uncovered_[room.unwrap.texels[i]] =
            static_cast<float>(left) / static_cast<float>(texel.points.size());
        entries_.push_back(i);
        first_.push_back(static_cast<std::uint32_t>(points_.size()));
    }
}

void Coverage::fill(const RoomTexels& room, IrradianceAtlas& light) const {
    const Unwrap& unwrap = room.unwrap;
    for (const std::uint32_t i : entries_) {
        const std::uint32_t texel = unwrap.texels[i];
        if (uncovered_[texel] > 0) continue;
        const Chart& chart = unwrap.charts[unwrap.texelChart[i]];
        const std::uint32_t x = texel % unwrap.atlasWidth, y = texel / unwrap.atlasWidth;
        Vec3 sum(0);
        int count = 0;
        for (std::uint32_t v = std::max(chart.y, y - 1);
             v <= std::min(chart.y + chart.height - 1, y + 1); ++v)
            for (std::uint32_t u = std::max(chart.x, x - 1);
                 u <= std::min(chart.x + chart.width - 1, x + 1); ++u) {
                const std::uint32_t t = v * unwrap.atlasWidth + u;
                if (room.source[t] != t || uncovered_[t] <= 0) continue;
                sum += light.irradiance[t];
                ++count;
            }
        if (count > 0) light.irradiance[texel] = sum / static_cast<float>(count);
    }
}

void Coverage::restore(const RoomTexels& room, const IrradianceAtlas& own,
                       IrradianceAtlas& light) const {
    for (const std::uint32_t i : entries_) {
        const std::uint32_t texel = room.unwrap.texels[i];
        light.irradiance[texel] = own.irradiance[texel];
    }
}

std::span<const SurfacePoint> Coverage::points(const RoomTexels& room, std::size_t i) const {
    const auto k = std::lower_bound(entries_.begin(), entries_.end(), i) - entries_.begin();
    if (static_cast<std::size_t>(k) == entries_.size() || entries_[k] != i)
        return room.unwrap.points.of(i);
    return {points_.data() + first_[k], points_.data() + first_[k + 1]};
}

}  // namespace vlf
