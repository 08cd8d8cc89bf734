#include "vlf/dynamic/dynamic_room.h"

#include "vlf/base/error.h"
#include "vlf/dynamic/light_exchange.h"
#include "vlf/field/direction_set.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace vlf {

namespace {

constexpr int kMaxLines = 513;
constexpr std::size_t kMaxMirrors = 16;
constexpr float kSameWay = 1e-4f;  // of mirrors that face alike: 1 less the cosine
/// An object that seems smaller than this from another (radius by distance) does not matter to it.
constexpr float kNoticed = 0.02f;

void require(bool ok, const DynamicObject& object, const char* what) {
    if (!ok) throw InputError("the object '" + object.name + "' " + what);
}

void checkPose(const DynamicObject& object, const Pose& pose) {
    require(isValid(pose), object,
            "has a pose that is none: it takes finite numbers, a scale above zero and a rotation "
            "of length one");
}

void check(const DynamicObject& object) {
    const ObjectSettings& s = object.settings;
    require(object.model != nullptr, object, "has no model");
    checkPose(object, object.pose);
    require(s.directSamples >= 1 && s.directSamples <= 1024, object,
            "needs from 1 to 1024 samples of direct light");
    require(s.gather.subdivision >= 0 && s.gather.subdivision <= ObjectModel::kMaxSubdivision,
            object, "can be subdivided from 0 to 3 times");
    require(DirectionSet::exists(s.gather.lines), object,
            "gathers over direction sets of 2·4ⁿ + 1 lines: 129, 513, 2049 or 8193");
    require(s.gather.importanceSamples >= 0, object,
            "picks directions by importance, at least one, or with 0 follows all of them");
    require(s.gather.step >= 1, object, "takes every step-th direction: the step is 1 or more");
    require(std::isfinite(s.gather.texelSize) && s.gather.texelSize >= 0, object,
            "needs texels of a size above 0 m, or of 0 for one that suits it");
    require(s.prt.order >= 1 && s.prt.order <= 5, object,
            "can have spherical harmonics of order 1 to 5");
    require(s.hard.mapSize >= 16 && s.hard.mapSize <= 8192, object,
            "can have a shadow map of 16 to 8192 texels");
    require(s.hard.opacity >= 0 && s.hard.opacity <= 1, object,
            "can have a shadow of an opacity from 0 to 1");
}

struct FlatMirror {
    Vec3 normal;
    float offset;  ///< dot(normal, p) of its points
};

/// The mirrors of a room by what they show of objects.
struct RoomMirrors {
    std::vector<FlatMirror> planes;
    bool simple = true;  ///< all are flat, face the same way and are not many: none shows another
};

RoomMirrors mirrorsOf(const Scene& scene, const LightField& field, const RoomTexels& texels) {
    RoomMirrors mirrors;
    for (std::size_t c = 0; c < field.charts.size(); ++c) {
        const Chart& chart = field.charts[c];
        if (!scene.materials[chart.material].isMirror(MirrorKind::perfect)) continue;
        mirrors.planes.push_back({chart.normal, texels.sources.mirrorOffset[c]});
        mirrors.simple = mirrors.simple && texels.sources.planarMirror[c] &&
                         mirrors.planes.size() <= kMaxMirrors &&
                         glm::dot(chart.normal, mirrors.planes.front().normal) > 1 - kSameWay;
    }
    return mirrors;
}

}  // namespace

struct DynamicRoom::Impl {
    struct Entry {
        DynamicObject object;
        std::unique_ptr<ObjectLight> light;
        bool unprepared = true, changed = true;
        bool stale = true;  ///< has not looked about since something changed
        Sphere sphere;      ///< around it in the update before
    };

    /// Where an object was or is that has changed.
    struct Disturbance {
        const Entry* by;
        Sphere sphere;
    };

    Impl(const Scene& s, const RayScene& rays, const LightField& f)
        : scene(s), field(f), exchange(s, rays, f), mirrors(mirrorsOf(s, f, exchange.texels())) {}

    static Sphere sphereOf(const DynamicObject& object) {
        const Sphere& bounds = object.model->bounds();
        // Light from one that emits is noticed everywhere.
        const float radius = object.model->emits() ? std::numeric_limits<float>::infinity()
                                                   : object.pose.scale * bounds.radius;
        return {object.pose.point(bounds.centre), radius};
    }

    /// Makes all plans before any is used: where one cannot be made nothing has changed.
    void prepare() {
        const float cell = 2 * field.frame.radius / static_cast<float>(field.record.cells);
        std::vector<std::pair<Entry*, ObjectLight::Plans>> made;
        for (Entry& entry : entries)
            if (entry.object.visible && entry.unprepared)
                made.emplace_back(
                    &entry, ObjectLight::makePlans(entry.object, plans,
                                                   std::min(field.record.directions, kMaxLines),
                                                   cell, exchange.texels().unwrap.texelSize));
        for (auto& [entry, of] : made) {
            entry->light->prepare(entry->object, std::move(of));
            entry->unprepared = false;
        }
    }

    /// Which objects have changed, or have one near by that has.
    void findStale() {
        disturbances.clear();
        for (Entry& entry : entries) {
            if (!entry.changed) continue;
            disturbances.push_back({&entry, entry.sphere});
            entry.sphere = sphereOf(entry.object);
            disturbances.push_back({&entry, entry.sphere});
            entry.changed = false;
            entry.stale = true;
        }
        for (Entry& entry : entries) {
            const bool disturbed =
                allStale ||
                std::any_of(disturbances.begin(), disturbances.end(), [&](const Disturbance& d) {
                    return d.by != &entry &&
                           d.sphere.radius >
                               kNoticed * glm::distance(d.sphere.centre, entry.sphere.centre);
                });
            if (disturbed) entry.light->forget();
            entry.stale = entry.stale || disturbed || entry.light->misses(entry.object, viewers);
        }
        allStale = false;
    }

    void update() {
        prepare();
        findViewers();
        findStale();
        bodies.clear(), numbers.clear();
        for (std::size_t i = 0; i < entries.size(); ++i) {
            Entry& entry = entries[i];
            if (!entry.object.visible) continue;
            bodies.push_back({&entry.object, entry.light.get(), std::exchange(entry.stale, false)});
            numbers.push_back(i);
        }
        exchange.run(bodies, viewers);
        ++lightVersion;
        changed = false;
    }

    /// Objects have other numbers than before.
    void renumbered() { allStale = changed = true; }

    Entry& change(std::size_t i) {
        changed = entries[i].changed = true;
        return entries[i];
    }

    /// Viewers are the eyes and their images in the room's mirrors; none, which means from
    /// anywhere, where mirrors show all sides.
    void findViewers() {
        viewers.clear();
        const bool mirrorObject =
            std::any_of(entries.begin(), entries.end(), [](const Entry& entry) {
                return entry.object.visible && entry.object.model->mirrors();
            });
        if (!mirrors.simple || mirrorObject) return;
        viewers = eyes;
        for (const FlatMirror& mirror : mirrors.planes)
            for (const Vec3& eye : eyes) {
                const float height = glm::dot(mirror.normal, eye) - mirror.offset;
                if (height > 0) viewers.push_back(eye - 2 * height * mirror.normal);
            }
    }

    const Scene& scene;
    const LightField& field;
    ObjectPlans plans;
    LightExchange exchange;
    RoomMirrors mirrors;
    std::vector<Entry> entries;
    std::vector<Disturbance> disturbances;
    std::vector<Body> bodies;
    std::vector<std::size_t> numbers;
    std::vector<Vec3> eyes, viewers;  ///< without their images and with them
    std::uint32_t lightsMade = 0;     ///< of objects, ever
    std::uint64_t lightVersion = 0;
    bool changed = false, allStale = false;
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
    Impl::Entry& entry = impl_->entries.emplace_back();
    entry.object = std::move(object);
    entry.light = std::make_unique<ObjectLight>(impl_->lightsMade++);
    impl_->renumbered();
}

void DynamicRoom::remove(std::size_t i) {
    impl_->entries.erase(impl_->entries.begin() + static_cast<std::ptrdiff_t>(i));
    impl_->renumbered();
}

void DynamicRoom::setPose(std::size_t i, const Pose& pose) {
    const DynamicObject& object = impl_->entries[i].object;
    if (object.pose == pose) return;
    checkPose(object, pose);
    Impl::Entry& entry = impl_->change(i);
    // What is made for an object depends on its scale.
    entry.unprepared = entry.unprepared || pose.scale != entry.object.pose.scale;
    entry.object.pose = pose;
}

void DynamicRoom::setSettings(std::size_t i, const ObjectSettings& settings) {
    const DynamicObject& object = impl_->entries[i].object;
    if (object.settings == settings) return;
    DynamicObject other = object;
    other.settings = settings;
    check(other);
    Impl::Entry& entry = impl_->change(i);
    entry.object.settings = settings;
    entry.unprepared = true;
}

void DynamicRoom::setModel(std::size_t i, std::shared_ptr<const ObjectModel> model) {
    DynamicObject other = impl_->entries[i].object;
    other.model = model;
    check(other);
    Impl::Entry& entry = impl_->change(i);
    entry.object.model = std::move(model);
    entry.unprepared = true;
}

void DynamicRoom::setVisible(std::size_t i, bool visible) {
    if (impl_->entries[i].object.visible == visible) return;
    impl_->entries[i].object.visible = visible;
    impl_->renumbered();
}

void DynamicRoom::setViewers(std::span<const Vec3> eyes) {
    impl_->eyes.assign(eyes.begin(), eyes.end());
    impl_->findViewers();
    impl_->changed =
        impl_->changed ||
        std::any_of(impl_->entries.begin(), impl_->entries.end(), [&](const Impl::Entry& entry) {
            return entry.object.visible && entry.light->misses(entry.object, impl_->viewers);
        });
}

void DynamicRoom::setRoomIrradiance(const IrradianceAtlas& atlas) {
    impl_->exchange.setRoomLight(atlas);
    for (Impl::Entry& entry : impl_->entries) entry.light->forget();
    impl_->renumbered();
    ++impl_->lightVersion;
}

bool DynamicRoom::update() {
    if (!impl_->changed) return false;
    impl_->update();
    return true;
}

std::span<const LitObject> DynamicRoom::litObjects() const {
    return impl_->exchange.lit();
}
std::span<const std::size_t> DynamicRoom::litNumbers() const {
    return impl_->numbers;
}
const RayInstances& DynamicRoom::rays() const {
    return impl_->exchange.rays();
}
const IrradianceAtlas& DynamicRoom::irradiance() const {
    return impl_->exchange.light();
}
const IrradianceAtlas& DynamicRoom::roomIrradiance() const {
    return impl_->exchange.roomLight();
}
std::uint64_t DynamicRoom::irradianceVersion() const {
    return impl_->lightVersion;
}
const PointLight* DynamicRoom::hardShadowLight() const {
    const PointLighting& points = impl_->exchange.pointLighting();
    return points.lights.empty() ? nullptr : &points.lights.front();
}
const UpdateTimes& DynamicRoom::updateTimes() const {
    return impl_->exchange.times();
}
const Scene& DynamicRoom::scene() const {
    return impl_->scene;
}
const LightField& DynamicRoom::field() const {
    return impl_->field;
}

}  // namespace vlf
