#pragma once
// What the mouse does to objects: a click selects one, a drag of the gizmo moves it.

#include "objects.h"

#include "vlf/display/gizmo.h"

#include <optional>

namespace vlf::app {

class ObjectPointer {
  public:
    /// `objects` must outlive it.
    explicit ObjectPointer(Objects& objects) : objects_(objects) {}

    /// Of the selected object; none: nothing is selected, or it is not before the camera.
    std::optional<Gizmo> gizmo(const Screen& screen, float scale) const;

    /// The left button goes down, the pointer moves, the button goes up. Points in pixels of the
    /// screen.
    void press(const Screen& screen, const Vec2& point, float scale);
    void drag(const Vec2& point);
    void release(const Screen& screen, const Vec2& point);

    /// What of the gizmo is held.
    GizmoHandle held() const { return held_; }

  private:
    Objects& objects_;
    std::optional<Gizmo> grabbed_;  ///< as it was when the button went down
    std::uint64_t grabbedId_ = 0;   ///< of the object that it moves
    GizmoHandle held_;
    std::optional<Vec2> from_;  ///< where the button went down; none: it is up
    bool moved_ = false;
};

}  // namespace vlf::app
