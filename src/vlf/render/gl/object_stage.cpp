#include "vlf/render/gl/object_stage.h"

#include <string>
#include <utility>

namespace vlf::gl {

void ObjectStage::update(const DynamicRoom& room) {
    if (!change_) change_.emplace(scene_, field_, looksUp_);
    change_->update(room.irradiance(), room.roomIrradiance());
    objects_.update(room);
    objects_.setChange(*change_);
    shadows_.update(room, objects_.spheres());
    probesStale_ = true;
}

void ObjectStage::drawShadows(const std::function<void()>& drawRoom) {
    if (!shadows_.stale()) return;
    const GLuint room = shaders_.program("shadow", {});
    const GLuint object = shaders_.program("shadow", {{"OBJECT", 1}});
    objects_.bind();
    shadows_.draw(room, object, drawRoom, [&](std::size_t i) { objects_.drawTriangles(i); });
}

void ObjectStage::drawProbes(float nearest, const ReflectionProbes::DrawFace& drawFace) {
    if (!std::exchange(probesStale_, false)) return;
    probes_.draw(objects_.probeCentres(), nearest, drawFace);
}

void ObjectStage::bind() const {
    objects_.bind();
    change_->bind();
    probes_.bind();
    if (!shadows_.empty()) shadows_.bind();
}

void ObjectStage::addDefines(Defines& defines, bool mirror, bool traced, bool probed) const {
    if (!shadows_.empty()) defines.add({"SHADOWS", 1});
    if (probed) defines.add({"PROBED", ReflectionProbes::kSize});
    if (!mirror) return;
    defines.add({"OBJECTS", 1});
    if (!traced && !probed && !objects_.probeCentres().empty()) defines.add({"PROBES", 1});
}

ObjectStage::Regions ObjectStage::regions(const View& view, const MirrorPlanes& mirrors,
                                          const PixelRectangle& part, bool traced,
                                          bool alone) const {
    // Traced, what is reflected twice shows objects elsewhere; shadows are on everything.
    if (!shadows_.empty() || (traced && !(alone && objects_.probeCentres().empty())))
        return {part, {}};
    MirrorRegion objects(view, mirrors), change(view, mirrors);
    for (const Vec4& sphere : objects_.spheres()) objects.addSphere(sphere);
    if (!traced)
        for (const auto& corners : change_->places()) change.addHull(corners);
    return {objects.within(part), change.within(part)};
}

std::uint64_t ObjectStage::bytes() const {
    return objects_.bytes() + (change_ ? change_->bytes() : 0) + probes_.bytes() + shadows_.bytes();
}

}  // namespace vlf::gl
