#pragma once
// The gizmo over the picture.

#include "vlf/display/gizmo.h"

namespace vlf::app {

/// Within a frame of the Gui, beneath its windows. `width` of the screen in pixels; `bright` is the
/// part that is held or under the pointer.
void drawGizmo(const Screen& screen, float width, const Gizmo& gizmo, const GizmoHandle& bright);

}  // namespace vlf::app
