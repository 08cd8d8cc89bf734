#include "vlf/dynamic/dynamic_room.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/dynamic/sight.h"
#include "vlf/field/direction_set.h"

#include <utility>

namespace vlf {

namespace {

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

}  // namespace

struct DynamicRoom::Impl {
    struct Entry {
        DynamicObject object;
        std::vector<Vec3> irradiance;
        bool stale = true;
        std::uint64_t version = 0;
    };

    Impl(const Scene& s, const RayScene& r, const LightField& f)
        : scene(s),
          roomRays(r),
          field(f),
          room(makeRoomTexels(s, r, f)),
          roomLight(f.atlas),
          light(f.atlas) {}

    void light_(Entry& entry) {
        const ObjectMesh& mesh = entry.object.model->mesh(entry.object.settings.gather.subdivision);
        entry.irradiance.assign(mesh.sidedVertexCount(), meanIrradiance(room, light));
        ++entry.version;
        entry.stale = false;
    }

    const Scene& scene;
    const RayScene& roomRays;
    const LightField& field;
    RoomTexels room;
    IrradianceAtlas roomLight, light;
    std::uint64_t lightVersion = 0;
    std::vector<Entry> entries;
    std::vector<LitObject> lit;
    std::vector<std::size_t> numbers;
    RayInstances rays;
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
    impl_->entries.push_back({std::move(object), {}});
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
    entry.object.pose = pose;
    entry.stale = impl_->changed = true;
}

void DynamicRoom::setSettings(std::size_t i, const ObjectSettings& settings) {
    Impl::Entry& entry = impl_->entries[i];
    if (entry.object.settings == settings) return;
    entry.object.settings = settings;
    entry.stale = impl_->changed = true;
}

void DynamicRoom::setModel(std::size_t i, std::shared_ptr<const ObjectModel> model) {
    impl_->entries[i].object.model = std::move(model);
    impl_->entries[i].stale = impl_->changed = true;
}

void DynamicRoom::setVisible(std::size_t i, bool visible) {
    if (impl_->entries[i].object.visible == visible) return;
    impl_->entries[i].object.visible = visible;
    impl_->changed = true;
}

void DynamicRoom::setViewers(std::span<const Vec3>) {}

void DynamicRoom::setRoomIrradiance(const IrradianceAtlas& atlas) {
    impl_->roomLight = impl_->light = atlas;
    ++impl_->lightVersion;
    for (Impl::Entry& entry : impl_->entries) entry.stale = true;
    impl_->changed = true;
}

bool DynamicRoom::update() {
    if (!std::exchange(impl_->changed, false)) return false;
    impl_->lit.clear(), impl_->numbers.clear();
    std::vector<RayInstance> instances;
    for (std::size_t i = 0; i < impl_->entries.size(); ++i) {
        Impl::Entry& entry = impl_->entries[i];
        if (!entry.object.visible) continue;
        if (entry.stale) impl_->light_(entry);
        LitObject lit;
        lit.mesh = &entry.object.model->mesh(entry.object.settings.gather.subdivision);
        lit.pose = entry.object.pose;
        lit.vertexIrradiance = entry.irradiance;
        lit.version = entry.version;
        impl_->lit.push_back(lit);
        impl_->numbers.push_back(i);
        instances.push_back({&lit.mesh->rays, lit.pose});
    }
    impl_->rays.place(instances);
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
