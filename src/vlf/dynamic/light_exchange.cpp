// Read this first. An update of the light between a room and its objects:
//
//   1. place the objects and find what of the room they cover;
//   2. look about: trace the rays along which objects see the room (gather_sights.h) and the lines
//      that they cut (delta_transport.h), and sample emitters from their surfaces;
//   3. take the direct light out of the room that objects block (soft_shadow.h), put in what they
//      emit (object_emitters.h);
//   4. exchange: object light from the room's, the room's from the objects', what has changed
//      bouncing on (change_bounce.h), and the objects' once more.
//
// No step depends on the update before (but for GatherSettings::cache), so that the same poses give
// the same light.

#include "vlf/dynamic/light_exchange.h"

#include "vlf/base/parallel.h"
#include "vlf/dynamic/soft_shadow.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace vlf {

namespace {

constexpr int kShadowSamples = 5;       // of a texel, for each of an object's own
constexpr float kSlightShadow = 1e-3f;  // of the room's mean irradiance
constexpr float kLeastAmbient = 5e-4f;  // of the room's mean irradiance

class Stopwatch {
  public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

bool takesDirectLight(const DynamicObject& object) {
    return object.settings.shadow == ShadowKind::soft ||
           object.settings.shadow == ShadowKind::field;
}

bool isTransferred(const Body& body) {
    return body.object->settings.shading == Shading::prt;
}

/// Whether its light is found by what it sees of the room.
bool seesRoom(const Body& body) {
    return body.object->settings.shading == Shading::gather || isTransferred(body);
}

Vec3 mean(const RoomTexels& texels, const IrradianceAtlas& atlas) {
    glm::dvec3 sum(0);
    for (const std::uint32_t t : texels.unwrap.texels)
        sum += glm::dvec3(atlas.irradiance[t]) * static_cast<double>(texels.area[t]);
    return texels.totalArea > 0 ? Vec3(sum / static_cast<double>(texels.totalArea)) : Vec3(0);
}

}  // namespace

LightExchange::LightExchange(const Scene& scene, const RayScene& rays, const LightField& field)
    : scene_(scene),
      roomRays_(rays),
      texels_(makeRoomTexels(scene, rays, field)),
      incident_(scene, rays, texels_),
      coverage_(texels_),
      change_(texels_),
      softShadows_(scene, rays, texels_) {
    setRoomLight(field.atlas);
}

void LightExchange::setRoomLight(const IrradianceAtlas& atlas) {
    roomLight_ = light_ = atlas;
    roomRadiance_.assign(atlas.irradiance.size(), Vec3(0));
    for (const std::uint32_t t : texels_.unwrap.texels)
        roomRadiance_[t] = texels_.reflectance[t] * atlas.irradiance[t] / kPi;
    radiance_ = shadedRadiance_ = roomRadiance_;
    radianceKnown_ = false;
    shaded_.clear();
    meanIrradiance_ = mean(texels_, atlas);
    double flux = 0;
    for (const std::uint32_t t : texels_.unwrap.texels)
        flux += texels_.area[t] * kPi * maxComponent(roomRadiance_[t]);
    roomFlux_ = static_cast<float>(flux);
    pointsKnown_ = false;
}

void LightExchange::run(std::span<const Body> bodies, std::span<const Vec3> viewers) {
    Stopwatch watch;
    bodies_.assign(bodies.begin(), bodies.end());
    place();
    findPointLights();
    findEmitters();
    coverage_.restore(texels_, roomLight_, light_);
    coverage_.find(scene_, roomRays_, texels_, instances_, lit_, spheres_);
    times_.place = watch.lap();
    const Surroundings around{litRoom(), radiance_, instances_, lit_,    coverage_,
                              incident_, points_,   emitters_,  viewers, meanIrradiance_};
    for (std::uint32_t i = 0; i < bodies_.size(); ++i)
        if (bodies_[i].stale) bodies_[i].light->look(*bodies_[i].object, around, i);
    times_.look = watch.lap();
    findShadows();
    times_.shadows = watch.lap();
    exchange(around);
    coverage_.fill(texels_, light_);
    for (std::size_t i = 0; i < lit_.size(); ++i) lit_[i] = bodies_[i].light->lit();
    times_.exchange = watch.lap();
}

void LightExchange::place() {
    lit_.clear(), spheres_.clear(), placed_.clear(), casters_.clear(), shadowCasters_.clear();
    for (const Body& body : bodies_) {
        const DynamicObject& object = *body.object;
        lit_.push_back(body.light->lit());
        lit_.back().pose = object.pose;
        placed_.push_back({&lit_.back().mesh->rays, object.pose});
        const Sphere& bounds = object.model->bounds();
        spheres_.push_back({object.pose.point(bounds.centre), object.pose.scale * bounds.radius});
        if (!takesDirectLight(object)) continue;
        casters_.push_back(placed_.back());
        shadowCasters_.push_back(casterOf(*object.model, object.pose));
    }
    instances_.place(placed_);
    casterInstances_.place(casters_);
}

/// Only where somebody asks for them.
void LightExchange::findPointLights() {
    const bool needed = std::any_of(bodies_.begin(), bodies_.end(), [](const Body& body) {
        const ObjectSettings& s = body.object->settings;
        return s.shading == Shading::lights || s.shadow == ShadowKind::hard;
    });
    if (needed && !std::exchange(pointsKnown_, true))
        points_ = estimatePointLights(scene_, roomRays_, texels_, roomLight_);
}

void LightExchange::findEmitters() {
    emitters_.clear();
    for (std::uint32_t i = 0; i < bodies_.size(); ++i)
        emitters_.push_back(bodies_[i].light->emitters(*bodies_[i].object, litRoom(), i));
}

void LightExchange::findShadows() {
    shadows_.clear(), weakShadows_.clear(), emitted_.clear();
    int samples = 1;
    for (const Body& body : bodies_)
        samples = std::max(samples, body.object->settings.directSamples);
    if (!casters_.empty()) {
        const TexelLoss& loss =
            softShadows_.find(coverage_, casterInstances_, shadowCasters_, kShadowSamples * samples,
                              kSlightShadow * luminance(meanIrradiance_));
        for (std::size_t i = 0; i < loss.entries.size(); ++i)
            if (loss.loss[i] != Vec3(0))
                shadows_.push_back({texels_.unwrap.texels[loss.entries[i]], -loss.loss[i]});
        for (std::size_t i = 0; i < loss.groups.size(); ++i)
            weakShadows_.push_back({loss.groups[i], -loss.groupLoss[i]});
    }
    for (const auto& emitters : emitters_)
        if (emitters && takesDirectLight(*bodies_[emitters->number].object))
            findEmittedLight(*emitters, scene_, roomRays_, texels_, coverage_, instances_,
                             emitted_);
    if (emitted_.empty()) return;
    if (!sweep_) sweep_.emplace(litRoom());
    sweep_->bounce(litRoom(), emitted_);
}

/// What the room sends if only its direct light is changed.
void LightExchange::shadeRoom() {
    for (const std::uint32_t t : shaded_) shadedRadiance_[t] = roomRadiance_[t];
    shaded_.clear();
    for (const TexelChange& t : shadows_) {
        const Vec3 sent =
            shadedRadiance_[t.texel] + texels_.reflectance[t.texel] * t.irradiance / kPi;
        shadedRadiance_[t.texel] = glm::max(Vec3(0), sent);
        shaded_.push_back(t.texel);
    }
}

/// Objects that change the room's indirect light are lit by the room with their shadows first, and
/// then by what they and these have made of it. Objects see one another, too: those that do are lit
/// twice or more, first by others of which the light is but guessed.
void LightExchange::exchange(const Surroundings& around) {
    const bool indirect = std::any_of(bodies_.begin(), bodies_.end(),
                                      [](const Body& body) { return body.light->changesRoom(); });
    const bool changes =
        indirect || !shadows_.empty() || !weakShadows_.empty() || !emitted_.empty();
    roomChanges_ = std::exchange(changedBefore_, changes) || changes;
    bounce_.clear();
    for (const Body& body : bodies_)
        if (isDue(body)) body.light->guess(meanIrradiance_);
    if (indirect) {
        shadeRoom();
        Surroundings alone = around;
        alone.radiance = shadedRadiance_;
        findObjectLight(alone);
        findLightOfSeers(alone);
    }
    changeRoom(true);
    if (roomChanges_) radianceKnown_ = false;
    if (!radianceKnown_ && std::ranges::any_of(bodies_, seesRoom)) {
        change_.findRadiance(roomLight_, radiance_);
        radianceKnown_ = true;
    }
    findObjectLight(around);
    if (indirect)
        changeRoom(false);
    else
        findLightOfSeers(around);
    change_.apply(roomLight_, light_);
}

bool LightExchange::isDue(const Body& body) const {
    return !isTransferred(body) || body.stale || roomChanges_;
}

/// The change of the room's light by shadows and objects, `bouncing` anew.
void LightExchange::changeRoom(bool bouncing) {
    change_.clear();
    for (const TexelChange& t : shadows_) change_.add(t.texel, t.irradiance);
    for (const auto& [group, irradiance] : weakShadows_) change_.addToGroup(group, irradiance);
    for (const Body& body : bodies_) body.light->addChange(change_);
    if (bouncing && !change_.texels().empty()) {
        if (bounceRays_.empty()) bounceRays_ = BounceRays(scene_, roomRays_, texels_);
        bounce_.find(change_, bounceRays_, texels_, coverage_, {instances_, spheres_}, roomFlux_);
    }
    bounce_.addTo(change_, kLeastAmbient * luminance(meanIrradiance_));
    for (const TexelChange& t : emitted_) change_.add(t.texel, t.irradiance);
}

/// Those of precomputed transfer are many and quick, the others use all threads themselves. All
/// light that comes to the first is found before any on them changes, and not again where nothing
/// that they see has changed.
void LightExchange::findObjectLight(const Surroundings& around) {
    const auto forTransferred = [&](auto work) {
        parallelFor(bodies_.size(), [&](std::size_t i) {
            const Body& body = bodies_[i];
            if (isTransferred(body) && isDue(body)) work(body);
        });
    };
    forTransferred([&](const Body& body) { body.light->findIncident(*body.object, around); });
    forTransferred([&](const Body& body) { body.light->find(*body.object, around); });
    findOthersLight(around);
}

void LightExchange::findOthersLight(const Surroundings& around) {
    for (const Body& body : bodies_)
        if (!isTransferred(body)) body.light->find(*body.object, around);
}

/// Once more, of those that see objects: by the light found on these.
void LightExchange::findLightOfSeers(const Surroundings& around) {
    for (const Body& body : bodies_)
        if (!isTransferred(body) && body.light->seesObjects())
            body.light->find(*body.object, around);
}

}  // namespace vlf
