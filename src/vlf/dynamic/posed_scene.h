#pragma once
// A room with its objects as one scene that does not move: the truth that dynamic light is held
// against, by baking or path tracing it.

#include "vlf/dynamic/object.h"
#include "vlf/scene/scene.h"

#include <span>

namespace vlf {

/// `room`, its triangles first, and the visible objects where they are, in their order.
Scene posedScene(const Scene& room, std::span<const DynamicObject> objects);

}  // namespace vlf
