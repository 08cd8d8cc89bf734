#include "vlf/dynamic/change_bounce.h"

#include "vlf/base/parallel.h"

#include <algorithm>
#include <array>
#include <bit>

namespace vlf {

namespace {

constexpr std::size_t kGroupsAtOnce = 16;
constexpr int kSide = RoomTexels::kGroupSide;
constexpr float kPortion = 2.5e-8f;  // of the room's flux, that a ray carries
constexpr float kFewestRays = 16;    // of a group
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
    const Vec3 a = room.place[from], way = room.place[to] - a;
    const auto near = [&](const Sphere& sphere) { return passes(sphere, a, way); };
    return std::any_of(spheres.begin(), spheres.end(), near) &&
           instances.occluded({a, way, kEnds, 1 - kEnds});
}

/// What groups of texels send on.
struct ChangeBounce::Sender {
    const RoomChange& change;
    const BounceRays& rays;
    const RoomTexels& room;
    const Coverage& coverage;
    const ObjectsBetween& objects;
    float portion;  ///< flux of a ray, where there are enough

    void send(std::uint32_t group, std::vector<Parcel>& parcels) const {
        change.variesIn(group) ? sendFromTexels(group, parcels) : sendFromAll(group, parcels);
    }

  private:
    void sendFromAll(std::uint32_t g, std::vector<Parcel>& parcels) const {
        Vec3 flux(0);
        for (std::uint32_t block = 4 * g; block < 4 * g + 4; ++block)
            flux += room.blockReflects[block] * change.ofBlock(block);
        if (flux == Vec3(0)) return;
        const Shares shares(size(flux) / portion, kFewestRays, rays.perGroup());
        follow(g, shares.count(), kEvenReach, parcels,
               [&](std::uint32_t i, std::uint32_t) { return shares.of(i) * flux; });
    }

    void sendFromTexels(std::uint32_t g, std::vector<Parcel>& parcels) const {
        const TexelGroup& group = room.groups[g];
        std::array<Vec3, kSide * kSide> sent;
        float all = 0;
        for (std::uint32_t i = group.first; i < group.first + group.count; ++i) {
            const std::uint32_t t = room.unwrap.texels[room.grouped[i]];
            const Vec3 own =
                room.reflectance[t] * change.of(t) * (room.area[t] * coverage.uncovered(t));
            sent[room.placeOf[t]] = static_cast<float>(group.count) * own;
            all += size(own);
        }
        if (all == 0) return;
        const Shares shares(all / portion, std::min<float>(64, rays.perGroup()), rays.perGroup());
        follow(g, shares.count(), 0, parcels, [&](std::uint32_t i, std::uint32_t texel) {
            return shares.of(i) * sent[room.placeOf[texel]];
        });
    }

    /// The first rays of a group; fluxOf(ray, texel it starts from).
    template <class FluxOf>
    void follow(std::uint32_t group, std::uint32_t count, int leastReach,
                std::vector<Parcel>& parcels, FluxOf fluxOf) const {
        const auto launches = rays.of(group);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t from = launches[i].texel;
            for (const BounceRays::Arrival& arrival : rays.arrivals(launches[i]))
                if (!objects.block(from, arrival.texel, room))
                    parcels.push_back({arrival.unit, numberOf(arrival),
                                       std::max<int>(arrival.reach, leastReach),
                                       arrival.throughput * fluxOf(i, from)});
        }
    }

    std::uint32_t numberOf(const BounceRays::Arrival& arrival) const {
        if (arrival.unit == BounceRays::Unit::texel) return arrival.texel;
        return arrival.unit == BounceRays::Unit::block ? room.blockOf[arrival.texel]
                                                       : room.groupOf[arrival.texel];
    }
};

void ChangeBounce::deal(const Parcel& parcel, const RoomTexels& room) {
    if (parcel.unit == BounceRays::Unit::texel)
        spread(parcel, room);
    else
        (parcel.unit == BounceRays::Unit::block ? blocks_ : groups_)[parcel.number] += parcel.flux;
}

/// Over a square of texels around the one it has come to that is as wide as rays lie apart there.
void ChangeBounce::spread(const Parcel& parcel, const RoomTexels& room) {
    const Unwrap& unwrap = room.unwrap;
    const Chart& chart = unwrap.charts[unwrap.texelChart[room.entryOf[parcel.number]]];
    const auto x = static_cast<int>(parcel.number % unwrap.atlasWidth - chart.x);
    const auto y = static_cast<int>(parcel.number / unwrap.atlasWidth - chart.y);
    const int reach = parcel.reach;
    const std::size_t first = near_.size();
    float area = 0;
    for (int v = std::max(0, y - reach); v <= std::min<int>(chart.height - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min<int>(chart.width - 1, x + reach); ++u) {
            const std::uint32_t t = (chart.y + v) * unwrap.atlasWidth + chart.x + u;
            if (room.area[t] <= 0 || room.hidden[t]) continue;
            area += room.area[t];
            near_.push_back({t, parcel.flux});
        }
    for (std::size_t i = first; i < near_.size(); ++i) near_[i].irradiance /= area;
    again_ += room.reflectance[parcel.number] * parcel.flux;
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
    clear();
    const Sender sender{change,   rays,    room,
                        coverage, objects, std::max(kPortion * roomFlux, 1e-30f)};
    parcels_.resize((room.groups.size() + kGroupsAtOnce - 1) / kGroupsAtOnce);
    parallelFor(parcels_.size(), 1, [&](std::size_t k) {
        parcels_[k].clear();
        const std::size_t end = std::min(room.groups.size(), (k + 1) * kGroupsAtOnce);
        for (std::size_t g = k * kGroupsAtOnce; g < end; ++g)
            sender.send(static_cast<std::uint32_t>(g), parcels_[k]);
    });
    for (const std::vector<Parcel>& some : parcels_)
        for (const Parcel& parcel : some) deal(parcel, room);
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
