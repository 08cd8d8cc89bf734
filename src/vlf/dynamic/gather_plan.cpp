#include "vlf/dynamic/gather_plan.h"

#include "vlf/base/parallel.h"
#include "vlf/dynamic/turned_set.h"
#include "vlf/field/direction_set.h"
#include "vlf/math/sampling.h"

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>
#include <utility>

namespace vlf {

namespace {

constexpr float kMinCosine = 1e-4f;
constexpr float kContact = 4;  // ray epsilons
constexpr std::size_t kDirectionsPerBlock = 8;
constexpr int kOwnBounces = 6;        // of light from one part of the object to another
constexpr float kLeastShare = 0.25f;  // of the mean chance, for dark directions

/// What one direction contributes to the plan.
struct DirectionPart {
    using Entries = std::vector<std::pair<std::uint32_t, GatherPlan::Entry>>;  ///< by receiver

    std::vector<std::uint32_t> launches;  ///< receivers
    Entries outside, inside;
};

/// Patches of receivers that lie close together and face alike: the cluster of each.
std::vector<std::uint32_t> clusterReceivers(const ObjectReceivers& receivers, float cell) {
    using Key = std::tuple<int, int, int, int>;
    std::map<Key, std::uint32_t> clusters;
    std::vector<std::uint32_t> clusterOf;
    for (std::uint32_t r = 0; r < receivers.size(); ++r) {
        const glm::ivec3 at(glm::floor(receivers.position[r] / cell));
        const Vec3 n = receivers.geometric[r], size = glm::abs(n);
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const Key key{at.x, at.y, at.z, 2 * axis + (n[axis] > 0)};
        clusterOf.push_back(
            clusters.try_emplace(key, static_cast<std::uint32_t>(clusters.size())).first->second);
    }
    return clusterOf;
}

/// The middles of the clusters.
std::vector<Vec3> middles(const ObjectReceivers& receivers,
                          const std::vector<std::uint32_t>& clusterOf) {
    std::vector<Vec4> sums;
    for (std::size_t r = 0; r < clusterOf.size(); ++r) {
        if (clusterOf[r] >= sums.size()) sums.resize(clusterOf[r] + 1, Vec4(0));
        sums[clusterOf[r]] += Vec4(receivers.position[r], 1);
    }
    std::vector<Vec3> result;
    for (const Vec4& sum : sums) result.push_back(Vec3(sum) / sum.w);
    return result;
}

struct Clusters {
    std::vector<std::uint32_t> of;  ///< by receiver; empty: each is by itself
    std::vector<Vec3> middle;
};

/// Picks for every cluster the receiver nearest to its middle as the launch of all that see out.
void launchFromClusters(const ObjectReceivers& receivers, const Clusters& clusters,
                        const std::vector<std::uint32_t>& open,
                        std::vector<std::uint32_t>& launchOf, DirectionPart& part) {
    std::vector<std::uint32_t> best(clusters.middle.size(), ObjectReceivers::kNone);
    const auto distance = [&](std::uint32_t r) {
        return glm::distance(receivers.position[r], clusters.middle[clusters.of[r]]);
    };
    for (const std::uint32_t r : open) {
        std::uint32_t& found = best[clusters.of[r]];
        if (found == ObjectReceivers::kNone || distance(r) < distance(found)) found = r;
    }
    std::vector<std::uint32_t> launch(best.size());
    for (std::size_t c = 0; c < best.size(); ++c) {
        if (best[c] == ObjectReceivers::kNone) continue;
        launch[c] = static_cast<std::uint32_t>(part.launches.size());
        part.launches.push_back(best[c]);
    }
    for (const std::uint32_t r : open) launchOf.push_back(launch[clusters.of[r]]);
}

/// Finds for one direction which receivers see out along it, and what of the object the others see.
DirectionPart planDirection(const ObjectReceivers& receivers, const Clusters& clusters,
                            const Vec3& direction, float weight) {
    const ObjectMesh& mesh = *receivers.mesh;
    const float epsilon = kContact * mesh.rays.epsilon();
    std::vector<std::uint32_t> above;
    std::vector<Ray> rays;
    for (std::uint32_t r = 0; r < receivers.size(); ++r) {
        if (glm::dot(receivers.normal[r], direction) <= kMinCosine ||
            glm::dot(receivers.geometric[r], direction) <= kMinCosine)
            continue;
        above.push_back(r);
        rays.push_back({receivers.position[r] + epsilon * receivers.geometric[r], direction});
    }
    std::vector<Hit> hits(rays.size());
    mesh.rays.closest(rays, hits);
    DirectionPart part;
    const auto add = [&](DirectionPart::Entries& entries, std::uint32_t r, std::uint32_t from) {
        entries.emplace_back(
            r, GatherPlan::Entry{from, weight * glm::dot(receivers.normal[r], direction)});
    };
    std::vector<std::uint32_t> open, launchOf;
    for (std::size_t i = 0; i < above.size(); ++i) {
        if (!hits[i]) {
            open.push_back(above[i]);
            continue;
        }
        const bool front = glm::dot(areaVector(mesh.scene, hits[i].triangle), direction) < 0;
        const std::uint32_t seen = receivers.at(hits[i].triangle, hits[i].barycentric, front);
        if (seen != ObjectReceivers::kNone) add(part.inside, above[i], seen);
    }
    if (!clusters.of.empty()) {
        launchFromClusters(receivers, clusters, open, launchOf, part);
    } else {
        for (const std::uint32_t r : open) {
            launchOf.push_back(static_cast<std::uint32_t>(part.launches.size()));
            part.launches.push_back(r);
        }
    }
    for (std::size_t i = 0; i < open.size(); ++i) add(part.outside, open[i], launchOf[i]);
    return part;
}

/// Entries of all parts by receiver; `shift` is added to where those of a part come from.
GatherPlan::Entries sortByReceiver(const std::vector<DirectionPart>& parts,
                                   DirectionPart::Entries DirectionPart::*entries,
                                   std::size_t receivers,
                                   const std::function<std::uint32_t(std::size_t)>& shift) {
    GatherPlan::Entries sorted;
    sorted.first.assign(receivers + 1, 0);
    for (const DirectionPart& part : parts)
        for (const auto& [receiver, entry] : part.*entries) ++sorted.first[receiver + 1];
    for (std::size_t r = 0; r < receivers; ++r) sorted.first[r + 1] += sorted.first[r];
    sorted.all.resize(sorted.first.back());
    std::vector<std::uint32_t> next(sorted.first.begin(), sorted.first.end() - 1);
    for (std::size_t d = 0; d < parts.size(); ++d)
        for (const auto& [receiver, entry] : parts[d].*entries)
            sorted.all[next[receiver]++] = {entry.from + shift(d), entry.weight};
    return sorted;
}

void assemble(const std::vector<DirectionPart>& parts, const std::vector<Vec3>& positions,
              GatherPlan& plan) {
    plan.firstLaunch.assign(1, 0);
    for (const DirectionPart& part : parts) {
        for (const std::uint32_t r : part.launches) plan.launches.push_back(positions[r]);
        plan.firstLaunch.push_back(static_cast<std::uint32_t>(plan.launches.size()));
    }
    plan.outside = sortByReceiver(parts, &DirectionPart::outside, positions.size(),
                                  [&](std::size_t d) { return plan.firstLaunch[d]; });
    plan.inside = sortByReceiver(parts, &DirectionPart::inside, positions.size(),
                                 [](std::size_t) { return 0u; });
}

}  // namespace

GatherPlan makeGatherPlan(const ObjectReceivers& receivers, const Sphere& bounds,
                          const GatherPlanParams& params) {
    const DirectionSet set(params.lines);
    const Mat3 turn = sampleUniformRotation(kTurn);
    GatherPlan plan;
    std::vector<float> weights;
    for (int d = 0; d < set.directionCount(); d += params.step) {
        plan.directions.push_back(turn * set.direction(static_cast<std::uint32_t>(d)));
        weights.push_back(set.weight(static_cast<std::uint32_t>(d)));
    }
    Clusters clusters;
    if (params.cellsAcross > 0) {
        clusters.of = clusterReceivers(receivers, 2 * bounds.radius / params.cellsAcross);
        clusters.middle = middles(receivers, clusters.of);
    }
    std::vector<DirectionPart> parts(plan.directions.size());
    parallelFor(parts.size(), 4, [&](std::size_t d) {
        parts[d] = planDirection(receivers, clusters, plan.directions[d], weights[d]);
    });
    assemble(parts, receivers.position, plan);
    return plan;
}

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

void GatherSights::trace(const GatherPlan& plan, const Pose& pose, const LitRoom& room,
                         const SightObjects& objects, const Coverage& coverage,
                         std::span<const std::uint8_t> wanted, bool emission) {
    wanted_.assign(wanted.begin(), wanted.end());
    findNeeded(plan);
    const std::size_t count = plan.launches.size();
    texel_.assign(count, kNoTexel);
    valid_.assign(count, 0);
    const std::size_t blocks =
        (plan.directions.size() + kDirectionsPerBlock - 1) / kDirectionsPerBlock;
    others_.resize(blocks);
    parallelFor(blocks, 2, [&](std::size_t block) {
        const std::size_t end = std::min(plan.directions.size(), (block + 1) * kDirectionsPerBlock);
        thread_local std::vector<Ray> queue;
        thread_local std::vector<std::uint32_t> launchOf;
        thread_local Sights sights;
        thread_local std::vector<float> scaleOf;
        queue.clear(), launchOf.clear(), scaleOf.clear();
        for (std::size_t d = block * kDirectionsPerBlock; d < end; ++d) {
            if (chance(d) <= 0) continue;
            const Vec3 direction = pose.direction(plan.directions[d]);
            // From just within the object: what touches it is seen.
            const Vec3 back = -kContact * room.rays.epsilon() * direction;
            for (std::uint32_t i = plan.firstLaunch[d]; i < plan.firstLaunch[d + 1]; ++i) {
                if (!needed_.empty() && !needed_[i]) continue;
                queue.push_back({pose.point(plan.launches[i]) + back, direction});
                launchOf.push_back(i);
                scaleOf.push_back(1 / chance(d));
            }
        }
        SightTracer tracer(room.scene, room.rays, room.texels);
        tracer.setObjects(objects);
        tracer.trace(queue, sights);
        // What an object lies on is dark, and it is not known how dark.
        const auto isDark = [&](std::uint32_t texel) {
            return texel != kNoTexel && coverage.uncovered(texel) <= 0;
        };
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const bool dark = isDark(sights.texel[i]);
            texel_[launchOf[i]] = dark ? kNoTexel : sights.texel[i];
            valid_[launchOf[i]] = !dark && !sights.within[i];
        }
        others_[block].clear();
        for (const Sight& sight : sights.others) {
            if (isDark(sight.texel)) {
                if (!sight.inMirror) valid_[launchOf[sight.ray]] = 0;
                continue;
            }
            others_[block].push_back({launchOf[sight.ray], scaleOf[sight.ray], sight});
            if (sight.emissionApart && !emission) others_[block].back().sight.emission = Vec3(0);
        }
    });
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
    parallelFor(receivers.size(), 16, [&](std::size_t r) {
        if (!wants(r)) return;
        Vec4 sum(0);
        for (const GatherPlan::Entry& entry : plan.outside.of(r))
            sum += entry.weight * radiance_[entry.from];
        for (const GatherPlan::Entry& entry : plan.inside.of(r)) sum.w += entry.weight;
        const float norm = sum.w > 0 ? kPi / sum.w : 0;
        outside_[r] = Vec4(norm * Vec3(sum), norm);
        irradiance[r] = Vec3(outside_[r]);
    });
    if (!plan.inside.all.empty()) reflectWithin(plan, receivers, direct, irradiance);
}

/// Jacobi iterations of the light between receivers.
void GatherSights::reflectWithin(const GatherPlan& plan, const ObjectReceivers& receivers,
                                 std::span<const Vec3> direct, std::span<Vec3> irradiance) {
    ownRadiance_.resize(receivers.size());
    for (int bounce = 0; bounce < kOwnBounces; ++bounce) {
        for (std::size_t r = 0; r < receivers.size(); ++r)
            ownRadiance_[r] = receivers.reflectance[r] * (irradiance[r] + direct[r]) / kPi;
        parallelFor(receivers.size(), 16, [&](std::size_t r) {
            if (!wants(r)) return;
            Vec3 sum(0);
            for (const GatherPlan::Entry& entry : plan.inside.of(r))
                sum += entry.weight * ownRadiance_[entry.from];
            irradiance[r] = Vec3(outside_[r]) + outside_[r].w * sum;
        });
    }
}

}  // namespace vlf
