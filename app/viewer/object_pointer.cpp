#include "object_pointer.h"

namespace vlf::app {

namespace {

constexpr float kClick = 3;  // pixels that the pointer may move within a click

}  // namespace

std::optional<Gizmo> ObjectPointer::gizmo(const Screen& screen, float scale) const {
    if (!objects_.selected()) return {};
    const DynamicObject& object = objects_.now(*objects_.selected());
    const Gizmo gizmo(screen, object.pose, scale);
    if (!object.visible || !gizmo.shown()) return {};
    return gizmo;
}

void ObjectPointer::press(const Screen& screen, const Vec2& point, float scale) {
    grabbed_ = gizmo(screen, scale);
    held_ = grabbed_ ? grabbed_->pick(point) : GizmoHandle();
    if (grabbed_) grabbedId_ = objects_.id(*objects_.selected());
    from_ = point;
    moved_ = false;
}

void ObjectPointer::drag(const Vec2& point) {
    if (!from_) return;
    moved_ = moved_ || glm::length(point - *from_) > kClick;
    if (held_ && objects_.selected() && objects_.id(*objects_.selected()) == grabbedId_)
        objects_.setPose(*objects_.selected(), grabbed_->dragged(held_, *from_, point));
}

void ObjectPointer::release(const Screen& screen, const Vec2& point) {
    const bool clicked = from_ && !moved_ && !held_;
    from_.reset();
    held_ = {};
    if (clicked && objects_.room()) objects_.select(objects_.pick(screen.ray(point)));
}

}  // namespace vlf::app
