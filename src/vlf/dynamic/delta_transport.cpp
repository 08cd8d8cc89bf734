#include "vlf/dynamic/delta_transport.h"

#include "vlf/base/parallel.h"

#include <algorithm>
#include <limits>

namespace vlf {

namespace {

constexpr std::size_t kLinesPerBlock = 32;
constexpr float kContact = 4;     // ray epsilons: nearer than this a surface is covered
constexpr float kEnough = 12;     // lines to a texel, block or group
constexpr float kNoise = 0.002f;  // of its irradiance

/// What one end of each line of a block sees of the room.
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

/// Memory of a thread.
struct Scratch {
    Views forward, backward;            ///< from entries along the lines, from exits against them
    std::vector<float> length, weight;  ///< of the lines: within the object, m; flux per radiance
    std::vector<Vec3> shown, reflectance;  ///< by a mirror at an end, radiance
    std::vector<std::uint32_t> mirrors;
    std::vector<Ray> reflected;
    std::vector<InstanceHit> hits;
    Sights sights;
};

/// The smooth part of the environment.
bool isOutside(const Sight& sight) {
    return !sight.emissionApart && sight.triangle == kNoTriangle;
}

void findHidden(const SightObjects& objects, std::vector<InstanceHit>& hits, Views& views) {
    views.hidden.assign(views.rays.size(), std::numeric_limits<float>::infinity());
    if (!objects.rays || objects.lit.size() < 2) return;
    hits.resize(views.rays.size());
    objects.rays->closestBut(objects.own, views.rays, hits);
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i]) views.hidden[i] = hits[i].hit.t;
}

}  // namespace

/// Some of the lines.
class DeltaLines::Block {
  public:
    Block(const ObjectLines& lines, const ObjectMesh& mesh, const Pose& pose, const LitRoom& room,
          const SightObjects& objects, const Coverage& coverage, Scratch& scratch)
        : lines_(lines),
          mesh_(mesh),
          pose_(pose),
          room_(room),
          objects_(objects),
          coverage_(coverage),
          s_(scratch),
          tracer_(room.scene, room.rays, room.texels),
          epsilon_(kContact * room.rays.epsilon()) {}

    void trace(std::size_t firstLine, std::size_t lastLine, std::vector<End>& ends) {
        first_ = lines_.firstCell[firstLine];
        castRays(firstLine, lastLine);
        for (Views* views : {&s_.forward, &s_.backward}) {
            views->look(tracer_, room_.radiance);
            findHidden(objects_, s_.hits, *views);
        }
        ends.clear();
        addEnds(s_.forward, s_.backward, lines_.exits, ends);
        addEnds(s_.backward, s_.forward, lines_.entries, ends);
    }

  private:
    void castRays(std::size_t firstLine, std::size_t lastLine) {
        s_.forward.rays.clear(), s_.backward.rays.clear(), s_.length.clear(), s_.weight.clear();
        const float area = lines_.cellArea * pose_.scale * pose_.scale;
        for (std::size_t k = firstLine; k < lastLine; ++k) {
            const Vec3 direction = pose_.direction(lines_.directions[k]);
            for (std::uint32_t c = lines_.firstCell[k]; c < lines_.firstCell[k + 1]; ++c) {
                const Vec3 entry = pose_.point(lines_.entries[c].point);
                const Vec3 exit = pose_.point(lines_.exits[c].point);
                s_.forward.rays.push_back({entry + epsilon_ * direction, direction});
                s_.backward.rays.push_back({exit - epsilon_ * direction, -direction});
                s_.length.push_back(glm::dot(exit - entry, direction));
                s_.weight.push_back(lines_.weights[k] * area);
            }
        }
    }

    /// What the object's mirrors show of the room at the ends that `seen` looks out from.
    void findShown(const Views& seen, const std::vector<LineEnd>& objectEnds) {
        const Scene& scene = mesh_.scene;
        s_.shown.assign(seen.rays.size(), Vec3(0));
        s_.mirrors.clear(), s_.reflected.clear(), s_.reflectance.clear();
        for (std::uint32_t i = 0; i < seen.rays.size(); ++i) {
            const LineEnd& end = objectEnds[first_ + i];
            const Material& material = scene.material(end.triangle);
            if (!material.isMirror()) continue;
            Vec3 side = pose_.direction(geometricNormal(scene, end.triangle));
            Vec3 normal = pose_.direction(shadingNormalAt(scene, end.triangle, end.barycentric));
            const Vec3 incoming = -seen.rays[i].direction;
            if (glm::dot(side, incoming) > 0) side = -side;
            if (glm::dot(normal, side) < 0) normal = -normal;
            const Vec3 out = glm::reflect(incoming, normal);
            if (glm::dot(out, side) <= 0) continue;
            s_.mirrors.push_back(i);
            s_.reflected.push_back({pose_.point(end.point) + epsilon_ * side, out});
            s_.reflectance.push_back(
                mirrorReflectance(scene, material, uvAt(scene, end.triangle, end.barycentric)));
        }
        if (s_.mirrors.empty()) return;
        tracer_.trace(s_.reflected, s_.sights);
        for (std::size_t k = 0; k < s_.mirrors.size(); ++k)
            if (s_.sights.texel[k] != kNoTexel)
                s_.shown[s_.mirrors[k]] += s_.reflectance[k] * room_.radiance[s_.sights.texel[k]];
        for (const Sight& sight : s_.sights.others)
            s_.shown[s_.mirrors[sight.ray]] += s_.reflectance[sight.ray] * sight.throughput *
                                               (diffuseRadiance(sight, room_.radiance, {}) +
                                                (isOutside(sight) ? sight.emission : Vec3(0)));
    }

    void addEnds(const Views& seen, const Views& lost, const std::vector<LineEnd>& objectEnds,
                 std::vector<End>& ends) {
        findShown(seen, objectEnds);
        const auto add = [&](std::size_t i, std::uint32_t texel, float distance, bool inMirror,
                             const Vec3& throughput) {
            const bool covered = !inMirror && distance < s_.length[i] + epsilon_;
            if (covered || seen.hidden[i] < distance || room_.texels.hidden[texel]) return;
            const Unit unit = unitAt(texel, distance, s_.weight[i]);
            const float area = areaOf(unit, texel);
            if (area > 0)
                ends.push_back({unit, numberOf(unit, texel), objectEnds[first_ + i].receiver,
                                lost.radiance[i] - s_.shown[i], s_.weight[i] / area * throughput});
        };
        for (std::size_t i = 0; i < seen.rays.size(); ++i)
            if (seen.sights.texel[i] != kNoTexel)
                add(i, seen.sights.texel[i], seen.sights.distance[i], false, Vec3(1));
        for (const Sight& sight : seen.sights.others)
            if (sight.texel != kNoTexel && sight.covered)
                add(sight.ray, sight.texel, sight.distance, sight.inMirror, sight.throughput);
    }

    /// The smallest that enough lines reach, of n a steradian n a / d², for their noise to be
    /// slight: n a / d² of them, each of irradiance w L / a beside π L. But not wider than half of
    /// the way to it.
    Unit unitAt(std::uint32_t texel, float distance, float weight) const {
        const float squared = distance * distance;
        const float perArea = static_cast<float>(2 * lines_.entries.size()) / (4 * kPi * squared);
        const float noise = weight / (kPi * kNoise);
        const float needed = std::max(kEnough / perArea, noise * noise * perArea);  // m²
        const float area = room_.texels.area[texel];
        if (area >= needed || 4 * 16 * area > squared) return Unit::texel;
        return 16 * area >= needed || 4 * 64 * area > squared ? Unit::block : Unit::group;
    }
    std::uint32_t numberOf(Unit unit, std::uint32_t texel) const {
        if (unit == Unit::texel) return texel;
        return unit == Unit::block ? room_.texels.blockOf[texel] : room_.texels.groupOf[texel];
    }
    float areaOf(Unit unit, std::uint32_t texel) const {
        const float uncovered = coverage_.uncovered(texel);
        if (unit == Unit::texel || uncovered <= 0) return room_.texels.area[texel] * uncovered;
        return unit == Unit::block ? room_.texels.blockArea[numberOf(unit, texel)]
                                   : room_.texels.groups[numberOf(unit, texel)].area;
    }

    const ObjectLines& lines_;
    const ObjectMesh& mesh_;
    const Pose& pose_;
    const LitRoom& room_;
    const SightObjects& objects_;
    const Coverage& coverage_;
    Scratch& s_;
    SightTracer tracer_;
    float epsilon_;
    std::uint32_t first_ = 0;  ///< cell of the block
};

void DeltaLines::trace(const ObjectLines& lines, const ObjectMesh& mesh, const Pose& pose,
                       const LitRoom& room, const SightObjects& objects, const Coverage& coverage) {
    const std::size_t blocks = (lines.directions.size() + kLinesPerBlock - 1) / kLinesPerBlock;
    blocks_.resize(blocks);
    parallelFor(blocks, 1, [&](std::size_t b) {
        thread_local Scratch scratch;
        const std::size_t end = std::min(lines.directions.size(), (b + 1) * kLinesPerBlock);
        Block(lines, mesh, pose, room, objects, coverage, scratch)
            .trace(b * kLinesPerBlock, end, blocks_[b]);
    });
}

void DeltaLines::addTo(RoomChange& change, std::span<const Vec3> ownRadiance) const {
    for (const std::vector<End>& block : blocks_)
        for (const End& end : block) {
            const Vec3 own =
                end.receiver == ObjectReceivers::kNone ? Vec3(0) : ownRadiance[end.receiver];
            const Vec3 irradiance = end.gain * (own - end.lost);
            switch (end.unit) {
                case Unit::texel:
                    change.add(end.number, irradiance);
                    break;
                case Unit::block:
                    change.addToBlock(end.number, irradiance);
                    break;
                case Unit::group:
                    change.addToGroup(end.number, irradiance);
                    break;
            }
        }
}

}  // namespace vlf
