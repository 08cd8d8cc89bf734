#include "vlf/propagate/light_sources.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace vlf {

namespace {

constexpr std::size_t kMaxImages = 4096;
constexpr std::size_t kMaxFaces = 6;  // charts of an emitting body that stay lights of their own

constexpr float kFar = 1e3f;  // of the scene's radius: where lights at infinity are thought to be

constexpr int kTextureLevels = 4;  // a textured emitting triangle is cut in 4^4

/// Mean emitted radiance of a patch.
Vec3 meanEmission(const Scene& scene, const LightPatch& patch) {
    const Material& material = scene.material(patch.triangle);
    if (material.emissionTexture < 0) return material.emission;
    Vec3 sum(0);
    constexpr int kSteps = 3;
    int count = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; i + j < kSteps; ++j, ++count) {
            const Vec2 w = Vec2(i + 1.0f / 3, j + 1.0f / 3) / static_cast<float>(kSteps);
            const Vec2 b = (1 - w.x - w.y) * patch.corners[0] + w.x * patch.corners[1] +
                           w.y * patch.corners[2];
            sum += emittedRadiance(scene, material, uvAt(scene, patch.triangle, b));
        }
    return sum / static_cast<float>(count);
}

void cut(const LightPatch& patch, int levels, std::vector<LightPatch>& out) {
    if (levels == 0) {
        out.push_back(patch);
        return;
    }
    const auto& [a, b, c] = patch.corners;
    const Vec2 ab = 0.5f * (a + b), bc = 0.5f * (b + c), ca = 0.5f * (c + a);
    for (const std::array<Vec2, 3>& part : {std::array{a, ab, ca}, std::array{ab, b, bc},
                                            std::array{ca, bc, c}, std::array{ab, bc, ca}})
        cut({patch.triangle, part}, levels - 1, out);
}

void addPatches(const Scene& scene, std::uint32_t t, Light& light) {
    const bool textured = scene.material(t).emissionTexture >= 0;
    const std::size_t first = light.patches.size();
    cut({t, {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}}, textured ? kTextureLevels : 0, light.patches);
    const float patchArea = area(scene, t) / static_cast<float>(light.patches.size() - first);
    if (textured) light.uniform = false;
    for (std::size_t i = first; i < light.patches.size(); ++i) {
        const Vec3 emission = meanEmission(scene, light.patches[i]);
        light.radiance += emission * patchArea;
        const float before = i > 0 ? light.cumulativePower.back() : 0;
        light.cumulativePower.push_back(before + luminance(emission) * patchArea * kPi);
        light.density.push_back(luminance(emission) * kPi);
    }
}

void finishLight(const Scene& scene, Light& light) {
    std::sort(light.triangles.begin(), light.triangles.end());
    const float side = light.front ? 1.0f : -1.0f;
    Vec3 areaSum(0);
    Bounds bounds;
    for (const std::uint32_t t : light.triangles) {
        areaSum += side * areaVector(scene, t);
        light.area += area(scene, t);
        addPatches(scene, t, light);
        for (int c = 0; c < 3; ++c) bounds.add(scene.position(t, c));
    }
    light.radiance /= light.area;
    for (float& d : light.density) d /= std::max(light.cumulativePower.back(), 1e-30f);
    const float length = glm::length(areaSum);
    light.normal = length > 1e-6f * light.area ? areaSum / length : Vec3(0);
    light.centre = bounds.centre();
    for (const std::uint32_t t : light.triangles) {
        light.normalCosine =
            std::min(light.normalCosine, glm::dot(side * geometricNormal(scene, t), light.normal));
        for (int c = 0; c < 3; ++c)
            light.radius =
                std::max(light.radius, glm::distance(light.centre, scene.position(t, c)));
    }
}

/// Emitting charts that touch, by the position of their vertices.
class TouchingCharts {
  public:
    explicit TouchingCharts(const Scene& scene) : scene_(scene) {}

    void add(std::uint32_t chart, std::uint32_t triangle) {
        parent_.try_emplace(chart, chart);
        for (int c = 0; c < 3; ++c) {
            const Vec3& p = scene_.position(triangle, c);
            const auto [it, isNew] = chartAt_.try_emplace({p.x, p.y, p.z}, chart);
            if (!isNew) parent_[root(chart)] = root(it->second);
        }
    }

    std::uint32_t root(std::uint32_t chart) {
        while (parent_[chart] != chart) chart = parent_[chart] = parent_[parent_[chart]];
        return chart;
    }

  private:
    const Scene& scene_;
    std::map<std::uint32_t, std::uint32_t> parent_;
    std::map<std::array<float, 3>, std::uint32_t> chartAt_;
};

/// Emitters by chart; a body of more than kMaxFaces charts (a bulb) becomes one light. An emitting
/// side without a chart, facing the inside of a solid, lights nothing.
std::vector<Light> findLights(const Scene& scene, const Unwrap& unwrap) {
    std::map<std::uint32_t, Light> byChart;
    TouchingCharts touching(scene);
    const auto add = [&](std::uint32_t chart, std::uint32_t triangle, bool front) {
        if (chart == kNoChart) return;
        Light& light = byChart[chart];
        light.triangles.push_back(triangle);
        light.front = front;
        light.planar = unwrap.charts[chart].planar;
        touching.add(chart, triangle);
    };
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const Material& material = scene.material(t);
        if (!material.isEmitter()) continue;
        add(unwrap.triangleCharts[t].front, t, true);
        if (material.emitsBothSides) add(unwrap.triangleCharts[t].back, t, false);
    }
    std::map<std::pair<std::uint32_t, bool>, std::vector<std::uint32_t>> bodies;
    for (const auto& [chart, light] : byChart)
        bodies[{touching.root(chart), light.front}].push_back(chart);
    std::vector<Light> lights;
    for (const auto& [body, charts] : bodies) {
        const bool merged = charts.size() > kMaxFaces;
        for (const std::uint32_t chart : charts) {
            Light& light = byChart[chart];
            if (merged && chart != charts.front()) {
                Light& whole = lights.back();
                whole.triangles.insert(whole.triangles.end(), light.triangles.begin(),
                                       light.triangles.end());
                whole.planar = false;
            } else {
                lights.push_back(std::move(light));
            }
        }
    }
    for (Light& light : lights) finishLight(scene, light);
    std::erase_if(lights, [](const Light& l) { return l.cumulativePower.back() <= 0; });
    return lights;
}

Light lightOf(const PunctualLight& punctual, const Sphere& scene) {
    Light light;
    light.kind = LightKind::punctual;
    light.punctual = punctual;
    light.punctual.name.clear();  // it is copied often
    light.planar = false;
    light.normal = punctual.direction;
    light.centre = punctual.kind == PunctualKind::directional
                       ? scene.centre - kFar * scene.radius * punctual.direction
                       : punctual.position;
    return light;
}

/// The bright part of the environment.
Light skyLightOf(const SkyLight& sky, const Sphere& scene) {
    Light light;
    light.kind = LightKind::sky;
    light.planar = false;
    light.normal = -sky.axis;
    light.normalCosine = sky.cosine;
    const float distance = kFar * scene.radius;
    light.centre = scene.centre + distance * sky.axis;
    const float sine = std::sqrt(std::max(0.0f, 1 - sky.cosine * sky.cosine));
    light.radius = (sky.cosine > 0 ? sine : 10) * distance;
    return light;
}

Vec3 meanMirrorReflectance(const Scene& scene, const Material& material) {
    return material.mirrorTexture < 0
               ? material.mirror
               : material.mirror * scene.textures[material.mirrorTexture].average();
}

Affine composed(const Affine& a, const Affine& b) {
    return {a.linear * b.linear, a.linear * b.translation + a.translation};
}

std::vector<std::uint32_t> chartsOfMirrorTexels(const Scene& scene, const Unwrap& unwrap) {
    std::vector<std::uint32_t> chartOf(unwrap.atlasSize(), kNoChart);
    for (std::uint32_t c = 0; c < unwrap.charts.size(); ++c) {
        const Chart& chart = unwrap.charts[c];
        if (!scene.materials[chart.material].isSpecular()) continue;
        for (std::uint32_t y = chart.y; y < chart.y + chart.height; ++y)
            std::fill_n(chartOf.begin() + y * unwrap.atlasWidth + chart.x, chart.width, c);
    }
    return chartOf;
}

}  // namespace

Affine reflection(const Vec3& point, const Vec3& normal) {
    const Mat3 linear = Mat3(1.0f) - 2.0f * glm::outerProduct(normal, normal);
    return {linear, 2 * glm::dot(point, normal) * normal};
}

std::optional<LightImage> imageInMirror(const Scene& scene, const Unwrap& unwrap,
                                        std::uint32_t chart, const Vec3& point, const Light& light,
                                        const LightImage& inner) {
    const Chart& mirror = unwrap.charts[chart];
    const Vec3 centre = inner.imageFromWorld.point(light.centre);
    if (glm::dot(centre - point, mirror.normal) <= -light.radius) return std::nullopt;
    LightImage image = inner;
    image.depth = inner.depth + 1;
    image.mirror[0] = chart;
    for (int i = 0; i < inner.depth; ++i) image.mirror[i + 1] = inner.mirror[i];
    image.imageFromWorld = composed(reflection(point, mirror.normal), inner.imageFromWorld);
    image.throughput *= meanMirrorReflectance(scene, scene.materials[mirror.material]);
    return image;
}

LightSources findLightSources(const Scene& scene, const Unwrap& unwrap) {
    LightSources sources;
    sources.lights = findLights(scene, unwrap);
    const Sphere sphere = boundingSphere(scene);
    sources.beyond = 8 * sphere.radius;
    sources.punctual = scene.lights;
    for (const PunctualLight& punctual : scene.lights)
        sources.lights.push_back(lightOf(punctual, sphere));
    if (!scene.environment.isBlack()) {
        sources.sky = std::make_shared<const SkyLight>(makeSkyLight(scene.environment));
        if (sources.sky->sky.hasBright())
            sources.lights.push_back(skyLightOf(*sources.sky, sphere));
    }
    sources.planarMirror.assign(unwrap.charts.size(), 0);
    sources.mirrorOffset.assign(unwrap.charts.size(), 0);
    sources.withinGlass.assign(unwrap.charts.size(), 0);
    sources.mirrorChart = chartsOfMirrorTexels(scene, unwrap);
    std::map<std::uint32_t, Vec3> mirrors;  // planar mirror chart -> a point of it
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const std::uint32_t back = unwrap.triangleCharts[t].back;
        if (scene.material(t).isSolidGlass() && back != kNoChart) sources.withinGlass[back] = 1;
        if (!scene.material(t).isMirror() || scene.material(t).isGlossy()) continue;
        for (const std::uint32_t c :
             {unwrap.triangleCharts[t].front, unwrap.triangleCharts[t].back})
            if (c != kNoChart && unwrap.charts[c].planar) {
                mirrors.emplace(c, scene.position(t, 0));
                sources.planarMirror[c] = 1;
                sources.mirrorOffset[c] = glm::dot(unwrap.charts[c].normal, scene.position(t, 0));
            }
    }
    for (std::uint32_t i = 0; i < sources.lights.size(); ++i)
        sources.images.emplace_back().light = i;
    std::size_t begin = 0;
    for (int depth = 1; depth <= kMaxImageDepth; ++depth) {
        const std::size_t end = sources.images.size();
        if (mirrors.empty() || end + (end - begin) * mirrors.size() > kMaxImages) break;
        for (std::size_t i = begin; i < end; ++i)
            for (const auto& [m, point] : mirrors) {
                const LightImage inner = sources.images[i];
                if (inner.depth > 0 && inner.mirror[0] == m) continue;
                if (const auto image =
                        imageInMirror(scene, unwrap, m, point, sources.lights[inner.light], inner))
                    sources.images.push_back(*image);
            }
        begin = end;
        sources.imageDepth = depth;
    }
    return sources;
}

}  // namespace vlf
