#pragma once
// What a camera needs to show anything.

#include "vlf/scene/scene.h"

namespace vlf {

/// Whether eye, look and up are finite and span a plane in single precision, and the field of view
/// lies in (0, 180) degrees.
bool hasView(const Camera& camera);

}  // namespace vlf
