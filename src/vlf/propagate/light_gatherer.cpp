#include "vlf/propagate/light_gatherer.h"

#include "vlf/base/thread_memory.h"
#include "vlf/math/form_factor.h"
#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/scene/light_beam.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf {

namespace {

constexpr int kMaxAnalyticTriangles = 8;
constexpr float kAgreement = 0.1f;  // relative spread of form factors over a texel
constexpr std::array<std::size_t, kTexelGrid> kLatinSquare{1, 3, 0, 2};  // column taken in each row
constexpr float kMinSamples = 3;
constexpr float kLittle = 0.01f;     // share of the likely effect of all lights
constexpr float kGrazing = 1e-5f;    // cosine: a point in a light's own plane gets nothing from it
constexpr float kSlack = 0.01f;      // texels
constexpr float kNearField = 0.25f;  // distance, in sides of a square of a light's area
constexpr int kFew = 100;            // samples
constexpr float kCompact = 0.1f;  // radius of a light by its distance: much the same from all of it

/// Variance of n samples that are spread evenly, from the difference of their halves. Those of few
/// make up for one another, which tells of too much: it is no more than if they were independent.
float evenVariance(float ofHalves, float independent, int n) {
    return n < kFew ? std::min(ofHalves, independent) : ofHalves;
}

struct LightSample {
    Vec3 point, normal;  // world
    Vec3 radiance;
    float density;  // m⁻²
};

LightSample sampleLight(const Scene& scene, const Light& light, Vec2 u) {
    const float target = u.x * light.cumulativePower.back();
    const auto& sums = light.cumulativePower;
    const auto i = std::min<std::size_t>(
        std::upper_bound(sums.begin(), sums.end(), target) - sums.begin(), sums.size() - 1);
    const float before = i > 0 ? sums[i - 1] : 0;
    u.x = std::clamp((target - before) / (sums[i] - before), 0.0f, 0.99999994f);
    const LightPatch& patch = light.patches[i];
    const Vec2 w = sampleUniformTriangle(u);
    const Vec2 b =
        (1 - w.x - w.y) * patch.corners[0] + w.x * patch.corners[1] + w.y * patch.corners[2];
    const Vec3 normal = geometricNormal(scene, patch.triangle) * (light.front ? 1.0f : -1.0f);
    const Material& material = scene.material(patch.triangle);
    const Vec3 radiance = light.uniform
                              ? material.emission
                              : emittedRadiance(scene, material, uvAt(scene, patch.triangle, b));
    return {positionAt(scene, patch.triangle, b), normal, radiance, light.density[i]};
}

bool hasFormFactor(const Light& light) {
    return light.kind == LightKind::surface && light.uniform && light.planar &&
           light.triangles.size() <= kMaxAnalyticTriangles;
}

float geometryTerm(const Vec3& position, const Vec3& shading, const Vec3& geometric, const Vec3& y,
                   const Vec3& lightNormal) {
    const Vec3 d = y - position;
    const float squared = glm::dot(d, d);
    const float cosReceiver = glm::dot(shading, d), cosLight = -glm::dot(lightNormal, d);
    if (cosReceiver <= 0 || glm::dot(geometric, d) <= 0) return 0;
    if (cosLight <= kGrazing * std::sqrt(squared)) return 0;
    return cosReceiver * cosLight / (squared * squared * receiverLobe(shading, geometric));
}

}  // namespace

LightReceiver texelReceiver(const Scene& scene, const Unwrap& unwrap, std::size_t i) {
    LightReceiver r;
    r.scene = &scene;
    r.points = unwrap.points.of(i);
    const Chart& chart = unwrap.charts[unwrap.texelChart[i]];
    const std::uint32_t triangle = r.points[0].triangle;
    r.side = unwrap.triangleCharts[triangle].front == unwrap.texelChart[i] ? 1.0f : -1.0f;
    r.normal = chart.normal;
    r.planar = chart.planar;
    for (const SurfacePoint& p : r.points) r.centre += positionAt(scene, p.triangle, p.barycentric);
    r.centre /= static_cast<float>(r.points.size());
    r.radius = chart.planar ? chart.texelSize() : 2 * chart.texelSize();
    r.key = unwrap.texels[i];
    return r;
}

DirectEstimate LightGatherer::irradiance(const LightReceiver& receiver, int samples,
                                         std::uint64_t pass) {
    counts_ = Counts::seen;
    return estimateAll(receiver, samples, pass);
}

Vec3 LightGatherer::irradianceBlocked(const LightReceiver& receiver, int samples) {
    counts_ = Counts::blockedByExtra;
    return estimateAll(receiver, samples, 0).value;
}

DirectEstimate LightGatherer::estimateAll(const LightReceiver& receiver, int samples,
                                          std::uint64_t pass) {
    const ThreadMemory<Memory> lent(memory_);
    if (!shared_) weigh(receiver, memory_.weights);
    const Weights& weights = shared_ ? *shared_ : memory_.weights;
    DirectEstimate total{.unoccluded = weights.sum, .samples = samples};
    if (weights.sum <= 0) return total;
    RandomStream random(seed_ + pass, receiver.key);
    const auto wanted = [&](float effect) {
        const float share = effect / weights.sum;
        return std::max(static_cast<float>(samples) * share,
                        std::min(kMinSamples, kMinSamples * share / kLittle));
    };
    for (const std::uint32_t i : weights.apart) {
        // Of little effect, one is picked with a probability below one.
        const float n = wanted(weights.effects[i]);
        if (n < 1 && random.next() >= n) continue;
        total.add(gather(receiver, sources_.images[i], std::max(1, static_cast<int>(std::ceil(n))),
                         random),
                  std::max(1.0f, 1 / n));
    }
    if (!weights.together.empty())
        total.add(gatherTogether(receiver, weights,
                                 static_cast<int>(std::ceil(wanted(weights.upTo.back()))), random),
                  1);
    return total;
}

/// Irradiance from the images that share samples by n in all: an image is drawn in proportion to
/// its effect, evenly spaced in their order. The variance of samples that are even in this way is
/// that of the steps between them (W. G. Cochran, Sampling Techniques, 1977, section 8.9).
DirectEstimate LightGatherer::gatherTogether(const LightReceiver& r, const Weights& weights, int n,
                                             RandomStream& random) {
    const float effect = weights.upTo.back(), step = effect / static_cast<float>(n);
    float next = random.next() * step, squares = 0, last = -1, steps = 0;
    DirectEstimate total;
    while (next < effect) {
        const auto found = std::upper_bound(weights.upTo.begin(), weights.upTo.end(), next);
        const std::uint32_t i = weights.together[found - weights.upTo.begin()];
        int drawn = 0;
        for (; next < *found; next += step) ++drawn;
        const LightImage& image = sources_.images[i];
        const auto weight = static_cast<float>(drawn) / static_cast<float>(n);
        const Vec3 value = isCompact(r, image) ? gatherBySamples(r, image, drawn, random).value
                                               : gather(r, image, drawn, random).value;
        const Vec3 mean = effect / weights.effects[i] * value;
        total.value += weight * mean;
        const float here = luminance(mean);
        squares += weight * here * here;
        if (last >= 0) steps += weight * (here - last) * (here - last) / 2;
        last = here;
    }
    const float light = luminance(total.value);
    total.variance =
        n > 1 ? std::max(0.0f, squares - light * light) / static_cast<float>(n - 1) : light * light;
    total.evenVariance = n > 1 ? steps / static_cast<float>(n - 1) : total.variance;
    return total;
}

LightGatherer::Point LightGatherer::surfacePoint(const LightReceiver& r, std::size_t i) const {
    const SurfacePoint& p = r.points[i];
    Vec3 position = positionAt(*r.scene, p.triangle, p.barycentric);
    Vec3 geometric = r.side * geometricNormal(*r.scene, p.triangle);
    Vec3 shading = shadingNormalAt(*r.scene, p.triangle, p.barycentric);
    if (glm::dot(shading, geometric) < 0) shading = -shading;
    if (r.pose) {
        position = r.pose->point(position);
        geometric = r.pose->direction(geometric);
        shading = r.pose->direction(shading);
    }
    return {position, shading, geometric};
}

/// Irradiance from one image by n samples.
DirectEstimate LightGatherer::gather(const LightReceiver& r, const LightImage& image, int n,
                                     RandomStream& random) {
    if (sources_.lights[image.light].kind != LightKind::surface)
        return gatherBeams(r, image, n, random);
    if (hasFormFactor(sources_.lights[image.light])) return gatherByFormFactor(r, image, n, random);
    return gatherBySamples(r, image, n, random);
}

/// Whether a surface is so small and far that its form factor, which costs more than samples of it,
/// would spare little of their noise.
bool LightGatherer::isCompact(const LightReceiver& r, const LightImage& image) const {
    const Light& light = sources_.lights[image.light];
    return light.kind == LightKind::surface &&
           light.radius + r.radius <
               kCompact * glm::distance(image.imageFromWorld.point(light.centre), r.centre);
}

DirectEstimate LightGatherer::gatherBySamples(const LightReceiver& r, const LightImage& image,
                                              int n, RandomStream& random) {
    const float reach = nearReach(r, image);
    drawSamples(r, image, n, reach, random);
    findVisible();
    DirectEstimate estimate = meanOfSamples(n);
    if (reach > 0) {
        drawNearSamples(r, sources_.lights[image.light], n, reach, random);
        estimate.add(meanOfSamples(n), 1);
    }
    return estimate;
}

DirectEstimate LightGatherer::meanOfSamples(int n) const {
    const auto count = static_cast<float>(n);
    Vec3 sum(0);
    float squares = 0;
    std::array<float, 2> halves{};
    for (const Sample& s : memory_.samples) {
        const Vec3 contribution = s.geometry * s.throughput * s.radiance;
        sum += contribution;
        squares += luminance(contribution) * luminance(contribution);
        halves[s.odd] += luminance(contribution);
    }
    const Vec3 mean = sum / count;
    const float spread = std::max(0.0f, squares / count - luminance(mean) * luminance(mean));
    const auto odd = static_cast<float>(n / 2), even = count - odd;
    const float step = n > 1 ? halves[0] / even - halves[1] / odd : 0;
    return {.value = mean,
            .variance = spread / count,
            .evenVariance =
                evenVariance(step * step * even * odd / (count * count), spread / count, n)};
}

/// The unoccluded part of a plain light is known exactly: only the share of it that is visible
/// is sampled. Where no sample could tell, one half stands for it.
DirectEstimate LightGatherer::gatherByFormFactor(const LightReceiver& r, const LightImage& image,
                                                 int n, RandomStream& random) {
    const Light& light = sources_.lights[image.light];
    drawSamples(r, image, n, 0, random);
    findVisible();
    Vec3 throughput(0);
    float geometry = 0, squares = 0;
    std::array<float, 2> halfGeometry{}, halfPassed{};
    for (const Sample& s : memory_.samples) {
        const float passed = luminance(s.throughput);
        geometry += s.geometry;
        halfGeometry[s.odd] += s.geometry;
        halfPassed[s.odd] += s.geometry * passed;
        throughput += s.geometry * s.throughput;
        squares += s.geometry * passed * passed;
    }
    const auto count = static_cast<float>(n);
    const Vec3 unoccluded = light.radiance * kPi * formFactor(r, light, image);
    if (geometry <= 0) {
        if (counts_ == Counts::blockedByExtra) return {};
        const Vec3 value = 0.5f * unoccluded * image.throughput;
        const float variance = luminance(value) * luminance(value);
        return {.value = value, .variance = variance, .evenVariance = variance};
    }
    const Vec3 value = unoccluded * (throughput / geometry);
    const float share = luminance(throughput) / geometry, whole = luminance(unoccluded);
    const float spread = std::max(0.0f, squares / geometry - share * share);
    const float step = halfGeometry[0] > 0 && halfGeometry[1] > 0
                           ? halfPassed[0] / halfGeometry[0] - halfPassed[1] / halfGeometry[1]
                           : 0;
    const float halves = step * step * halfGeometry[0] * halfGeometry[1] / (geometry * geometry);
    return {.value = value,
            .variance = whole * whole * spread / count,
            .evenVariance = whole * whole * evenVariance(halves, spread / count, n)};
}

/// Within this distance of the receiver a light is sampled by directions instead of points,
/// among which 1/r² would leave few that matter; 0 if the light is farther.
float LightGatherer::nearReach(const LightReceiver& r, const LightImage& image) const {
    const Light& light = sources_.lights[image.light];
    const float reach = kNearField * std::sqrt(light.area);
    const Vec3 fromLight = r.centre - light.centre;
    const bool isNear =
        image.depth == 0 && glm::length(fromLight) < light.radius + reach + r.radius &&
        (!light.planar || std::abs(glm::dot(light.normal, fromLight)) < reach + r.radius);
    return isNear ? reach : 0;
}

/// The number of point j of n of the texel, stratified.
std::size_t LightGatherer::pointNumber(const LightReceiver& r, int j, int n, float rotation) {
    const auto stratum = static_cast<std::size_t>((j + rotation) / n * r.points.size());
    return (stratum + r.key) % r.points.size();
}

LightGatherer::Point LightGatherer::pointOf(const LightReceiver& r, int j, int n,
                                            float rotation) const {
    return surfacePoint(r, pointNumber(r, j, n, rotation));
}

/// What directions of the texel's points meet of the light within `reach`.
void LightGatherer::drawNearSamples(const LightReceiver& r, const Light& light, int n, float reach,
                                    RandomStream& random) {
    const Vec2 shift = random.next2();
    const float rotation = random.next();
    memory_.samples.clear();
    for (int j = 0; j < n; ++j) {
        const Point p = pointOf(r, j, n, rotation);
        const Vec3 direction =
            frameFromNormal(p.shading).toWorld(sampleCosineHemisphere(r2Point(j, shift)));
        if (glm::dot(p.geometric, direction) <= 0) continue;
        const Vec3 origin = p.position + rays_.epsilon() * p.geometric;
        Transmittance passed;
        const Hit hit = rays_.closestBehindPanes({origin, direction, 0, reach}, passed);
        if (!hit ||
            !std::binary_search(light.triangles.begin(), light.triangles.end(), hit.triangle))
            continue;
        const bool front = glm::dot(geometricNormal(scene_, hit.triangle), direction) < 0;
        if (front != light.front) continue;
        if (extra_ && extraBlocks({origin, direction, 0, hit.t}) == (counts_ == Counts::seen))
            continue;
        const Vec3 radiance = emittedRadiance(scene_, scene_.material(hit.triangle),
                                              uvAt(scene_, hit.triangle, hit.barycentric));
        memory_.samples.push_back(
            {kPi / receiverLobe(p.shading, p.geometric), radiance, passed.colour, j % 2 == 1});
    }
}

/// Pairs of a point of the texel and one of the light, both stratified, that face each other
/// and are not nearer than `reach`.
void LightGatherer::drawSamples(const LightReceiver& r, const LightImage& image, int n, float reach,
                                RandomStream& random) {
    const Light& light = sources_.lights[image.light];
    const Vec2 shift = random.next2();
    const float rotation = random.next();
    memory_.samples.clear();
    memory_.shadowRays.clear();
    Point p{};
    std::size_t number = r.points.size();  // of p; many samples start from the same
    for (int j = 0; j < n; ++j) {
        const std::size_t next = pointNumber(r, j, n, rotation);
        if (next != number) p = surfacePoint(r, number = next);
        const LightSample s = sampleLight(scene_, light, r2Point(j, shift));
        if (glm::distance(p.position, s.point) < reach) continue;
        const float g =
            geometryTerm(p.position, p.shading, p.geometric, image.imageFromWorld.point(s.point),
                         image.imageFromWorld.vector(s.normal)) /
            s.density;
        if (g > 0) addSample(j, p, image, {s.point, false}, g, s.radiance);
    }
}

void LightGatherer::addSample(int j, const Point& p, const LightImage& image, const Target& target,
                              float geometry, const Vec3& radiance) {
    Vec3 throughput(1);
    if (image.depth == 0)
        memory_.shadowRays.push_back(shadowRay(p.position + rays_.epsilon() * p.geometric, target));
    else
        throughput = followImage(p, image, target);
    memory_.samples.push_back({geometry, radiance, throughput, j % 2 == 1});
}

/// Traces the shadow rays of memory_.samples (none if they went by mirrors).
void LightGatherer::findVisible() {
    if (counts_ == Counts::blockedByExtra) return keepBlockedByExtra();
    if (rays_.hasPanes()) {
        memory_.passed.resize(memory_.shadowRays.size());
        rays_.transmittance(memory_.shadowRays, memory_.passed);
        for (std::size_t i = 0; i < memory_.shadowRays.size(); ++i)
            memory_.samples[i].throughput = memory_.passed[i];
        memory_.blocked.assign(memory_.shadowRays.size(), 0);
    } else {
        memory_.blocked.resize(memory_.shadowRays.size());
        rays_.occluded(memory_.shadowRays, memory_.blocked);
    }
    if (extra_) extra_(memory_.shadowRays, memory_.blocked);
    for (std::size_t i = 0; i < memory_.blocked.size(); ++i)
        if (memory_.blocked[i]) memory_.samples[i].throughput = Vec3(0);
}

/// The room is asked only where something else is in the way, which is rare.
void LightGatherer::keepBlockedByExtra() {
    memory_.blockedByExtra.assign(memory_.shadowRays.size(), 0);
    extra_(memory_.shadowRays, memory_.blockedByExtra);
    for (std::size_t i = 0; i < memory_.shadowRays.size(); ++i)
        memory_.samples[i].throughput =
            memory_.blockedByExtra[i] ? rays_.transmittance(memory_.shadowRays[i]).colour : Vec3(0);
}

bool LightGatherer::extraBlocks(const Ray& ray) {
    std::uint8_t blocked = 0;
    extra_({&ray, 1}, {&blocked, 1});
    return blocked != 0;
}

/// Mean form factor over the texel's points; over four of a full one if they agree.
float LightGatherer::formFactor(const LightReceiver& r, const Light& light,
                                const LightImage& image) const {
    if (r.points.size() == kLatinSquare.size() * kLatinSquare.size()) {
        float sum = 0, least = 1, most = 0;
        for (std::size_t i = 0; i < kLatinSquare.size(); ++i) {
            const std::size_t k = kLatinSquare.size() * i + kLatinSquare[i];
            const float f = formFactor(surfacePoint(r, k), light, image);
            sum += f;
            least = std::min(least, f);
            most = std::max(most, f);
        }
        if (most - least < kAgreement * most) return sum / kLatinSquare.size();
    }
    float sum = 0;
    for (std::size_t i = 0; i < r.points.size(); ++i)
        sum += formFactor(surfacePoint(r, i), light, image);
    return sum / static_cast<float>(r.points.size());
}

float LightGatherer::formFactor(const Point& p, const Light& light, const LightImage& image) const {
    float sum = 0;
    for (const std::uint32_t t : light.triangles) {
        std::array<Vec3, 3> corner;
        for (int c = 0; c < 3; ++c) corner[c] = image.imageFromWorld.point(scene_.position(t, c));
        const Vec3 n = image.imageFromWorld.vector(light.normal);
        const Vec3 fromLight = p.position - corner[0];
        if (glm::dot(n, fromLight) <= kGrazing * glm::length(fromLight)) continue;
        sum +=
            triangleFormFactor(p.position, p.shading, p.geometric, corner[0], corner[1], corner[2]);
    }
    return sum / receiverLobe(p.shading, p.geometric);
}

Ray LightGatherer::shadowRay(const Vec3& origin, const Target& target) const {
    if (target.distant) return {origin, target.at};
    const Vec3 d = target.at - origin;
    return {origin, d, 0, 1 - 2 * rays_.epsilon() / glm::length(d)};
}

/// Whether the line from p to the image of the target crosses the rectangles of all its mirrors,
/// which most do not: cheaper than to trace it.
bool LightGatherer::mayCrossMirrors(const Vec3& p, const LightImage& image,
                                    const Target& target) const {
    Vec3 from = p;
    Vec3 to = target.distant ? p + sources_.beyond * image.imageFromWorld.vector(target.at)
                             : image.imageFromWorld.point(target.at);
    for (int k = 0; k < image.depth; ++k) {
        const Chart& mirror = unwrap_.charts[image.mirror[k]];
        const float plane = sources_.mirrorOffset[image.mirror[k]];
        const float before = glm::dot(mirror.normal, from) - plane;
        const float behind = plane - glm::dot(mirror.normal, to);
        if (before <= 0 || behind <= 0) return false;
        from += (before / (before + behind)) * (to - from);
        const Vec2 crossing = mirror.texelCoordinates(from);
        if (crossing.x < -kSlack || crossing.x > mirror.width + kSlack || crossing.y < -kSlack ||
            crossing.y > mirror.height + kSlack)
            return false;
        to += 2 * behind * mirror.normal;
    }
    return true;
}

/// Product of the reflectances of the image's mirrors if the target is seen over exactly them, else
/// zero.
Vec3 LightGatherer::followImage(const Point& p, const LightImage& image, const Target& target) {
    if (!mayCrossMirrors(p.position, image, target)) return Vec3(0);
    Vec3 throughput(1);
    bool blockedByExtra = false;
    Vec3 origin = p.position + rays_.epsilon() * p.geometric;
    Vec3 direction = target.distant
                         ? image.imageFromWorld.vector(target.at)
                         : glm::normalize(image.imageFromWorld.point(target.at) - origin);
    for (int k = 0; k < image.depth; ++k) {
        const Hit hit = rays_.closest({origin, direction});
        if (!hit) return Vec3(0);
        if (extra_) blockedByExtra |= extraBlocks({origin, direction, 0, hit.t});
        const Vec3 n = geometricNormal(scene_, hit.triangle);
        const bool front = glm::dot(n, direction) < 0;
        const TriangleCharts& charts = unwrap_.triangleCharts[hit.triangle];
        if ((front ? charts.front : charts.back) != image.mirror[k]) return Vec3(0);
        throughput *= mirrorReflectance(scene_, scene_.material(hit.triangle),
                                        uvAt(scene_, hit.triangle, hit.barycentric));
        origin =
            positionAt(scene_, hit.triangle, hit.barycentric) + rays_.epsilon() * (front ? n : -n);
        direction = glm::reflect(direction, n);
    }
    const Ray last = shadowRay(origin, target);
    if (extra_) blockedByExtra = blockedByExtra || extraBlocks(last);
    if (blockedByExtra == (counts_ == Counts::seen)) return Vec3(0);
    return rays_.occluded(last) ? Vec3(0) : throughput;
}

}  // namespace vlf
