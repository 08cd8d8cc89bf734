#include "vlf/dynamic/gather_plan.h"

#include "vlf/base/parallel.h"
#include "vlf/field/direction_set.h"
#include "vlf/math/frame.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace vlf {

namespace {

constexpr float kMinCosine = 1e-4f;
constexpr float kContact = 4;  // ray epsilons
constexpr std::size_t kDirectionsPerBlock = 8;

/// What one direction contributes to the plan.
struct DirectionPart {
    std::vector<Vec3> launches;
    std::vector<std::pair<std::uint32_t, GatherPlan::Entry>> entries;  ///< by receiver
};

/// The far ends of a grid of lines through the object along one direction.
class LaunchGrid {
  public:
    LaunchGrid(const ObjectMesh& mesh, const Sphere& bounds, const Vec3& direction, float across)
        : frame_(frameFromNormal(direction)),
          centre_(bounds.centre),
          cell_(2 * bounds.radius / across),
          side_(static_cast<int>(std::ceil(across)) + 2),
          launchOf_(static_cast<std::size_t>(side_) * side_, kEmpty) {
        std::vector<Ray> rays;
        for (int y = 0; y < side_; ++y)
            for (int x = 0; x < side_; ++x) {
                const Vec3 p = centre_ + frame_.toWorld({coordinate(x), coordinate(y), 0});
                rays.push_back({p + 2 * bounds.radius * direction, -direction});
            }
        std::vector<Hit> hits(rays.size());
        mesh.rays.closest(rays, hits);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (!hits[i]) continue;
            launchOf_[i] = static_cast<std::uint32_t>(launches.size());
            launches.push_back(rays[i].origin + hits[i].t * rays[i].direction);
        }
    }

    /// The launch of the grid nearest to p; kEmpty if there is none within about a cell.
    std::uint32_t nearest(const Vec3& p) const {
        const Vec3 local = frame_.toLocal(p - centre_) / cell_;
        const int x = cellOf(local.x), y = cellOf(local.y);
        std::uint32_t best = kEmpty;
        float least = 2.5f * cell_ * cell_;
        for (int j = std::max(0, y - 1); j <= std::min(side_ - 1, y + 1); ++j)
            for (int i = std::max(0, x - 1); i <= std::min(side_ - 1, x + 1); ++i) {
                const std::uint32_t launch = launchOf_[static_cast<std::size_t>(j) * side_ + i];
                if (launch == kEmpty) continue;
                const Vec3 d = launches[launch] - p;
                if (const float squared = glm::dot(d, d); squared < least)
                    least = squared, best = launch;
            }
        return best;
    }

    static constexpr std::uint32_t kEmpty = 0xffffffffu;
    std::vector<Vec3> launches;

  private:
    float coordinate(int i) const { return (i - 0.5f * (side_ - 1)) * cell_; }
    int cellOf(float x) const { return static_cast<int>(std::lround(x + 0.5f * (side_ - 1))); }

    Frame frame_;
    Vec3 centre_;
    float cell_;
    int side_;
    std::vector<std::uint32_t> launchOf_;
};

/// Finds for one direction which receivers see out along it, and what of the object the others see.
DirectionPart planDirection(const ObjectReceivers& receivers, const Sphere& bounds,
                            const Vec3& direction, float weight, float cellsAcross) {
    const ObjectMesh& mesh = *receivers.mesh;
    const float epsilon = 4 * mesh.rays.epsilon();
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
    std::optional<LaunchGrid> grid;
    if (cellsAcross > 0) {
        grid.emplace(mesh, bounds, direction, cellsAcross);
        if (2 * grid->launches.size() > above.size()) grid.reset();
    }
    if (grid) part.launches = grid->launches;
    for (std::size_t i = 0; i < above.size(); ++i) {
        const std::uint32_t r = above[i];
        GatherPlan::Entry entry{0, weight * glm::dot(receivers.normal[r], direction)};
        if (hits[i]) {
            const bool front = glm::dot(areaVector(mesh.scene, hits[i].triangle), direction) < 0;
            const std::uint32_t seen = receivers.at(hits[i].triangle, hits[i].barycentric, front);
            if (seen == ObjectReceivers::kNone) continue;
            entry.from = GatherPlan::kSelf | seen;
        } else {
            entry.from = grid ? grid->nearest(rays[i].origin) : LaunchGrid::kEmpty;
            if (entry.from == LaunchGrid::kEmpty) {
                entry.from = static_cast<std::uint32_t>(part.launches.size());
                part.launches.push_back(rays[i].origin);
            }
        }
        part.entries.emplace_back(r, entry);
    }
    return part;
}

/// Puts the directions' parts together, entries by receiver.
void assemble(const std::vector<DirectionPart>& parts, std::size_t receivers, GatherPlan& plan) {
    plan.firstLaunch.assign(1, 0);
    plan.firstEntry.assign(receivers + 1, 0);
    for (const DirectionPart& part : parts) {
        plan.launches.insert(plan.launches.end(), part.launches.begin(), part.launches.end());
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
    GatherPlan plan;
    std::vector<float> weights;
    for (int d = 0; d < set.directionCount(); d += params.step) {
        plan.directions.push_back(set.direction(static_cast<std::uint32_t>(d)));
        weights.push_back(set.weight(static_cast<std::uint32_t>(d)));
    }
    std::vector<DirectionPart> parts(plan.directions.size());
    parallelFor(parts.size(), 4, [&](std::size_t d) {
        parts[d] =
            planDirection(receivers, bounds, plan.directions[d], weights[d], params.cellsAcross);
    });
    assemble(parts, receivers.size(), plan);
    return plan;
}

void GatherSights::trace(const GatherPlan& plan, const Pose& pose, const Scene& scene,
                         const RayScene& rays, const RoomTexels& room, const SightObjects& objects,
                         bool emission) {
    const std::size_t count = plan.launches.size();
    texel_.assign(count, kNoTexel);
    valid_.assign(count, 1);
    const std::size_t blocks =
        (plan.directions.size() + kDirectionsPerBlock - 1) / kDirectionsPerBlock;
    others_.resize(blocks);
    parallelFor(blocks, 4, [&](std::size_t block) {
        const std::size_t end = std::min(plan.directions.size(), (block + 1) * kDirectionsPerBlock);
        const std::uint32_t first = plan.firstLaunch[block * kDirectionsPerBlock];
        std::vector<Ray> queue;
        for (std::size_t d = block * kDirectionsPerBlock; d < end; ++d) {
            const Vec3 direction = pose.direction(plan.directions[d]);
            // From just within the object: what touches it is seen.
            const Vec3 back = -kContact * rays.epsilon() * direction;
            for (std::uint32_t i = plan.firstLaunch[d]; i < plan.firstLaunch[d + 1]; ++i)
                queue.push_back({pose.point(plan.launches[i]) + back, direction});
        }
        SightTracer tracer(scene, rays, room);
        tracer.setObjects(objects);
        others_[block].clear();
        for (const Sight& s : tracer.trace(queue)) {
            const bool plain = s.texel != kNoTexel && !s.inMirror;
            if (plain) texel_[first + s.ray] = s.texel;
            Seen seen{first + s.ray, s};
            if (s.emissionApart && !emission) seen.sight.emission = Vec3(0);
            if (plain) seen.sight.texel = kNoTexel;
            if (!plain || seen.sight.emission != Vec3(0)) others_[block].push_back(seen);
        }
        for (std::size_t i = 0; i < queue.size(); ++i)
            if (tracer.within()[i]) valid_[first + i] = 0;
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
