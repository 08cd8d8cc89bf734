#include "vlf/propagate/ray_gather.h"

#include "vlf/math/microfacet.h"
#include "vlf/math/sampling.h"
#include "vlf/trace/shadow_ray.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr float kMinThroughput = 1e-4f;

std::uint32_t texelAt(const Unwrap& unwrap, std::uint32_t chartIndex, const Vec3& p) {
    const Chart& chart = unwrap.charts[chartIndex];
    const Vec2 t = chart.texelCoordinates(p);
    const auto x = static_cast<std::uint32_t>(std::clamp(t.x, 0.0f, chart.width - 1.0f));
    const auto y = static_cast<std::uint32_t>(std::clamp(t.y, 0.0f, chart.height - 1.0f));
    return (chart.y + y) * unwrap.atlasWidth + chart.x + x;
}

}  // namespace

/// A mirror whose reflection needs no look at the surface: flat, perfect and without texture.
bool RayGatherer::isPlainMirror(std::uint32_t chart) const {
    return sources_.planarMirror[chart] &&
           scene_.materials[unwrap_.charts[chart].material].mirrorTexture < 0;
}

/// Whether what the inside of a solid of glass itself receives is asked for: nobody needs that.
bool RayGatherer::isWithinGlass(const MirrorSight& sight) const {
    const std::uint32_t chart = sources_.mirrorChart[sight.receiver];
    return chart != kNoChart && sources_.withinGlass[chart] != 0;
}

void RayGatherer::startAtMirrors(const ParallelSubfield& subfield,
                                 const std::vector<MirrorSight>& sights, RandomStream& random) {
    paths_.clear();
    queue_.clear();
    const float perCell = 1 / glm::dot(subfield.xAxis, subfield.xAxis);
    const Vec3 origin = -(perCell * (subfield.xOffset - 0.5f)) * subfield.xAxis -
                        (perCell * (subfield.yOffset - 0.5f)) * subfield.yAxis -
                        subfield.depthOffset * subfield.direction;
    for (const MirrorSight& s : sights) {
        if (isWithinGlass(s)) continue;
        const Vec3 direction = s.forward ? subfield.direction : -subfield.direction;
        const Vec3 cell =
            origin + (perCell * s.x) * subfield.xAxis + (perCell * s.y) * subfield.yAxis;
        const std::uint32_t chart = sources_.mirrorChart[s.mirror];
        const Material& material = scene_.materials[unwrap_.charts[chart].material];
        const Vec3& mirror = material.mirror;
        const float chance = material.isGlass() ? 1 : chanceToFollow(mirror);
        if (chance < 1 && random.next() >= chance) continue;
        if (isPlainMirror(chart)) {
            const Vec3& n = unwrap_.charts[chart].normal;
            queue_.push_back({cell + s.mirrorDepth * subfield.direction + rays_.epsilon() * n,
                              glm::reflect(direction, n)});
            paths_.push_back({s.receiver, 1, true, false, mirror / chance, 1});
        } else {
            // From the receiver on, to find where exactly the mirror is met.
            queue_.push_back(
                {cell + s.receiverDepth * subfield.direction + rays_.epsilon() * direction,
                 direction});
            paths_.push_back({s.receiver, 0, true, false, Vec3(1 / chance)});
        }
    }
}

/// A ray from a random point of the texel, cosine-distributed about the shading normal. One below
/// the surface is drawn again.
Ray RayGatherer::texelRay(std::size_t texel, const Vec2& sample, RandomStream& random) const {
    const auto points = unwrap_.points.of(texel);
    const SurfacePoint& p = points[random.nextBits() % points.size()];
    const bool front = unwrap_.triangleCharts[p.triangle].front == unwrap_.texelChart[texel];
    const float side = front ? 1.0f : -1.0f;
    const Vec3 surface = side * geometricNormal(scene_, p.triangle);
    Vec3 normal = shadingNormalAt(scene_, p.triangle, p.barycentric);
    if (glm::dot(normal, surface) < 0) normal = -normal;
    const Frame frame = frameFromNormal(normal);
    Vec3 direction = frame.toWorld(sampleCosineHemisphere(sample));
    while (glm::dot(direction, surface) <= 0)
        direction = frame.toWorld(sampleCosineHemisphere(random.next2()));
    return {positionAt(scene_, p.triangle, p.barycentric) + rays_.epsilon() * surface, direction};
}

void RayGatherer::advance(RandomStream& random, const TexelBuffer& radiance,
                          TexelBuffer& gathered) {
    hits_.resize(queue_.size());
    rays_.closest(queue_, hits_);
    nextPaths_.clear();
    nextQueue_.clear();
    for (std::size_t i = 0; i < hits_.size(); ++i) {
        const Hit& hit = hits_[i];
        const Path& path = paths_[i];
        const bool countsItself = path.fromTexel && path.steps == 0;
        if (!hit) {
            if (countsItself || path.steps > 0)
                gathered.add(path.receiver,
                             path.throughput * outsideSeen(path, queue_[i].direction),
                             countsItself ? 1 : 0);
            continue;
        }
        const bool front = glm::dot(areaVector(scene_, hit.triangle), queue_[i].direction) < 0;
        const TriangleCharts& charts = unwrap_.triangleCharts[hit.triangle];
        const std::uint32_t chart = front ? charts.front : charts.back;
        if (chart == kNoChart) continue;
        const Vec3 position = queue_[i].origin + hit.t * queue_[i].direction;
        if (countsItself && radiance.weight(texelAt(unwrap_, chart, position)) <= 0) continue;
        if (countsItself || path.steps > 0)
            gathered.add(
                path.receiver,
                path.throughput * radianceSeen(path, hit, chart, front, position, radiance),
                countsItself ? 1 : 0);
        if (path.steps == kMaxReflections) continue;
        const Material& material = scene_.material(hit.triangle);
        if (material.isGlass())
            passGlass(path, queue_[i].direction, hit, front, position, random);
        else if (material.isMirror())
            reflect(path, queue_[i].direction, hit, chart, front, position, random, gathered);
    }
    std::swap(paths_, nextPaths_);
    std::swap(queue_, nextQueue_);
}

Vec3 RayGatherer::radianceSeen(const Path& path, const Hit& hit, std::uint32_t chart, bool front,
                               const Vec3& position, const TexelBuffer& radiance) const {
    const Vec3 reflected = radiance.rgb(texelAt(unwrap_, chart, position));
    const Material& material = scene_.material(hit.triangle);
    if (!material.isEmitter() || !(front || material.emitsBothSides) ||
        sources_.covers(path.reflections, path.planarOnly, path.behindPanes))
        return reflected;
    return reflected +
           emittedRadiance(scene_, material, uvAt(scene_, hit.triangle, hit.barycentric));
}

/// The environment, but for the bright part as far as the rough mirror on the way has it already.
Vec3 RayGatherer::outsideSeen(const Path& path, const Vec3& direction) const {
    const Vec3 radiance = sources_.outside(direction, path.reflections, path.planarOnly,
                                           path.behindPanes);
    if (path.lobe <= 0 || radiance == Vec3(0) || !sources_.sky->sky.hasBright()) return radiance;
    const Sky& sky = sources_.sky->sky;
    return sky.smooth(direction) +
           path.lobe / (path.lobe + sky.density(direction)) * sky.bright(direction);
}

/// Light that a rough mirror reflects to the receiver and that its lobe would find too seldom.
void RayGatherer::lightRough(const Path& path, const RoughPoint& at, RandomStream& random,
                             TexelBuffer& gathered) const {
    if (sources_.allApart) return;
    Vec3 light(0);
    if (!sources_.punctual.empty()) light += punctualIn(at, random);
    if (sources_.sky && sources_.sky->sky.hasBright()) light += skyIn(at, random);
    if (light != Vec3(0)) gathered.add(path.receiver, path.throughput * light, 0);
}

Vec3 RayGatherer::punctualIn(const RoughPoint& at, RandomStream& random) const {
    const Vec3 origin = at.position + rays_.epsilon() * at.side;
    const PickedBeam picked =
        pickBeam(sources_.punctual, at.position, rays_.epsilon(), random.next());
    const Vec3& direction = picked.beam.toLight;
    if (picked.probability <= 0 || glm::dot(direction, at.side) <= 0) return Vec3(0);
    const float lobe = ggxLobe(at.roughness, at.toEye, at.frame.toLocal(direction));
    if (lobe <= 0) return Vec3(0);
    return rays_.transmittance(shadowRay(origin, picked.beam, rays_.epsilon())).colour *
           (lobe / picked.probability) * picked.beam.irradiance;
}

/// By the balance heuristic with the ray that the lobe has drawn.
Vec3 RayGatherer::skyIn(const RoughPoint& at, RandomStream& random) const {
    const Sky::Sample sample = sources_.sky->sky.sample(random.next2());
    if (glm::dot(sample.direction, at.side) <= 0) return Vec3(0);
    const Vec3 local = at.frame.toLocal(sample.direction);
    const float lobe = ggxLobe(at.roughness, at.toEye, local);
    if (lobe <= 0) return Vec3(0);
    const Transmittance passed =
        rays_.transmittance({at.position + rays_.epsilon() * at.side, sample.direction});
    const float byLobe = ggxDensity(at.roughness, at.toEye, local) * passed.chance;
    return lobe / (sample.density + byLobe) * sample.bright * passed.colour;
}

void RayGatherer::reflect(Path path, const Vec3& direction, const Hit& hit, std::uint32_t chart,
                          bool front, const Vec3& position, RandomStream& random,
                          TexelBuffer& gathered) {
    const bool planar = sources_.planarMirror[chart] != 0;
    const Material& material = scene_.material(hit.triangle);
    const Vec3 mirror =
        mirrorReflectance(scene_, material, uvAt(scene_, hit.triangle, hit.barycentric));
    path.throughput *= mirror;
    const bool chosen = path.steps == 0 && !path.fromTexel;  // as a sight
    const float chance = chosen ? 1 : chanceToFollow(mirror);
    if (chance < 1 && random.next() >= chance) return;
    path.throughput /= chance;
    path.planarOnly = path.planarOnly && planar;
    ++path.reflections;
    ++path.steps;
    const Vec3 side = geometricNormal(scene_, hit.triangle) * (front ? 1.0f : -1.0f);
    Vec3 normal = planar ? side : shadingNormalAt(scene_, hit.triangle, hit.barycentric);
    if (glm::dot(normal, side) < 0) normal = -normal;
    Vec3 reflected = glm::reflect(direction, normal);
    path.lobe = 0;
    if (material.isGlossy()) {
        if (glm::dot(normal, direction) >= 0) normal = side;
        RoughPoint at{position, side, frameFromNormal(normal), Vec3(0), material.roughness};
        at.toEye = at.frame.toLocal(-direction);
        at.toEye.z = std::max(at.toEye.z, 1e-4f);
        lightRough(path, at, random, gathered);
        const GlossyReflection glossy =
            sampleGgxReflection(material.roughness, direction, normal, random.next2());
        reflected = glossy.direction;
        path.throughput *= glossy.weight;
        if (sources_.sky && sources_.sky->sky.hasBright())
            path.lobe = ggxDensity(material.roughness, at.toEye, at.frame.toLocal(reflected));
    }
    if (glm::dot(reflected, side) <= 0 || maxComponent(path.throughput) < kMinThroughput) return;
    nextQueue_.push_back({position + rays_.epsilon() * side, reflected});
    nextPaths_.push_back(path);
}

/// Panes that are passed straight leave a path what it is.
void RayGatherer::passGlass(Path path, const Vec3& direction, const Hit& hit, bool front,
                            const Vec3& position, RandomStream& random) {
    const Material& glass = scene_.material(hit.triangle);
    const Vec3 side = geometricNormal(scene_, hit.triangle) * (front ? 1.0f : -1.0f);
    Vec3 normal = shadingNormalAt(scene_, hit.triangle, hit.barycentric);
    if (glm::dot(normal, side) < 0) normal = -normal;
    const GlassSplit split =
        splitAtGlass(glass.medium(), glm::normalize(direction), normal, side, front);
    const bool reflects = random.next() < split.reflectance;
    if (!reflects) path.throughput *= split.radianceScale * glass.transmission;
    if (maxComponent(path.throughput) < kMinThroughput) return;
    ++path.steps;
    const bool straight = !reflects && glass.thin;
    path.behindPanes = path.behindPanes || straight;
    path.planarOnly = path.planarOnly && straight;
    path.lobe *= straight ? 1 - split.reflectance : 0;  // shadow rays pass panes alone
    const float offset = reflects ? rays_.epsilon() : -rays_.epsilon();
    nextQueue_.push_back(
        {position + offset * side, reflects ? split.reflected : split.transmitted});
    nextPaths_.push_back(path);
}

void RayGatherer::gatherFromMirrors(const ParallelSubfield& subfield,
                                    const std::vector<MirrorSight>& sights, RandomStream& random,
                                    const TexelBuffer& radiance, TexelBuffer& gathered) {
    if (sights.empty()) return;
    startAtMirrors(subfield, sights, random);
    while (!queue_.empty()) advance(random, radiance, gathered);
}

void RayGatherer::gatherFromTexel(std::size_t i, int count, RandomStream& random,
                                  const TexelBuffer& radiance, TexelBuffer& gathered) {
    paths_.clear();
    queue_.clear();
    const Vec2 shift = random.next2();
    for (int k = 0; k < count; ++k) {
        queue_.push_back(texelRay(i, r2Point(static_cast<std::uint32_t>(k), shift), random));
        paths_.push_back({unwrap_.texels[i], 0, true, true, Vec3(1)});
    }
    while (!queue_.empty()) advance(random, radiance, gathered);
}

}  // namespace vlf
