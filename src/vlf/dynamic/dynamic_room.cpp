#include "vlf/dynamic/dynamic_room.h"

#include "vlf/base/error.h"
#include "vlf/dynamic/change_bounce.h"
#include "vlf/dynamic/object_light.h"
#include "vlf/dynamic/room_change.h"
#include "vlf/dynamic/soft_shadow.h"

#include <algorithm>
#include <utility>

namespace vlf {

namespace {

constexpr int kMaxLines = 513;
constexpr int kRounds = 2;
constexpr int kShadowSamples = 4;  // for each of an object's own

void check(const DynamicObject& object) {
    if (!object.model) throw InputError("an object needs a model");
    if (!isValid(object.pose))
        throw InputError("the object '" + object.name +
                         "' has a pose that is no pose: finite numbers, a scale above zero and a "
                         "rotation of length one are needed");
}

Vec3 meanIrradiance(const RoomTexels& room, const IrradianceAtlas& atlas) {
    glm::dvec3 sum(0);
    double area = 0;
    for (const std::uint32_t t : room.unwrap.texels) {
        sum += glm::dvec3(atlas.irradiance[t]) * static_cast<double>(room.area[t]);
        area += room.area[t];
    }
    return area > 0 ? Vec3(sum / area) : Vec3(0);
}

bool castsSoftShadow(const DynamicObject& object) {
    return object.settings.shadow == ShadowKind::soft ||
           object.settings.shadow == ShadowKind::field;
}

}  // namespace

struct DynamicRoom::Impl {
    struct Entry {
        DynamicObject object;
        std::unique_ptr<ObjectLight> light = std::make_unique<ObjectLight>();
        bool unprepared = true;
    };

    Impl(const Scene& s, const RayScene& r, const LightField& f)
        : scene(s),
          roomRays(r),
          field(f),
          room(makeRoomTexels(s, r, f)),
          change(room),
          coverage(room) {
        setRoomLight(f.atlas);
    }

    void setRoomLight(const IrradianceAtlas& atlas) {
        roomLight = atlas;
        light = atlas;
        roomRadiance.assign(atlas.irradiance.size(), Vec3(0));
        for (const std::uint32_t t : room.unwrap.texels)
            roomRadiance[t] = room.reflectance[t] * atlas.irradiance[t] / kPi;
        radiance = roomRadiance;
        mean = meanIrradiance(room, atlas);
        ++lightVersion;
    }

    /// The visible objects, where they are.
    void place() {
        std::vector<RayInstance> instances;
        lit.clear(), numbers.clear(), spheres.clear(), casters.clear(), allSpheres.clear();
        for (std::size_t i = 0; i < entries.size(); ++i) {
            Entry& entry = entries[i];
            const DynamicObject& object = entry.object;
            if (!object.visible) continue;
            if (std::exchange(entry.unprepared, false))
                entry.light->prepare(
                    object, plans, std::min(field.record.directions, kMaxLines),
                    2 * field.frame.radius / static_cast<float>(field.record.cells));
            numbers.push_back(i);
            lit.push_back(entry.light->lit());
            lit.back().pose = object.pose;
            instances.push_back({&lit.back().mesh->rays, object.pose});
            const Sphere& bounds = object.model->bounds();
            allSpheres.push_back(
                {object.pose.point(bounds.centre), object.pose.scale * bounds.radius});
            if (castsSoftShadow(object)) {
                spheres.push_back(allSpheres.back());
                casters.push_back(instances.back());
            }
        }
        rays.place(instances);
        casterRays.place(casters);
    }

    Surroundings surroundings() const {
        return {scene, roomRays, room, roomRadiance, radiance, rays, lit, coverage, mean};
    }

    /// Light goes back and forth between room and objects.
    void exchange() {
        change.clear();
        change.apply(room, roomLight, light, radiance);
        const Surroundings around = surroundings();
        coverage.find(scene, roomRays, room, rays, lit, allSpheres);
        for (std::uint32_t i = 0; i < lit.size(); ++i)
            entries[numbers[i]].light->look(entries[numbers[i]].object, around, i);
        const TexelLoss loss = spheres.empty() ? TexelLoss{}
                                               : findSoftShadows(scene, roomRays, room, coverage,
                                                                 spheres, occluderOf(casterRays),
                                                                 kShadowSamples * shadowSamples());
        shadows.clear();
        for (std::size_t i = 0; i < loss.entries.size(); ++i)
            if (loss.loss[i] != Vec3(0))
                shadows.push_back({room.unwrap.texels[loss.entries[i]], -loss.loss[i]});
        for (int round = 0; round < kRounds; ++round) {
            change.clear();
            for (const TexelChange& t : shadows) change.add(t.texel, t.irradiance);
            for (std::uint32_t i = 0; i < lit.size(); ++i) {
                ObjectLight& onObject = *entries[numbers[i]].light;
                onObject.find(entries[numbers[i]].object, around);
                onObject.addChange(change.change, change.touched, change.texels);
            }
            if (round + 1 == kRounds && !shadows.empty())
                bounce.add(shadows, scene, roomRays, room, coverage, {&rays, lit, kNoObject}, {},
                           change);
            change.apply(room, roomLight, light, radiance);
        }
        coverage.fill(room, light);
        for (std::size_t i = 0; i < lit.size(); ++i) lit[i] = entries[numbers[i]].light->lit();
        ++lightVersion;
    }

    int shadowSamples() const {
        int most = 1;
        for (const std::size_t i : numbers)
            most = std::max(most, entries[i].object.settings.directSamples);
        return most;
    }

    const Scene& scene;
    const RayScene& roomRays;
    const LightField& field;
    RoomTexels room;
    IrradianceAtlas roomLight, light;
    std::vector<Vec3> roomRadiance, radiance;  ///< diffuse, leaving the texels
    Vec3 mean{0};
    std::uint64_t lightVersion = 0;
    std::vector<Entry> entries;
    ObjectPlans plans;
    std::vector<LitObject> lit;
    std::vector<std::size_t> numbers;
    RayInstances rays, casterRays;  ///< of all; of those whose shadows are sampled
    std::vector<RayInstance> casters;
    std::vector<Sphere> spheres;  ///< around the casters
    RoomChange change;
    Coverage coverage;
    std::vector<TexelChange> shadows;
    ChangeBounce bounce;
    std::vector<Sphere> allSpheres;  ///< around the lit objects
    PointLighting points;
    bool changed = false;
};
DynamicRoom::DynamicRoom(const Scene& scene, const RayScene& rays, const LightField& field)
    : impl_(std::make_unique<Impl>(scene, rays, field)) {}
DynamicRoom::~DynamicRoom() = default;
DynamicRoom::DynamicRoom(DynamicRoom&&) noexcept = default;
DynamicRoom& DynamicRoom::operator=(DynamicRoom&&) noexcept = default;

std::size_t DynamicRoom::size() const {
    return impl_->entries.size();
}
const DynamicObject& DynamicRoom::object(std::size_t i) const {
    return impl_->entries[i].object;
}

void DynamicRoom::add(DynamicObject object) {
    check(object);
    impl_->entries.emplace_back().object = std::move(object);
    impl_->changed = true;
}

void DynamicRoom::remove(std::size_t i) {
    impl_->entries.erase(impl_->entries.begin() + static_cast<std::ptrdiff_t>(i));
    impl_->changed = true;
}

void DynamicRoom::setPose(std::size_t i, const Pose& pose) {
    Impl::Entry& entry = impl_->entries[i];
    if (entry.object.pose == pose) return;
    DynamicObject moved = entry.object;
    moved.pose = pose;
    check(moved);
    entry.unprepared = entry.unprepared || pose.scale != entry.object.pose.scale;
    entry.object.pose = pose;
    impl_->changed = true;
}

void DynamicRoom::setSettings(std::size_t i, const ObjectSettings& settings) {
    Impl::Entry& entry = impl_->entries[i];
    if (entry.object.settings == settings) return;
    entry.object.settings = settings;
    entry.unprepared = impl_->changed = true;
}

void DynamicRoom::setModel(std::size_t i, std::shared_ptr<const ObjectModel> model) {
    impl_->entries[i].object.model = std::move(model);
    impl_->entries[i].unprepared = impl_->changed = true;
}

void DynamicRoom::setVisible(std::size_t i, bool visible) {
    if (impl_->entries[i].object.visible == visible) return;
    impl_->entries[i].object.visible = visible;
    impl_->changed = true;
}

void DynamicRoom::setViewers(std::span<const Vec3>) {}

void DynamicRoom::setRoomIrradiance(const IrradianceAtlas& atlas) {
    impl_->setRoomLight(atlas);
    impl_->changed = true;
}

bool DynamicRoom::update() {
    if (!std::exchange(impl_->changed, false)) return false;
    impl_->place();
    impl_->exchange();
    return true;
}

std::span<const LitObject> DynamicRoom::litObjects() const {
    return impl_->lit;
}
std::span<const std::size_t> DynamicRoom::litNumbers() const {
    return impl_->numbers;
}
const RayInstances& DynamicRoom::rays() const {
    return impl_->rays;
}
const IrradianceAtlas& DynamicRoom::irradiance() const {
    return impl_->light;
}
const IrradianceAtlas& DynamicRoom::roomIrradiance() const {
    return impl_->roomLight;
}
std::uint64_t DynamicRoom::irradianceVersion() const {
    return impl_->lightVersion;
}
const PointLighting& DynamicRoom::pointLighting() const {
    return impl_->points;
}
const PointLight* DynamicRoom::hardShadowLight() const {
    return impl_->points.lights.empty() ? nullptr : &impl_->points.lights.front();
}
const Scene& DynamicRoom::scene() const {
    return impl_->scene;
}
const LightField& DynamicRoom::field() const {
    return impl_->field;
}

}  // namespace vlf
