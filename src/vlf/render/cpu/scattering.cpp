#include "vlf/render/cpu/scattering.h"

#include "vlf/math/frame.h"
#include "vlf/math/microfacet.h"
#include "vlf/math/sampling.h"

#include <algorithm>

namespace vlf {

namespace {

/// At most half of the cosine lobe lies below the surface: a longer row of rejections never occurs.
constexpr int kMaxRejections = 128;

constexpr float kMinCosine = 1e-4f;

float diffuseChanceOf(const Surface& surface) {
    const float diffuse = maxComponent(surface.diffuse), mirror = maxComponent(surface.mirror);
    return diffuse > 0 ? diffuse / (diffuse + mirror) : 0;
}

/// The shading normal, unless it cannot be seen.
const Vec3& normalTowards(const Surface& surface, const Vec3& toEye) {
    return glm::dot(surface.normal, toEye) > kMinCosine ? surface.normal : surface.geometricNormal;
}

}  // namespace

Scattering::Scattering(const Surface& surface, const Vec3& toEye)
    : surface_(surface),
      toEye_(toEye),
      gloss_(frameFromNormal(normalTowards(surface, toEye))),
      glossToEye_(gloss_.toLocal(toEye)),
      diffuseChance_(diffuseChanceOf(surface)) {
    glossToEye_.z = std::max(glossToEye_.z, kMinCosine);
}

Vec3 Scattering::lobes(const Vec3& direction) const {
    if (glm::dot(surface_.geometricNormal, direction) <= 0) return Vec3(0);
    Vec3 sum = surface_.diffuse * cosineLobe(surface_, direction);
    if (!surface_.isPerfectMirror())
        sum +=
            surface_.mirror * ggxLobe(surface_.roughness, glossToEye_, gloss_.toLocal(direction));
    return sum;
}

float Scattering::density(const Vec3& direction) const {
    float sum = diffuseChance_ * cosineLobe(surface_, direction);
    if (!surface_.isPerfectMirror())
        sum += (1 - diffuseChance_) *
               ggxDensity(surface_.roughness, glossToEye_, gloss_.toLocal(direction));
    return sum;
}

Vec3 Scattering::drawDiffuse(RandomStream& random) const {
    const Frame frame = frameFromNormal(surface_.normal);
    for (int i = 0; i < kMaxRejections; ++i) {
        const Vec3 direction = frame.toWorld(sampleCosineHemisphere(random.next2()));
        if (cosineLobe(surface_, direction) > 0) return glm::normalize(direction);
    }
    return surface_.geometricNormal;
}

Vec3 Scattering::drawGloss(const Vec2& u) const {
    const Vec3 facet = sampleGgxNormal(surface_.roughness, glossToEye_, u);
    return glm::normalize(gloss_.toWorld(glm::reflect(-glossToEye_, facet)));
}

std::optional<Scattering::Sample> Scattering::sample(RandomStream& random) const {
    Sample sample;
    const bool diffuse = diffuseChance_ >= 1 || random.next() < diffuseChance_;
    if (!diffuse && surface_.isPerfectMirror())
        return Sample{mirrorDirection(surface_, -toEye_), surface_.mirror / (1 - diffuseChance_),
                      kCertain};
    if (diffuse) {
        sample.direction = drawDiffuse(random);
    } else {
        sample.direction = drawGloss(random.next2());
    }
    sample.density = density(sample.direction);
    const Vec3 lobe = lobes(sample.direction);
    if (maxComponent(lobe) <= 0 || !(sample.density > 0)) return std::nullopt;
    sample.weight = lobe / sample.density;
    return sample;
}

}  // namespace vlf
