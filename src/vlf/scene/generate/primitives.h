#pragma once
// Plain bodies to put into rooms.

#include "vlf/scene/scene.h"

#include <string>
#include <vector>

namespace vlf {

/// "cube", "sphere" and "knot".
const std::vector<std::string>& primitiveNames();

/// The body `name` about the origin, closed, of one material and one metre from side to side (the
/// knot: along its longest). Throws InputError for an unknown name.
Scene makePrimitive(const std::string& name, const Material& material);

}  // namespace vlf
