#include "vlf/scene/emitter_sampler.h"

#include "vlf/math/sampling.h"

#include <algorithm>

namespace vlf {

namespace {

/// Side length, in texels, of the square that is as large as the triangle on its texture.
int texelExtent(const Scene& scene, std::uint32_t triangle, const Texture& texture) {
    const auto& v = scene.triangles[triangle].vertex;
    const Vec2 size(texture.width, texture.height);
    const Vec2 a = (scene.uvs[v[1]] - scene.uvs[v[0]]) * size;
    const Vec2 b = (scene.uvs[v[2]] - scene.uvs[v[0]]) * size;
    const float texels = 0.5f * std::abs(a.x * b.y - a.y * b.x);
    return static_cast<int>(std::clamp(std::ceil(std::sqrt(texels)), 1.0f, 64.0f));
}

double power(const Scene& scene, std::uint32_t triangle) {
    const Vec3 emission = meanEmission(scene, triangle);
    const double sides = scene.material(triangle).emitsBothSides ? 2 : 1;
    return sides * area(scene, triangle) * (emission.x + emission.y + emission.z);
}

/// Uniform in [0, 1) with 53 bits, so that triangles of tiny power are met as often as they should.
double nextDouble(RandomStream& random) {
    return static_cast<double>(random.nextBits() >> 11) * 0x1p-53;
}

}  // namespace

Vec3 meanEmission(const Scene& scene, std::uint32_t triangle) {
    const Material& material = scene.material(triangle);
    if (material.emissionTexture < 0) return material.emission;
    const int n = texelExtent(scene, triangle, scene.textures[material.emissionTexture]);
    Vec3 sum(0);
    const auto add = [&](float u, float v) {
        sum += emittedRadiance(scene, material, uvAt(scene, triangle, Vec2(u, v) / float(n)));
    };
    // Centroids of the n² congruent parts: n (n + 1) / 2 upright ones, the rest upside down.
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j) {
            add(i + 1 / 3.0f, j + 1 / 3.0f);
            if (i + j + 1 < n) add(i + 2 / 3.0f, j + 2 / 3.0f);
        }
    return sum / float(n * n);
}

EmitterSampler::EmitterSampler(const Scene& scene) {
    double total = 0;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        if (!scene.material(i).isEmitter()) continue;
        const double p = power(scene, i);
        if (!(p > 0)) continue;
        triangles_.push_back(i);
        cumulative_.push_back(total += p);
    }
    if (triangles_.empty()) return;
    densities_.assign(scene.triangles.size(), 0);
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const double p = cumulative_[i] - (i > 0 ? cumulative_[i - 1] : 0);
        densities_[triangles_[i]] = static_cast<float>(p / total / area(scene, triangles_[i]));
    }
}

SidePoint EmitterSampler::sample(RandomStream& random) const {
    const double u = nextDouble(random) * cumulative_.back();
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, u);
    const std::size_t i = static_cast<std::size_t>(found - cumulative_.begin());
    return {triangles_[i], sampleUniformTriangle(random.next2()), true};
}

}  // namespace vlf
