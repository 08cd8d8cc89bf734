#include "vlf/dynamic/change_bounce.h"

#include <algorithm>
#include <bit>

namespace vlf {

namespace {

constexpr float kPortion = 2.5e-8f;  // of the room's flux, that a ray carries
constexpr float kFewestRays = 16;    // of a group
/// From this far on, in radii of a group, what arrives at one of its texels counts for them all,
/// and where rays lie farther apart than this many texels, for a block of them: few rays would make
/// single texels flicker.
constexpr float kFar = 5;
constexpr int kSquare = 2;
constexpr float kSpread = 0.6f;
/// A ray of a group that changes evenly may stand for 4 of its texels: too much for one other.
constexpr int kEvenReach = 1;

float size(const Vec3& flux) {
    return maxComponent(glm::abs(flux));  // a ray of any colour carries no more than another
}

/// How the flux of a group is shared by its first rays: the more, the more of them, and as evenly
/// as it changes.
class Shares {
  public:
    Shares(float wanted, float fewest, int most) {
        wanted = std::clamp(wanted, fewest, static_cast<float>(most));
        all_ = std::bit_ceil(static_cast<std::uint32_t>(std::ceil(wanted)));
        const auto all = static_cast<float>(all_);
        const float mix = 2 * wanted / all - 1;
        second_ = mix / all;
        first_ = second_ + (1 - mix) * 2 / all;
    }

    std::uint32_t count() const { return all_; }
    float of(std::uint32_t ray) const { return 2 * ray < all_ ? first_ : second_; }

  private:
    std::uint32_t all_;
    float first_, second_;
};

Vec3 placeOf(std::uint32_t texel, const Scene& scene, const RoomTexels& room) {
    const auto points = room.unwrap.points.of(room.entryOf[texel]);
    const SurfacePoint& p = points[points.size() / 2];
    return positionAt(scene, p.triangle, p.barycentric);
}

bool passes(const Sphere& sphere, const Vec3& from, const Vec3& way) {
    const Vec3 toCentre = sphere.centre - from;
    const float along =
        std::clamp(glm::dot(toCentre, way) / std::max(glm::dot(way, way), 1e-20f), 0.0f, 1.0f);
    const Vec3 miss = toCentre - along * way;
    return glm::dot(miss, miss) < sphere.radius * sphere.radius;
}

}  // namespace

bool ObjectsBetween::block(std::uint32_t from, std::uint32_t to, const RoomTexels& room) const {
    constexpr float kEnds = 1e-3f;  // of the way, where an object may touch a texel
    const Vec3 a = placeOf(from, scene, room), way = placeOf(to, scene, room) - a;
    const auto near = [&](const Sphere& sphere) { return passes(sphere, a, way); };
    return std::any_of(spheres.begin(), spheres.end(), near) &&
           instances.occluded({a, way, kEnds, 1 - kEnds});
}

void ChangeBounce::send(const RoomChange& change, std::uint32_t g, const BounceRays& rays,
                        const RoomTexels& room, const Coverage& coverage,
                        const ObjectsBetween& objects, float portion) {
    const TexelGroup& group = room.groups[g];
    const auto launches = rays.of(g);
    Vec3 flux(0);
    if (!change.variesIn(g)) {
        for (std::uint32_t block = 4 * g; block < 4 * g + 4; ++block)
            flux += room.blockReflects[block] * change.ofBlock(block);
        if (flux == Vec3(0)) return;
        const Shares shares(size(flux) / portion, kFewestRays, rays.perGroup());
        for (std::uint32_t i = 0; i < shares.count(); ++i)
            for (const BounceRays::Arrival& arrival : rays.arrivals(launches[i]))
                if (!objects.block(launches[i].texel, arrival.texel, room))
                    arrive(arrival, kEvenReach, shares.of(i) * flux, room);
        return;
    }
    float all = 0;
    for (std::uint32_t i = group.first; i < group.first + group.count; ++i) {
        const std::uint32_t t = room.unwrap.texels[room.grouped[i]];
        const Vec3 sent =
            room.reflectance[t] * change.of(t) * (room.area[t] * coverage.uncovered(t));
        sent_[room.placeOf[t]] = static_cast<float>(group.count) * sent;
        all += size(sent);
    }
    if (all == 0) return;
    const Shares shares(all / portion, std::min<float>(64, rays.perGroup()), rays.perGroup());
    for (std::uint32_t i = 0; i < shares.count(); ++i)
        for (const BounceRays::Arrival& arrival : rays.arrivals(launches[i]))
            if (!objects.block(launches[i].texel, arrival.texel, room))
                arrive(arrival, 0, shares.of(i) * sent_[room.placeOf[launches[i].texel]], room);
}

void ChangeBounce::arrive(const BounceRays::Arrival& arrival, int leastReach, const Vec3& sent,
                          const RoomTexels& room) {
    if (room.hidden[arrival.texel]) return;
    const Vec3 flux = arrival.throughput * sent;
    const std::uint32_t block = room.blockOf[arrival.texel];
    const TexelGroup& group = room.groups[block / 4];
    if (arrival.distance > kFar * group.bounds.radius) {
        groups_[block / 4] += flux;
        return;
    }
    const Unwrap& unwrap = room.unwrap;
    const Chart& chart = unwrap.charts[unwrap.texelChart[room.entryOf[arrival.texel]]];
    const int reach = static_cast<int>(kSpread * arrival.distance / chart.texelSize() + 0.5f);
    if (reach > kSquare)
        blocks_[block] += flux;
    else
        spread(arrival, std::max(reach, leastReach), flux, room);
}

/// Over a square of texels around the one it has come to that is as wide as rays lie apart there.
void ChangeBounce::spread(const BounceRays::Arrival& arrival, int reach, const Vec3& flux,
                          const RoomTexels& room) {
    const Unwrap& unwrap = room.unwrap;
    const Chart& chart = unwrap.charts[unwrap.texelChart[room.entryOf[arrival.texel]]];
    const auto x = static_cast<int>(arrival.texel % unwrap.atlasWidth - chart.x);
    const auto y = static_cast<int>(arrival.texel / unwrap.atlasWidth - chart.y);
    const std::size_t first = near_.size();
    float area = 0;
    for (int v = std::max(0, y - reach); v <= std::min<int>(chart.height - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min<int>(chart.width - 1, x + reach); ++u) {
            const std::uint32_t t = (chart.y + v) * unwrap.atlasWidth + chart.x + u;
            if (room.area[t] <= 0 || room.hidden[t]) continue;
            area += room.area[t];
            near_.push_back({t, flux});
        }
    for (std::size_t i = first; i < near_.size(); ++i) near_[i].irradiance /= area;
    again_ += room.reflectance[arrival.texel] * flux;
}

void ChangeBounce::collect(const RoomTexels& room) {
    for (std::uint32_t g = 0; g < room.groups.size(); ++g) {
        Vec3 reflects(0);
        for (std::uint32_t b = 4 * g; b < 4 * g + 4; ++b) {
            reflects += room.blockReflects[b];
            if (blocks_[b] == Vec3(0)) continue;
            blocks_[b] /= room.blockArea[b];
            again_ += room.blockReflects[b] * blocks_[b];
        }
        if (room.groups[g].area > 0) groups_[g] /= room.groups[g].area;
        again_ += reflects * groups_[g];
    }
    ambient_ = room.totalArea > 0 ? again_ * room.gain() / room.totalArea : Vec3(0);
}

void ChangeBounce::clear() {
    near_.clear();
    std::fill(groups_.begin(), groups_.end(), Vec3(0));
    std::fill(blocks_.begin(), blocks_.end(), Vec3(0));
    again_ = ambient_ = Vec3(0);
    found_ = false;
}

void ChangeBounce::find(const RoomChange& change, const BounceRays& rays, const RoomTexels& room,
                        const Coverage& coverage, const ObjectsBetween& objects, float roomFlux) {
    groups_.resize(room.groups.size());
    blocks_.resize(room.blockArea.size());
    sent_.resize(RoomTexels::kGroupSide * RoomTexels::kGroupSide);
    clear();
    const float portion = std::max(kPortion * roomFlux, 1e-30f);
    for (std::uint32_t g = 0; g < room.groups.size(); ++g)
        send(change, g, rays, room, coverage, objects, portion);
    collect(room);
    found_ = true;
}

void ChangeBounce::addTo(RoomChange& change, float leastAmbient) const {
    if (!found_) return;
    for (const TexelChange& t : near_) change.add(t.texel, t.irradiance);
    for (std::uint32_t b = 0; b < blocks_.size(); ++b) change.addToBlock(b, blocks_[b]);
    for (std::uint32_t g = 0; g < groups_.size(); ++g) change.addToGroup(g, groups_[g]);
    if (size(ambient_) > leastAmbient) change.addToAll(ambient_);
}

}  // namespace vlf
