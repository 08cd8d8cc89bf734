#pragma once
// A fingerprint of a scene's contents.

#include "vlf/scene/scene.h"

#include <string>

namespace vlf {

/// 32 hexadecimal digits (XXH3, 128 bits) of everything that light transport reads: geometry,
/// materials and textures; not names or cameras.
std::string sceneHash(const Scene& scene);

}  // namespace vlf
