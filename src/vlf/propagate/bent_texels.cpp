#include "vlf/propagate/bent_texels.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

constexpr float kStraight = 0.9995f;  // cos 1.8°: normals this close count as one
constexpr float kMinCosine = 0.02f;   // rays that graze more are held to this one's weight

}  // namespace

std::vector<BentTexel> findBentTexels(const Scene& scene, const Unwrap& unwrap) {
    std::vector<BentTexel> bent;
    for (std::size_t i = 0; i < unwrap.texels.size(); ++i) {
        const std::uint32_t chart = unwrap.texelChart[i];
        const auto points = unwrap.points.of(i);
        Vec3 shading(0), geometric(0);
        for (const SurfacePoint& p : points) {
            shading += shadingNormalAt(scene, p.triangle, p.barycentric);
            geometric += geometricNormal(scene, p.triangle);
        }
        const float side = unwrap.triangleCharts[points[0].triangle].front == chart ? 1.0f : -1.0f;
        shading = side * glm::normalize(shading);
        geometric = side * glm::normalize(geometric);
        const float cosine = glm::dot(shading, geometric);
        if (cosine > 0 && cosine < kStraight)
            bent.push_back({unwrap.texels[i], shading, geometric});
    }
    return bent;
}

void BentSums::take(const Vec3& direction, TexelBuffer& gathered) {
    for (std::size_t i = 0; i < texels_.size(); ++i) {
        const BentTexel& t = texels_[i];
        const float samples = gathered.weight(t.texel);
        if (samples <= 0) continue;
        const float across = glm::dot(t.geometric, direction);
        const float along = std::copysign(1.0f, across) * glm::dot(t.shading, direction);
        const float weight = std::max(0.0f, along) / std::max(std::abs(across), kMinCosine);
        sums_[i].rgb += weight * gathered.rgb(t.texel);
        sums_[i].weight += weight * samples;
        gathered.set(t.texel, Vec3(0), 0);
    }
}

void BentSums::putBack(TexelBuffer& gathered) const {
    for (std::size_t i = 0; i < texels_.size(); ++i)
        gathered.set(texels_[i].texel, sums_[i].rgb, sums_[i].weight);
}

}  // namespace vlf
