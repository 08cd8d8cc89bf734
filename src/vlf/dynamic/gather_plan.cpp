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
                                   DirectionPart::Entries DirectionPart::* entries,
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
        plan.patch = 2 * bounds.radius / params.cellsAcross;
        clusters.of = clusterReceivers(receivers, plan.patch);
        clusters.middle = middles(receivers, clusters.of);
    }
    std::vector<DirectionPart> parts(plan.directions.size());
    parallelFor(parts.size(), 4, [&](std::size_t d) {
        parts[d] = planDirection(receivers, clusters, plan.directions[d], weights[d]);
    });
    assemble(parts, receivers.position, plan);
    return plan;
}

}  // namespace vlf
