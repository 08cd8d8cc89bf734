#include "vlf/dynamic/object_light.h"

#include "vlf/base/parallel.h"
#include "vlf/dynamic/soft_shadow.h"

#include <algorithm>
#include <utility>

namespace vlf {

namespace {

constexpr std::size_t kReceiversPerBlock = 16;
constexpr float kCacheCell = 0.05f;   // of the object's diameter
constexpr float kTurnedAway = -0.1f;  // cosine: its neighbours may be seen
constexpr int kFewestTexels = 200, kMostTexels = 6400;
constexpr float kLeastCells = 6, kMostCells = 64;  // over an object's diameter

/// Half as wide as the room's, a few hundred at least, in steps, so that an object that is scaled
/// little keeps them.
int texelsOf(const DynamicObject& object, float roomTexel) {
    const Scene& scene = object.model->scene();
    float surface = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) surface += area(scene, t);
    const float scale = object.pose.scale / (0.5f * roomTexel);
    int texels = kFewestTexels;
    while (texels < kMostTexels && static_cast<float>(texels) < surface * scale * scale)
        texels *= 2;
    return texels;
}

}  // namespace

ObjectLight::Plans ObjectLight::makePlans(const DynamicObject& object, ObjectPlans& plans,
                                          int lines, float roomCell, float roomTexel) {
    Plans made{plans.plan(object, texelsOf(object, roomTexel)), nullptr};
    if (object.settings.shadow != ShadowKind::field) return made;
    const float diameter = 2 * object.model->bounds().radius;
    const float cell =
        std::clamp(roomCell / object.pose.scale, diameter / kMostCells, diameter / kLeastCells);
    made.lines = plans.linesPlan(made.plan, lines, cell);
    return made;
}

void ObjectLight::prepare(const DynamicObject& object, Plans plans) {
    plan_ = std::move(plans.plan);
    lines_ = std::move(plans.lines);
    cache_.clear();
    const ObjectReceivers& receivers = *plan_->receivers;
    irradiance_.assign(receivers.size(), Vec3(0));
    direct_ = radiance_ = irradiance_;
    lit_.mesh = receivers.mesh;
    if (receivers.areTexels()) {
        atlas_ = {receivers.unwrap->atlasWidth, receivers.unwrap->atlasHeight, {}};
        atlas_.irradiance.assign(receivers.unwrap->atlasSize(), Vec3(0));
        lit_.texels = &receivers.texels;
        lit_.atlas = &atlas_;
        lit_.vertexIrradiance = {};
    } else {
        lit_.texels = nullptr;
        lit_.atlas = nullptr;
        lit_.vertexIrradiance = irradiance_;
    }
    lit_.pose = object.pose;
    ++lit_.version;
}

/// Whether the side that a receiver is on faces a viewer, or nearly.
bool ObjectLight::showsTo(const DynamicObject& object, std::size_t receiver,
                          std::span<const Vec3> viewers) const {
    const ObjectReceivers& receivers = *plan_->receivers;
    const Vec3 position = object.pose.point(receivers.position[receiver]);
    const Vec3 normal = object.pose.direction(receivers.geometric[receiver]);
    return std::any_of(viewers.begin(), viewers.end(), [&](const Vec3& eye) {
        const Vec3 toEye = eye - position;
        return glm::dot(normal, toEye) > kTurnedAway * glm::length(toEye);
    });
}

/// All of it where light goes on from it to the room or to other parts of it.
void ObjectLight::findWanted(const DynamicObject& object, std::span<const Vec3> viewers) {
    wanted_.clear();
    if (viewers.empty() || lines_ || !object.settings.gather.onlyVisible ||
        !plan_->gather.inside.all.empty())
        return;
    wanted_.resize(plan_->receivers->size());
    for (std::size_t r = 0; r < wanted_.size(); ++r) wanted_[r] = showsTo(object, r, viewers);
}

bool ObjectLight::misses(const DynamicObject& object, std::span<const Vec3> viewers) const {
    if (wanted_.empty()) return false;
    for (std::size_t r = 0; r < wanted_.size(); ++r)
        if (!wanted_[r] && (viewers.empty() || showsTo(object, r, viewers))) return true;
    return false;
}

std::unique_ptr<const ObjectEmitters> ObjectLight::emitters(const DynamicObject& object,
                                                            const LitRoom& room,
                                                            std::uint32_t own) const {
    return plan_->emitting ? makeEmitters(object, *plan_->emitting, room.scene, room.texels, own)
                           : nullptr;
}

void ObjectLight::look(const DynamicObject& object, const Surroundings& around, std::uint32_t own) {
    lit_.pose = object.pose;
    number_ = own;
    const SightObjects objects{&around.instances, around.lit, own};
    findWanted(object, around.viewers);
    if (plan_->shading == Shading::gather) lookForGather(object, around, objects);
    if (lines_)
        delta_.trace(lines_->data, *lit_.mesh, object.pose, around.room, objects, around.coverage);
}

void ObjectLight::lookForGather(const DynamicObject& object, const Surroundings& around,
                                const SightObjects& objects) {
    const GatherSettings& settings = object.settings.gather;
    const ObjectReceivers& receivers = *plan_->receivers;
    traced_ = wanted_;
    if (settings.cache) {
        const Sphere& bounds = object.model->bounds();
        cache_.begin(kCacheCell * 2 * bounds.radius * object.pose.scale);
        traced_.resize(receivers.size(), 1);
        for (std::size_t r = 0; r < receivers.size(); ++r)
            if (cache_.find(object.pose.point(receivers.position[r]),
                            object.pose.direction(receivers.normal[r])))
                traced_[r] = 0;
    }
    sights_.pickDirections(plan_->gather, object.model->bounds().centre, settings.importanceSamples,
                           object.pose, around.room, objects);
    sights_.trace(plan_->gather, receivers, object.pose, around.room, objects, around.coverage,
                  traced_, settings.emittersByDirections);
    if (settings.emittersByDirections)
        std::fill(direct_.begin(), direct_.end(), Vec3(0));
    else
        findDirect(object, around);
}

/// Of the room's emitters and of the other objects'.
void ObjectLight::findDirect(const DynamicObject& object, const Surroundings& around) {
    const ObjectReceivers& receivers = *plan_->receivers;
    const std::size_t blocks = (receivers.size() + kReceiversPerBlock - 1) / kReceiversPerBlock;
    const RoomTexels& room = around.room.texels;
    parallelFor(blocks, 1, [&](std::size_t block) {
        LightGatherer gatherer(around.room.scene, around.room.rays, room.unwrap, room.sources, 0);
        gatherer.setExtraOccluder(occluderOf(around.instances));
        EmittedLight emitted(around.room.rays, room, around.instances);
        const std::size_t end = std::min(receivers.size(), (block + 1) * kReceiversPerBlock);
        for (std::size_t r = block * kReceiversPerBlock; r < end; ++r) {
            direct_[r] = Vec3(0);
            if (!wanted_.empty() && !wanted_[r]) continue;
            LightReceiver receiver = receivers.light[r];
            receiver.pose = &object.pose;
            receiver.centre = object.pose.point(receiver.centre);
            receiver.normal = object.pose.direction(receiver.normal);
            receiver.radius *= object.pose.scale;
            direct_[r] = gatherer.irradiance(receiver, object.settings.directSamples, 0).value;
            for (const auto& emitters : around.emitters)
                if (emitters && emitters->number != number_)
                    direct_[r] +=
                        emitted.irradiance(*emitters, object.pose.point(receivers.position[r]),
                                           object.pose.direction(receivers.normal[r]),
                                           object.pose.direction(receivers.geometric[r]));
        }
    });
}

void ObjectLight::guess(const Vec3& irradiance) {
    std::fill(irradiance_.begin(), irradiance_.end(), irradiance);
    publish();
}

void ObjectLight::find(const DynamicObject& object, const Surroundings& around) {
    switch (plan_->shading) {
        case Shading::flat:
            std::fill(irradiance_.begin(), irradiance_.end(), around.meanIrradiance);
            break;
        case Shading::lights:
            shadeByLights(around.points, *lit_.mesh, object.pose, around.room.rays, irradiance_);
            break;
        case Shading::gather:
            gather(object, around);
            break;
        case Shading::prt:
            applyTransfer(*plan_->transfer, incident_, irradiance_);
            break;
    }
    publish();
}

bool ObjectLight::seesObjects() const {
    return plan_->shading == Shading::gather && sights_.seesObjects();
}

void ObjectLight::gather(const DynamicObject& object, const Surroundings& around) {
    const ObjectReceivers& receivers = *plan_->receivers;
    sights_.gather(plan_->gather, receivers, around.radiance, around.lit, direct_, irradiance_);
    if (object.settings.gather.cache)
        for (std::size_t r = 0; r < receivers.size(); ++r) {
            const Vec3 position = object.pose.point(receivers.position[r]);
            const Vec3 normal = object.pose.direction(receivers.normal[r]);
            if (traced_[r])
                cache_.store(position, normal, irradiance_[r]);
            else if (const auto known = cache_.find(position, normal))
                irradiance_[r] = *known;
        }
    for (std::size_t r = 0; r < receivers.size(); ++r) irradiance_[r] += direct_[r];
}

void ObjectLight::findIncident(const DynamicObject& object, const Surroundings& around) {
    if (!scratch_) scratch_ = std::make_unique<IncidentLightFinder::Scratch>(around.incident);
    around.incident.find(plan_->transfer->box, object.pose, around.radiance,
                         {&around.instances, around.lit, number_}, *scratch_, incident_);
}

void ObjectLight::publish() {
    const ObjectReceivers& receivers = *plan_->receivers;
    for (std::size_t r = 0; r < receivers.size(); ++r)
        radiance_[r] = receivers.reflectance[r] * irradiance_[r] / kPi;
    if (receivers.areTexels())
        for (std::size_t t = 0; t < receivers.source.size(); ++t)
            if (receivers.source[t] != ObjectReceivers::kNone)
                atlas_.irradiance[t] = irradiance_[receivers.source[t]];
    ++lit_.version;
}

void ObjectLight::addChange(RoomChange& change) const {
    if (lines_) delta_.addTo(change, radiance_);
}

}  // namespace vlf
