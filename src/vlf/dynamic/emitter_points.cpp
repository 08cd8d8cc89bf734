#include "vlf/dynamic/emitter_points.h"

#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

constexpr std::size_t kMaxExactTriangles = 8;
constexpr std::size_t kMaxImages = 64;

EmitterPoint pointOf(const Scene& scene, const Light& light, const LightImage& image, float u,
                     const Vec2& place, int count) {
    const float power = u * light.cumulativePower.back();
    const auto found =
        std::upper_bound(light.cumulativePower.begin(), light.cumulativePower.end() - 1, power);
    const auto p = static_cast<std::size_t>(found - light.cumulativePower.begin());
    const LightPatch& patch = light.patches[p];
    const Vec2 b = sampleUniformTriangle(place);
    const Vec2 barycentric =
        (1 - b.x - b.y) * patch.corners[0] + b.x * patch.corners[1] + b.y * patch.corners[2];
    const Vec3 position = positionAt(scene, patch.triangle, barycentric);
    const Vec3 normal = (light.front ? 1.0f : -1.0f) * geometricNormal(scene, patch.triangle);
    const float density = light.density[p] * static_cast<float>(count);
    return {image.imageFromWorld.point(position), image.imageFromWorld.vector(normal), position,
            emittedRadiance(scene, scene.material(patch.triangle),
                            uvAt(scene, patch.triangle, barycentric)),
            density > 0 ? 1 / density : 0};
}

EmitterShare shareOf(const Scene& scene, const Light& light, const LightImage& image) {
    EmitterShare share;
    share.exact = light.uniform && light.planar && light.triangles.size() <= kMaxExactTriangles;
    if (share.exact)
        for (const std::uint32_t t : light.triangles)
            share.triangles.push_back({image.imageFromWorld.point(scene.position(t, 0)),
                                       image.imageFromWorld.point(scene.position(t, 1)),
                                       image.imageFromWorld.point(scene.position(t, 2))});
    return share;
}

}  // namespace

EmitterPoints spreadPoints(const Scene& scene, const LightSources& sources, int count,
                           int pattern) {
    EmitterPoints emitters;
    emitters.withImages = sources.images.size() <= sources.lights.size() + kMaxImages;
    const auto surfaces =
        std::count_if(sources.lights.begin(), sources.lights.end(),
                      [](const Light& light) { return light.kind == LightKind::surface; });
    const int each = std::max(1, count / std::max(1, static_cast<int>(surfaces)));
    for (std::uint32_t i = 0; i < sources.images.size(); ++i) {
        const LightImage& image = sources.images[i];
        if (image.depth > 0 && !emitters.withImages) continue;
        const Light& light = sources.lights[image.light];
        if (light.kind != LightKind::surface) continue;
        const int points = image.depth == 0 ? each : std::max(1, each / 4);
        RandomStream random(static_cast<std::uint64_t>(pattern), i);
        const Vec2 shift = random.next2();
        const float offset = random.next();
        EmitterShare share = shareOf(scene, light, image);
        share.image = i;
        share.first = static_cast<std::uint32_t>(emitters.points.size());
        share.count = static_cast<std::uint32_t>(points);
        for (int k = 0; k < points; ++k)
            emitters.points.push_back(pointOf(
                scene, light, image, (static_cast<float>(k) + offset) / static_cast<float>(points),
                r2Point(static_cast<std::uint32_t>(k), shift), points));
        emitters.shares.push_back(std::move(share));
    }
    return emitters;
}

float triangleSolidAngle(const Vec3& p, const std::array<Vec3, 3>& triangle) {
    const Vec3 a = triangle[0] - p, b = triangle[1] - p, c = triangle[2] - p;
    const float la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const float volume = std::abs(glm::dot(a, glm::cross(b, c)));
    const float sum =
        la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
    return 2 * std::atan2(volume, sum);
}

void solidAngles(const EmitterPoints& emitters, const EmitterShare& share, const Vec3& p,
                 std::span<float> solidAngles) {
    float sum = 0;
    for (std::uint32_t i = 0; i < share.count; ++i) {
        const EmitterPoint& point = emitters.points[share.first + i];
        const Vec3 way = p - point.position;
        const float distance2 = std::max(glm::dot(way, way), 1e-30f);
        const float cosine = glm::dot(point.normal, way) / std::sqrt(distance2);
        solidAngles[i] = cosine > 0 ? point.area * cosine / distance2 : 0;
        sum += solidAngles[i];
    }
    if (sum <= 0) return;
    float whole = std::min(sum, 2 * kPi);
    if (share.exact) {
        whole = 0;
        for (const auto& triangle : share.triangles) whole += triangleSolidAngle(p, triangle);
    }
    for (float& s : solidAngles) s *= whole / sum;
}

}  // namespace vlf
