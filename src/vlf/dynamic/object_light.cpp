#include "vlf/dynamic/object_light.h"

#include "vlf/base/parallel.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr std::size_t kReceiversPerBlock = 16;
constexpr float kLeastCells = 6, kMostCells = 64;  // over an object's diameter

}  // namespace

ExtraOccluder occluderOf(const RayInstances& instances) {
    return [&instances, own = std::vector<std::uint8_t>()](
               std::span<const Ray> rays, std::span<std::uint8_t> blocked) mutable {
        own.resize(rays.size());
        instances.occluded(rays, own);
        for (std::size_t i = 0; i < own.size(); ++i) blocked[i] |= own[i];
    };
}

void ObjectLight::prepare(const DynamicObject& object, ObjectPlans& plans, int lines,
                          float roomCell) {
    plan_ = plans.plan(object);
    const float diameter = 2 * object.model->bounds().radius;
    const float cell =
        std::clamp(roomCell / object.pose.scale, diameter / kMostCells, diameter / kLeastCells);
    lines_ =
        object.settings.shadow == ShadowKind::field ? plans.linesPlan(plan_, lines, cell) : nullptr;
    const ObjectReceivers& receivers = *plan_->receivers;
    irradiance_.assign(receivers.size(), Vec3(0));
    own_ = direct_ = radiance_ = irradiance_;
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

void ObjectLight::look(const DynamicObject& object, const Surroundings& around, std::uint32_t own) {
    lit_.pose = object.pose;
    const SightObjects objects{&around.instances, around.lit, own};
    std::fill(irradiance_.begin(), irradiance_.end(), Vec3(0));
    std::fill(own_.begin(), own_.end(), Vec3(0));
    if (plan_->gathers) {
        sights_.trace(plan_->gather, object.pose, around.scene, around.rays, around.room, objects,
                      around.coverage, object.settings.gather.emittersByDirections);
        if (object.settings.gather.emittersByDirections)
            std::fill(direct_.begin(), direct_.end(), Vec3(0));
        else
            findDirect(object, around);
    }
    if (lines_)
        delta_.trace(lines_->data, object.pose, around.scene, around.rays, around.room, objects,
                     around.coverage, around.roomRadiance);
}

void ObjectLight::findDirect(const DynamicObject& object, const Surroundings& around) {
    const ObjectReceivers& receivers = *plan_->receivers;
    const std::size_t blocks = (receivers.size() + kReceiversPerBlock - 1) / kReceiversPerBlock;
    parallelFor(blocks, 1, [&](std::size_t block) {
        LightGatherer gatherer(around.scene, around.rays, around.room.unwrap, around.room.sources,
                               0);
        gatherer.setExtraOccluder(occluderOf(around.instances));
        const std::size_t end = std::min(receivers.size(), (block + 1) * kReceiversPerBlock);
        for (std::size_t r = block * kReceiversPerBlock; r < end; ++r) {
            LightReceiver receiver = receivers.light[r];
            receiver.pose = &object.pose;
            receiver.centre = object.pose.point(receiver.centre);
            receiver.normal = object.pose.direction(receiver.normal);
            receiver.radius *= object.pose.scale;
            direct_[r] = gatherer.irradiance(receiver, object.settings.directSamples, 0).value;
        }
    });
}

void ObjectLight::find(const DynamicObject& object, const Surroundings& around) {
    const ObjectReceivers& receivers = *plan_->receivers;
    if (object.settings.shading == Shading::gather) {
        own_ = irradiance_;
        irradiance_ = direct_;
        sights_.gather(plan_->gather, receivers, around.radiance, around.lit, own_, irradiance_);
    } else {
        std::fill(irradiance_.begin(), irradiance_.end(), around.meanIrradiance);
    }
    publish();
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

void ObjectLight::addChange(std::span<Vec3> change, std::span<std::uint8_t> touched,
                            std::vector<std::uint32_t>& texels) {
    if (lines_) delta_.addTo(change, touched, texels, radiance_);
}

}  // namespace vlf
