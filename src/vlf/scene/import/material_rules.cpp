#include "vlf/scene/import/material_rules.h"

#include "vlf/scene/import/warn.h"

namespace vlf {

Texture toTexture(DecodedImage image, const std::string& name, Wrap wrapU, Wrap wrapV) {
    return {name,  image.width, image.height, std::move(image.srgb8), std::move(image.linear),
            wrapU, wrapV};
}

void addGlossyAsDiffuse(const Scene& scene, Material& material, const Vec3& reflectance,
                        ImportReport& report, const SourceLocation& where) {
    warn(report, where, "glossy reflection is treated as diffuse");
    if (material.diffuseTexture < 0) {
        material.diffuse += reflectance;
        return;
    }
    const Vec3 mean = scene.textures[material.diffuseTexture].average();
    for (int i = 0; i < 3; ++i) {
        if (mean[i] <= 0) continue;
        const float raised = material.diffuse[i] + reflectance[i] / mean[i];
        material.diffuse[i] = std::max(material.diffuse[i], std::min(1.0f, raised));
    }
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
