#include "vlf/dynamic/gather_sights.h"

#include "vlf/base/parallel.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr float kContact = 4;  // ray epsilons
constexpr std::size_t kDirectionsPerBlock = 8, kReceiversPerBlock = 16;
constexpr float kNear = 4;            // widths of a patch
constexpr int kOwnBounces = 6;        // of light from one part of the object to another, at most
constexpr float kSettled = 1e-3f;     // of their light: what is left when these may end
constexpr float kLeastShare = 0.25f;  // of the mean chance, for dark directions

}  // namespace

void GatherSights::pickDirections(const GatherPlan& plan, const Vec3& centre, int count,
                                  const Pose& pose, const LitRoom& room,
                                  const SightObjects& objects) {
    chances_.clear();
    if (count <= 0) return;
    std::vector<Ray> rays;
    for (const Vec3& d : plan.directions) rays.push_back({pose.point(centre), pose.direction(d)});
    SightTracer tracer(room.scene, room.rays, room.texels);
    tracer.setObjects(objects);
    Sights sights;
    tracer.trace(rays, sights);
    chances_.assign(rays.size(), 0);
    for (std::size_t d = 0; d < rays.size(); ++d)
        if (sights.texel[d] != kNoTexel) chances_[d] = luminance(room.radiance[sights.texel[d]]);
    for (const Sight& sight : sights.others)
        chances_[sight.ray] +=
            luminance(sight.throughput * (diffuseRadiance(sight, room.radiance, objects.lit) +
                                          (sight.emissionApart ? Vec3(0) : sight.emission)));
    float sum = 0;
    for (const float c : chances_) sum += c;
    const auto directions = static_cast<float>(chances_.size());
    const float least = sum > 0 ? kLeastShare * sum / directions : 1;
    sum = std::max(sum + directions * least, 1e-30f);
    // Systematic sampling: where the running sum passes a whole number a direction is picked.
    float passed = 0.5f;
    for (float& c : chances_) {
        const float chance = std::min(1.0f, static_cast<float>(count) * (c + least) / sum);
        passed += chance;
        c = passed >= 1 ? chance : 0;
        if (passed >= 1) passed -= 1;
    }
}

void GatherSights::findNeeded(const GatherPlan& plan) {
    needed_.clear();
    if (wanted_.empty()) return;
    needed_.assign(plan.launches.size(), 0);
    for (std::size_t r = 0; r < wanted_.size(); ++r) {
        if (!wanted_[r]) continue;
        for (const GatherPlan::Entry& entry : plan.outside.of(r)) needed_[entry.from] = 1;
    }
}

void GatherSights::trace(const GatherPlan& plan, const ObjectReceivers& receivers, const Pose& pose,
                         const LitRoom& room, const SightObjects& objects, const Coverage& coverage,
                         std::span<const std::uint8_t> wanted, bool emission) {
    wanted_.assign(wanted.begin(), wanted.end());
    findNeeded(plan);
    const std::size_t count = plan.launches.size();
    texel_.assign(count, kNoTexel);
    valid_.assign(count, 0);
    const std::size_t blocks =
        (plan.directions.size() + kDirectionsPerBlock - 1) / kDirectionsPerBlock;
    others_.resize(blocks), near_.resize(blocks);
    const float reach = kNear * plan.patch * pose.scale;
    parallelFor(blocks, 2, [&](std::size_t block) {
        thread_local Launched launched;
        queueLaunches(plan, pose, kContact * room.rays.epsilon(), block, launched);
        SightTracer tracer(room.scene, room.rays, room.texels);
        tracer.setObjects(objects);
        tracer.trace(launched.rays, launched.sights);
        keepSights(launched, coverage, emission, block);
        near_[block].clear();
        for (std::size_t i = 0; i < launched.rays.size(); ++i) {
            const std::uint32_t texel = texel_[launched.of[i]];
            const float distance = launched.sights.distance[i];
            if (texel == kNoTexel || distance >= reach) continue;
            const auto place = NearPlace::of(launched.rays[i], distance, texel, pose, room.texels);
            if (place)
                near_[block].push_back(
                    {launched.of[i], launched.scale[i], launched.rays[i], *place});
        }
    });
    findOwnTexels(plan, receivers, pose, room, objects, coverage);
}

/// From `depth` within the object, in metres: what touches it is seen.
void GatherSights::queueLaunches(const GatherPlan& plan, const Pose& pose, float depth,
                                 std::size_t block, Launched& launched) const {
    launched.rays.clear(), launched.of.clear(), launched.scale.clear();
    const std::size_t end = std::min(plan.directions.size(), (block + 1) * kDirectionsPerBlock);
    for (std::size_t d = block * kDirectionsPerBlock; d < end; ++d) {
        if (chance(d) <= 0) continue;
        const Vec3 direction = pose.direction(plan.directions[d]);
        for (std::uint32_t i = plan.firstLaunch[d]; i < plan.firstLaunch[d + 1]; ++i) {
            if (!needed_.empty() && !needed_[i]) continue;
            launched.rays.push_back({pose.point(plan.launches[i]) - depth * direction, direction});
            launched.of.push_back(i);
            launched.scale.push_back(1 / chance(d));
        }
    }
}

/// What an object lies on is dark, and it is not known how dark.
void GatherSights::keepSights(const Launched& launched, const Coverage& coverage, bool emission,
                              std::size_t block) {
    const Sights& sights = launched.sights;
    const auto isDark = [&](std::uint32_t texel) {
        return texel != kNoTexel && coverage.uncovered(texel) <= 0;
    };
    for (std::size_t i = 0; i < launched.rays.size(); ++i) {
        const bool dark = isDark(sights.texel[i]);
        texel_[launched.of[i]] = dark ? kNoTexel : sights.texel[i];
        valid_[launched.of[i]] = !dark && !sights.within[i];
    }
    others_[block].clear();
    for (const Sight& sight : sights.others) {
        const std::uint32_t launch = launched.of[sight.ray];
        if (isDark(sight.texel)) {
            if (!sight.inMirror) valid_[launch] = 0;
            continue;
        }
        others_[block].push_back({launch, launched.scale[sight.ray], sight});
        if (sight.emissionApart && !emission) others_[block].back().sight.emission = Vec3(0);
    }
}

void GatherSights::findOwnTexels(const GatherPlan& plan, const ObjectReceivers& receivers,
                                 const Pose& pose, const LitRoom& room, const SightObjects& objects,
                                 const Coverage& coverage) {
    const std::size_t blocks = (receivers.size() + kReceiversPerBlock - 1) / kReceiversPerBlock;
    ownTexels_.resize(blocks);
    for (std::vector<OwnTexel>& block : ownTexels_) block.clear();
    if (std::ranges::all_of(near_, [](const auto& block) { return block.empty(); })) return;
    nearOf_.assign(plan.launches.size(), nullptr);
    for (const std::vector<NearLaunch>& block : near_)
        for (const NearLaunch& near : block) nearOf_[near.launch] = &near;
    parallelFor(blocks, 1, [&](std::size_t block) {
        thread_local OwnSights passed;
        passed.rays.clear(), passed.of.clear();
        std::vector<OwnTexel>& own = ownTexels_[block];
        const std::size_t end = std::min(receivers.size(), (block + 1) * kReceiversPerBlock);
        for (std::size_t r = block * kReceiversPerBlock; r < end; ++r)
            if (wants(r)) shiftLaunches(plan, receivers, r, pose, room.texels, own, passed);
        traceOwn(room, objects, own, passed);
        std::erase_if(own, [&](const OwnTexel& o) {
            return o.texel == o.ofLaunch ||
                   (o.texel != kNoTexel && coverage.uncovered(o.texel) <= 0);
        });
    });
}

void GatherSights::shiftLaunches(const GatherPlan& plan, const ObjectReceivers& receivers,
                                 std::size_t r, const Pose& pose, const RoomTexels& room,
                                 std::vector<OwnTexel>& own, OwnSights& passed) const {
    for (const GatherPlan::Entry& entry : plan.outside.of(r)) {
        const NearLaunch* near = nearOf_[entry.from];
        if (!near) continue;
        const Vec3 offset = receivers.position[r] - plan.launches[entry.from];
        const std::uint32_t texel = near->place.texelFrom(offset, room);
        const std::uint32_t ofLaunch = texel_[entry.from];
        if (texel == ofLaunch) continue;
        if (texel == kNoTexel) {
            const Vec3 shift = pose.scale * pose.direction(offset);
            passed.rays.push_back({near->ray.origin + shift, near->ray.direction});
            passed.of.push_back(own.size());
        }
        own.push_back({static_cast<std::uint32_t>(r), texel, ofLaunch, near->scale * entry.weight});
    }
}

/// What launches see stays where a ray of one's own meets anything but a texel of the room, or
/// nothing, which is black.
void GatherSights::traceOwn(const LitRoom& room, const SightObjects& objects,
                            std::vector<OwnTexel>& own, OwnSights& passed) {
    SightTracer tracer(room.scene, room.rays, room.texels);
    tracer.setObjects(objects);
    tracer.trace(passed.rays, passed.sights);
    const auto keep = [](OwnTexel& o) { o.texel = o.ofLaunch; };
    for (std::size_t i = 0; i < passed.rays.size(); ++i) {
        own[passed.of[i]].texel = passed.sights.texel[i];
        if (passed.sights.within[i]) keep(own[passed.of[i]]);
    }
    for (const Sight& sight : passed.sights.others) keep(own[passed.of[sight.ray]]);
}

/// Of directions that were not followed nothing is known but that they are likely samples.
void GatherSights::findRadiance(const GatherPlan& plan, std::span<const Vec3> texelRadiance,
                                std::span<const LitObject> lit) {
    radiance_.resize(texel_.size());
    for (std::size_t d = 0; d < plan.directions.size(); ++d) {
        const float scale = chance(d) > 0 ? 1 / chance(d) : 0;
        for (std::uint32_t i = plan.firstLaunch[d]; i < plan.firstLaunch[d + 1]; ++i)
            radiance_[i] = Vec4(texel_[i] == kNoTexel ? Vec3(0) : scale * texelRadiance[texel_[i]],
                                valid_[i] ? 1.0f : 1 - scale);
    }
    for (const std::vector<Seen>& block : others_)
        for (const Seen& seen : block)
            radiance_[seen.launch] +=
                Vec4(seen.scale * seen.sight.throughput *
                         (diffuseRadiance(seen.sight, texelRadiance, lit) + seen.sight.emission),
                     0);
}

void GatherSights::gather(const GatherPlan& plan, const ObjectReceivers& receivers,
                          std::span<const Vec3> texelRadiance, std::span<const LitObject> lit,
                          std::span<const Vec3> direct, std::span<Vec3> irradiance) {
    findRadiance(plan, texelRadiance, lit);
    outside_.resize(receivers.size());
    parallelFor(ownTexels_.size(), 1, [&](std::size_t block) {
        const std::size_t end = std::min(receivers.size(), (block + 1) * kReceiversPerBlock);
        auto own = ownTexels_[block].begin();
        for (std::size_t r = block * kReceiversPerBlock; r < end; ++r) {
            if (!wants(r)) continue;
            Vec4 sum(0);
            for (const GatherPlan::Entry& entry : plan.outside.of(r))
                sum += entry.weight * radiance_[entry.from];
            for (; own != ownTexels_[block].end() && own->receiver == r; ++own) {
                const Vec3 seen = own->texel == kNoTexel ? Vec3(0) : texelRadiance[own->texel];
                sum += Vec4(own->weight * (seen - texelRadiance[own->ofLaunch]), 0);
            }
            for (const GatherPlan::Entry& entry : plan.inside.of(r)) sum.w += entry.weight;
            const float norm = sum.w > 0 ? kPi / sum.w : 0;
            outside_[r] = Vec4(norm * Vec3(sum), norm);
            irradiance[r] = Vec3(outside_[r]);
        }
    });
    if (!plan.inside.all.empty()) reflectWithin(plan, receivers, direct, irradiance);
}

/// Jacobi iterations of the light between receivers.
void GatherSights::reflectWithin(const GatherPlan& plan, const ObjectReceivers& receivers,
                                 std::span<const Vec3> direct, std::span<Vec3> irradiance) {
    ownRadiance_.assign(receivers.size(), Vec4(0));
    for (int bounce = 0; bounce < kOwnBounces; ++bounce) {
        double change = 0, light = 0;
        for (std::size_t r = 0; r < receivers.size(); ++r) {
            const Vec4 own(receivers.reflectance[r] * (irradiance[r] + direct[r]) / kPi, 0);
            change += maxComponent(glm::abs(Vec3(own - ownRadiance_[r])));
            light += maxComponent(Vec3(own));
            ownRadiance_[r] = own;
        }
        if (change <= kSettled * light) return;
        parallelFor(receivers.size(), 16, [&](std::size_t r) {
            if (!wants(r)) return;
            Vec4 sum(0);
            for (const GatherPlan::Entry& entry : plan.inside.of(r))
                sum += entry.weight * ownRadiance_[entry.from];
            irradiance[r] = Vec3(outside_[r] + outside_[r].w * sum);
        });
    }
}

bool GatherSights::seesObjects() const {
    return std::ranges::any_of(others_, [](const std::vector<Seen>& block) {
        return std::ranges::any_of(block,
                                   [](const Seen& seen) { return seen.sight.object != kNoObject; });
    });
}

}  // namespace vlf
