#include "vlf/dynamic/gather_plan.h"

#include "vlf/base/parallel.h"
#include "vlf/dynamic/turned_set.h"
#include "vlf/field/direction_set.h"
#include "vlf/math/sampling.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace vlf {

namespace {

constexpr float kMinCosine = 1e-4f;
constexpr float kContact = 4;  // ray epsilons
constexpr std::size_t kDirectionsPerBlock = 8;

/// What one direction contributes to the plan.
struct DirectionPart {
    std::vector<std::uint32_t> launches;                               ///< receivers
    std::vector<std::pair<std::uint32_t, GatherPlan::Entry>> entries;  ///< by receiver
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
    const auto add = [&](std::uint32_t r, std::uint32_t from) {
        part.entries.emplace_back(
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
        if (seen != ObjectReceivers::kNone) add(above[i], GatherPlan::kSelf | seen);
    }
    if (!clusters.of.empty()) {
        launchFromClusters(receivers, clusters, open, launchOf, part);
    } else {
        for (const std::uint32_t r : open) {
            launchOf.push_back(static_cast<std::uint32_t>(part.launches.size()));
            part.launches.push_back(r);
        }
    }
    for (std::size_t i = 0; i < open.size(); ++i) add(open[i], launchOf[i]);
    return part;
}

/// Puts the directions' parts together, entries by receiver.
void assemble(const std::vector<DirectionPart>& parts, const std::vector<Vec3>& positions,
              GatherPlan& plan) {
    const std::size_t receivers = positions.size();
    plan.firstLaunch.assign(1, 0);
    plan.firstEntry.assign(receivers + 1, 0);
    for (const DirectionPart& part : parts) {
        for (const std::uint32_t r : part.launches) {
            plan.launches.push_back(positions[r]);
            plan.launchReceiver.push_back(r);
        }
        plan.firstLaunch.push_back(static_cast<std::uint32_t>(plan.launches.size()));
        for (const auto& [receiver, entry] : part.entries) ++plan.firstEntry[receiver + 1];
    }
    for (std::size_t r = 0; r < receivers; ++r) plan.firstEntry[r + 1] += plan.firstEntry[r];
    plan.entries.resize(plan.firstEntry.back());
    std::vector<std::uint32_t> next(plan.firstEntry.begin(), plan.firstEntry.end() - 1);
    for (std::size_t d = 0; d < parts.size(); ++d)
        for (auto [receiver, entry] : parts[d].entries) {
            if (!(entry.from & GatherPlan::kSelf)) entry.from += plan.firstLaunch[d];
            plan.entries[next[receiver]++] = entry;
        }
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

void GatherSights::trace(const GatherPlan& plan, const Pose& pose, const LitRoom& room,
                         const SightObjects& objects, const Coverage& coverage,
                         std::span<const std::uint8_t> wanted, bool emission) {
    wanted_.assign(wanted.begin(), wanted.end());
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
        queue.clear(), launchOf.clear();
        for (std::size_t d = block * kDirectionsPerBlock; d < end; ++d) {
            const Vec3 direction = pose.direction(plan.directions[d]);
            // From just within the object: what touches it is seen.
            const Vec3 back = -kContact * room.rays.epsilon() * direction;
            for (std::uint32_t i = plan.firstLaunch[d]; i < plan.firstLaunch[d + 1]; ++i) {
                if (!wants(plan.launchReceiver[i])) continue;
                queue.push_back({pose.point(plan.launches[i]) + back, direction});
                launchOf.push_back(i);
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
            others_[block].push_back({launchOf[sight.ray], sight});
            if (sight.emissionApart && !emission) others_[block].back().sight.emission = Vec3(0);
        }
    });
}

void GatherSights::findRadiance(std::span<const Vec3> texelRadiance,
                                std::span<const LitObject> lit) {
    radiance_.resize(texel_.size());
    for (std::size_t i = 0; i < texel_.size(); ++i)
        radiance_[i] = texel_[i] == kNoTexel ? Vec4(0, 0, 0, valid_[i])
                                             : Vec4(texelRadiance[texel_[i]], valid_[i]);
    for (const std::vector<Seen>& block : others_)
        for (const Seen& seen : block)
            radiance_[seen.launch] +=
                Vec4(seen.sight.throughput *
                         (diffuseRadiance(seen.sight, texelRadiance, lit) + seen.sight.emission),
                     0);
}

void GatherSights::gather(const GatherPlan& plan, const ObjectReceivers& receivers,
                          std::span<const Vec3> texelRadiance, std::span<const LitObject> lit,
                          std::span<const Vec3> own, std::span<Vec3> irradiance) {
    findRadiance(texelRadiance, lit);
    ownRadiance_.resize(receivers.size());
    for (std::size_t r = 0; r < receivers.size(); ++r)
        ownRadiance_[r] = receivers.reflectance[r] * own[r] / kPi;
    parallelFor(receivers.size(), 16, [&](std::size_t r) {
        if (!wants(r)) return;
        Vec4 sum(0);
        for (std::uint32_t e = plan.firstEntry[r]; e < plan.firstEntry[r + 1]; ++e) {
            const GatherPlan::Entry& entry = plan.entries[e];
            if (entry.from & GatherPlan::kSelf)
                sum += entry.weight * Vec4(ownRadiance_[entry.from & ~GatherPlan::kSelf], 1);
            else
                sum += entry.weight * radiance_[entry.from];
        }
        if (sum.w > 0) irradiance[r] += kPi * Vec3(sum) / sum.w;
    });
}

}  // namespace vlf
