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
    std::vector<Vec3> radiance;  ///< of the room along the ray
    std::vector<Sight> sights;
    std::vector<std::uint8_t> within;

    void clear() { rays.clear(); }

    void look(SightTracer& tracer, std::span<const Vec3> texelRadiance) {
        const std::vector<Sight>& found = tracer.trace(rays);
        sights.assign(found.begin(), found.end());
        within = tracer.within();
        radiance.assign(rays.size(), Vec3(0));
        for (const Sight& s : sights) {
            Vec3& sum = radiance[s.ray];
            sum += s.throughput * diffuseRadiance(s, texelRadiance, {});
            if (!s.emissionApart) sum += s.throughput * s.emission;
        }
    }
};

}  // namespace

/// Memory of one thread's block.
struct DeltaLines::Scratch {
    Views forward, backward, again;
    std::vector<std::uint32_t> cells, retry;
    std::vector<float> length;
    std::vector<InstanceHit> hits;
    std::vector<Ray> reflected;
};

namespace {

/// Marks rays on which another object is met first.
void findHidden(const SightObjects& objects, const Views& views, std::vector<InstanceHit>& hits,
                std::vector<float>& nearest) {
    nearest.assign(views.rays.size(), std::numeric_limits<float>::infinity());
    if (!objects.rays || objects.lit.size() < 2) return;
    hits.resize(views.rays.size());
    objects.rays->closest(views.rays, hits);
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i] && hits[i].instance != objects.own) nearest[i] = hits[i].hit.t;
}

}  // namespace

void DeltaLines::trace(const ObjectLines& lines, const Pose& pose, const Scene& scene,
                       const RayScene& rays, const RoomTexels& room, const SightObjects& objects,
                       std::span<const Vec3> texelRadiance) {
    const std::size_t blocks = (lines.directions.size() + kLinesPerBlock - 1) / kLinesPerBlock;
    blocks_.resize(blocks);
    const float epsilon = kContact * rays.epsilon();
    const float area = lines.cellArea * pose.scale * pose.scale;
    parallelFor(blocks, 1, [&](std::size_t block) {
        thread_local Scratch scratch;
        Scratch& s = scratch;
        std::vector<End>& ends = blocks_[block];
        ends.clear();
        s.forward.clear(), s.backward.clear(), s.length.clear();
        const std::size_t end = std::min(lines.directions.size(), (block + 1) * kLinesPerBlock);
        const std::uint32_t first = lines.firstCell[block * kLinesPerBlock];
        std::vector<float> weight;
        for (std::size_t k = block * kLinesPerBlock; k < end; ++k) {
            const Vec3 direction = pose.direction(lines.directions[k]);
            for (std::uint32_t c = lines.firstCell[k]; c < lines.firstCell[k + 1]; ++c) {
                const Vec3 entry = pose.point(lines.entries[c].point);
                const Vec3 exit = pose.point(lines.exits[c].point);
                s.forward.rays.push_back({entry + epsilon * direction, direction});
                s.backward.rays.push_back({exit - epsilon * direction, -direction});
                s.length.push_back(glm::distance(entry, exit));
                weight.push_back(lines.weights[k] * area);
            }
        }
        SightTracer tracer(scene, rays, room);
        s.forward.look(tracer, texelRadiance);
        s.backward.look(tracer, texelRadiance);
        std::vector<float> hiddenF, hiddenB;
        findHidden(objects, s.forward, s.hits, hiddenF);
        findHidden(objects, s.backward, s.hits, hiddenB);
        const auto add = [&](const Views& seen, const Views& lost, const std::vector<float>& hidden,
                             const std::vector<LineEnd>& objectEnds) {
            for (const Sight& sight : seen.sights) {
                const std::uint32_t i = sight.ray;
                if (sight.texel == kNoTexel || room.area[sight.texel] <= 0) continue;
                // Covered by the object, or seen by another one.
                if (!sight.inMirror && sight.distance < s.length[i] + epsilon) continue;
                if (hidden[i] < sight.distance) continue;
                const std::uint32_t receiver = objectEnds[first + i].receiver;
                const float gain = weight[i] / room.area[sight.texel];
                ends.push_back({sight.texel, receiver, lost.radiance[i], gain * sight.throughput});
            }
        };
        add(s.forward, s.backward, hiddenF, lines.exits);
        add(s.backward, s.forward, hiddenB, lines.entries);
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
