#include "vlf/scene/import/material_rules.h"

#include "vlf/scene/import/warn.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {
constexpr float kLeastWidth = 1e-3f;  // narrower lobes are mirrors
constexpr float kLeastTransmission = 1e-4f;
constexpr float kShownRoughness = 2.5e-3f;  // width of a lobe
}  // namespace

Texture toTexture(DecodedImage image, const std::string& name, Wrap wrapU, Wrap wrapV,
                  ImportReport& report, const SourceLocation& where) {
    bool changed = false;
    for (Vec3& pixel : image.linear)
        for (int i = 0; i < 3; ++i) {
            if (pixel[i] >= 0 && pixel[i] <= kMostRadiance) continue;
            pixel[i] = pixel[i] > 0 ? kMostRadiance : 0;
            changed = true;
        }
    if (changed)
        warn(report, where,
             "texture '" + name +
                 "': values that are negative, infinite or not a number are "
                 "replaced");
    return {name,  image.width, image.height, std::move(image.srgb8), std::move(image.linear),
            wrapU, wrapV};
}

float widthOfExponent(float exponent) {
    return std::sqrt(2 / (std::max(exponent, 0.0f) + 2));
}

float widthOfRoughness(float roughness) {
    return std::clamp(roughness * roughness, kLeastWidth, 1.0f);
}

void makeGlass(Material& material, const Vec3& transmission, float ior, float roughness,
               ImportReport& report, const SourceLocation& where) {
    material.diffuse = material.mirror = Vec3(0);
    material.diffuseTexture = material.mirrorTexture = -1;
    material.roughness = 0;
    material.transmission = glm::clamp(transmission, Vec3(0), Vec3(1));
    if (!material.isGlass()) material.transmission = Vec3(kLeastTransmission);
    material.ior = std::clamp(ior, 1.0f, kMostIor);
    if (!(material.ior == ior))
        warn(report, where,
             fmt::format("index of refraction {:g} is limited to 1 to {:g}", ior, kMostIor));
    if (roughness > kShownRoughness) warn(report, where, "rough glass is shown as smooth");
}

bool leaveOutTransparent(float opacity, ImportReport& report, const SourceLocation& where) {
    if (opacity >= 1) return false;
    const bool leaveOut = opacity < 0.5f;
    warn(report, where,
         leaveOut ? "transparency is not supported; its surfaces are left out"
                  : "transparency is not supported; treated as opaque");
    return leaveOut;
}

}  // namespace vlf
