#pragma once
// What the importers make of materials that Material cannot represent, and of texture images.

#include "vlf/base/error.h"
#include "vlf/image/image_io.h"
#include "vlf/scene/import/import.h"

namespace vlf {

/// Most radiance that is emitted, W·m⁻²·sr⁻¹, and largest value of a texture: the sun has 2e7.
inline constexpr float kMostRadiance = 1e9f;

/// The pixels of a decoded image as a texture. Values that are negative or not a number become 0,
/// those above kMostRadiance that; warns.
Texture toTexture(DecodedImage image, const std::string& name, Wrap wrapU, Wrap wrapV,
                  ImportReport& report, const SourceLocation& where);

/// Width of the GGX lobe (Material::roughness) that is like a Phong lobe of this exponent, and like
/// a perceptual roughness (glTF, Pr of MTL). B. Walter et al., EGSR 2007; B. Burley,
/// "Physically-based shading at Disney", 2012.
float widthOfExponent(float exponent);
float widthOfRoughness(float roughness);

/// Makes a material smooth glass of this transmission (limited to [0, 1]; black is made nearly so)
/// and index of refraction (limited to [1, kMostIor], with a warning), and nothing else but what it
/// emits. `roughness`: width of the lobe that it should have; warns if that shows.
void makeGlass(Material& material, const Vec3& transmission, float ior, float roughness,
               ImportReport& report, const SourceLocation& where);

/// Surfaces are opaque: true (with a warning) if one of this opacity is better left out, because
/// it lets more than half of the light through. Warns too if it is kept and opacity < 1.
bool leaveOutTransparent(float opacity, ImportReport& report, const SourceLocation& where);

}  // namespace vlf
