#include "vlf/dynamic/delta_transport.h"

#include "vlf/base/parallel.h"

#include <algorithm>
#include <limits>

namespace vlf {

namespace {

constexpr std::size_t kLinesPerBlock = 32;
constexpr float kContact = 4;  // ray epsilons: nearer than this a surface is covered

/// What one end of each line of a block sees.
struct Views {
    std::vector<Ray> rays;
    Sights sights;
    std::vector<Vec3> radiance;  ///< of the room along the ray
    std::vector<float> hidden;   ///< from this distance on by another object

    void look(SightTracer& tracer, std::span<const Vec3> texelRadiance) {
        tracer.trace(rays, sights);
        radiance.resize(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i)
            radiance[i] = sights.texel[i] == kNoTexel ? Vec3(0) : texelRadiance[sights.texel[i]];
        for (const Sight& s : sights.others) {
            radiance[s.ray] += s.throughput * diffuseRadiance(s, texelRadiance, {});
            if (!s.emissionApart) radiance[s.ray] += s.throughput * s.emission;
        }
    }
};

/// Memory of one thread's block.
struct Scratch {
    Views forward, backward;
    std::vector<float> length, weight;  ///< of the lines: within the object, m; flux a radiance
    std::vector<InstanceHit> hits;

    void clear() {
        forward.rays.clear(), backward.rays.clear();
        length.clear(), weight.clear();
    }
};

void findHidden(const SightObjects& objects, std::vector<InstanceHit>& hits, Views& views) {
    views.hidden.assign(views.rays.size(), std::numeric_limits<float>::infinity());
    if (!objects.rays || objects.lit.size() < 2) return;
    hits.resize(views.rays.size());
    objects.rays->closest(views.rays, hits);
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i] && hits[i].instance != objects.own) views.hidden[i] = hits[i].hit.t;
}

}  // namespace

void DeltaLines::trace(const ObjectLines& lines, const Pose& pose, const Scene& scene,
                       const RayScene& rays, const RoomTexels& room, const SightObjects& objects,
                       const Coverage& coverage, std::span<const Vec3> texelRadiance) {
    const std::size_t blocks = (lines.directions.size() + kLinesPerBlock - 1) / kLinesPerBlock;
    blocks_.resize(blocks);
    const float epsilon = kContact * rays.epsilon();
    const float area = lines.cellArea * pose.scale * pose.scale;
    parallelFor(blocks, 1, [&](std::size_t block) {
        thread_local Scratch s;
        s.clear();
        const std::size_t end = std::min(lines.directions.size(), (block + 1) * kLinesPerBlock);
        const std::uint32_t first = lines.firstCell[block * kLinesPerBlock];
        for (std::size_t k = block * kLinesPerBlock; k < end; ++k) {
            const Vec3 direction = pose.direction(lines.directions[k]);
            for (std::uint32_t c = lines.firstCell[k]; c < lines.firstCell[k + 1]; ++c) {
                const Vec3 entry = pose.point(lines.entries[c].point);
                const Vec3 exit = pose.point(lines.exits[c].point);
                s.forward.rays.push_back({entry + epsilon * direction, direction});
                s.backward.rays.push_back({exit - epsilon * direction, -direction});
                s.length.push_back(glm::dot(exit - entry, direction));
                s.weight.push_back(lines.weights[k] * area);
            }
        }
        SightTracer tracer(scene, rays, room);
        for (Views* views : {&s.forward, &s.backward}) {
            views->look(tracer, texelRadiance);
            findHidden(objects, s.hits, *views);
        }
        std::vector<End>& ends = blocks_[block];
        ends.clear();
        const auto addEnds = [&](const Views& seen, const Views& lost,
                                 const std::vector<LineEnd>& objectEnds) {
            const auto add = [&](std::size_t i, std::uint32_t texel, float distance,
                                 const Vec3& throughput) {
                // Another object hides this one.
                if (seen.hidden[i] < distance) return;
                const float seenArea = room.area[texel] * coverage.uncovered(texel);
                if (seenArea > 0)
                    ends.push_back({texel, objectEnds[first + i].receiver, lost.radiance[i],
                                    s.weight[i] / seenArea * throughput});
            };
            for (std::size_t i = 0; i < seen.rays.size(); ++i)
                if (seen.sights.texel[i] != kNoTexel &&
                    seen.sights.distance[i] >= s.length[i] + epsilon)  // else covered
                    add(i, seen.sights.texel[i], seen.sights.distance[i], Vec3(1));
            for (const Sight& sight : seen.sights.others)
                if (sight.texel != kNoTexel && sight.covered &&
                    (sight.inMirror || sight.distance >= s.length[sight.ray] + epsilon))
                    add(sight.ray, sight.texel, sight.distance, sight.throughput);
        };
        addEnds(s.forward, s.backward, lines.exits);
        addEnds(s.backward, s.forward, lines.entries);
    });
}

void DeltaLines::addTo(std::span<Vec3> change, std::span<std::uint8_t> touched,
                       std::vector<std::uint32_t>& texels,
                       std::span<const Vec3> ownRadiance) const {
    for (const std::vector<End>& block : blocks_)
        for (const End& end : block) {
            const Vec3 own =
                end.receiver == ObjectReceivers::kNone ? Vec3(0) : ownRadiance[end.receiver];
            change[end.texel] += end.gain * (own - end.lost);
            if (!touched[end.texel]) {
                touched[end.texel] = 1;
                texels.push_back(end.texel);
            }
        }
}

std::size_t DeltaLines::bytes() const {
    std::size_t sum = 0;
    for (const std::vector<End>& block : blocks_) sum += block.capacity() * sizeof(End);
    return sum;
}

}  // namespace vlf
