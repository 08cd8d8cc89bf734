#pragma once
// What the importers make of materials that Material cannot represent, and of texture images.

#include "vlf/base/error.h"
#include "vlf/image/image_io.h"
#include "vlf/scene/import/import.h"

namespace vlf {

/// The pixels of a decoded image as a texture.
Texture toTexture(DecodedImage image, const std::string& name, Wrap wrapU, Wrap wrapV);

/// A glossy lobe of albedo `reflectance` is added to the diffuse one, so that the mean reflected
/// energy is kept as far as the diffuse texture allows; warns.
void addGlossyAsDiffuse(const Scene& scene, Material& material, const Vec3& reflectance,
                        ImportReport& report, const SourceLocation& where);

/// Surfaces are opaque: true (with a warning) if one of this opacity is better left out, because
/// it lets more than half of the light through. Warns too if it is kept and opacity < 1.
bool leaveOutTransparent(float opacity, ImportReport& report, const SourceLocation& where);

}  // namespace vlf
