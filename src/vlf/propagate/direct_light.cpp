#include "vlf/propagate/direct_light.h"

#include "vlf/base/parallel.h"
#include "vlf/math/form_factor.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vlf {

namespace {

constexpr int kMaxAnalyticTriangles = 8;
constexpr int kFormFactorPoints = 4;
constexpr std::array<std::size_t, kTexelGrid> kLatinSquare{1, 3, 0, 2};  // column taken in each row
constexpr float kMinSamples = 3;
constexpr float kLittle = 0.01f;   // share of the likely effect of all lights
constexpr float kGrazing = 1e-5f;  // cosine: a point in a light's own plane gets nothing from it
constexpr std::size_t kTexelsPerBlock = 64;

// Second pass over texels in or beside a penumbra or close to a light: from kRefinement times the
// samples of the first, the more the larger its standard error; and the standard error (relative
// to the texel's light and the room's) that calls for it.
constexpr int kRefinement = 6, kMaxRefinement = 48;
constexpr float kRefineAbove = 0.004f, kRefineTo = 0.025f;
constexpr float kRoomShare = 0.3f;
constexpr float kShadowEdge = 0.25f;  // relative step between neighbours that counts as an edge

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

/// A texel as a receiver of light.
struct Receiver {
    std::span<const SurfacePoint> points;
    Vec3 centre{0}, normal{0};
    float radius = 0;
    bool planar = true;  // else normals vary so much that the mean says little
    float side = 1;      // -1 where the texels face against the winding normal
    std::uint64_t key = 0;
};

/// An estimate of irradiance, W·m⁻², and the variance of its luminance.
struct DirectEstimate {
    Vec3 value{0};
    float variance = 0;

    void add(const DirectEstimate& other, float scale) {
        value += scale * other.value;
        variance += scale * scale * other.variance;
    }
};

/// Estimates the texels' direct light.
class DirectGatherer {
  public:
    DirectGatherer(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
                   const LightSources& sources, const DirectLightParams& params)
        : scene_(scene), rays_(rays), unwrap_(unwrap), sources_(sources), params_(params) {}

    /// Irradiance of a texel by about `samples` shadow rays; `pass` tells independent estimates
    /// of the same texel apart.
    DirectEstimate irradiance(std::size_t texel, int samples, std::uint64_t pass) {
        const Receiver receiver = makeReceiver(texel);
        estimates_.clear();
        float sum = 0;
        for (const LightImage& image : sources_.images)
            sum += estimates_.emplace_back(estimate(receiver, image));
        DirectEstimate total;
        if (sum <= 0) return total;
        RandomStream random(params_.seed + pass, receiver.key);
        for (std::size_t i = 0; i < estimates_.size(); ++i) {
            if (estimates_[i] <= 0) continue;
            // Lights of some effect get a few samples whatever the others: those may be hidden.
            // One of little effect is picked with a probability below one.
            const float share = estimates_[i] / sum;
            const float wanted = std::max(static_cast<float>(samples) * share,
                                          std::min(kMinSamples, kMinSamples * share / kLittle));
            if (wanted < 1 && random.next() >= wanted) continue;
            const int n = std::max(1, static_cast<int>(std::ceil(wanted)));
            total.add(gather(receiver, sources_.images[i], n, random), std::max(1.0f, 1 / wanted));
        }
        return total;
    }

  private:
    Receiver makeReceiver(std::size_t texel) const {
        Receiver r;
        r.points = unwrap_.points.of(texel);
        const Chart& chart = unwrap_.charts[unwrap_.texelChart[texel]];
        const std::uint32_t triangle = r.points[0].triangle;
        r.side = unwrap_.triangleCharts[triangle].front == unwrap_.texelChart[texel] ? 1.0f : -1.0f;
        r.normal = chart.normal;
        r.planar = chart.planar;
        for (const SurfacePoint& p : r.points)
            r.centre += positionAt(scene_, p.triangle, p.barycentric);
        r.centre /= static_cast<float>(r.points.size());
        r.radius = chart.planar ? chart.texelSize() : 2 * chart.texelSize();
        r.key = unwrap_.texels[texel];
        return r;
    }

    /// Roughly the unoccluded irradiance's luminance; zero only if it certainly is.
    float estimate(const Receiver& r, const LightImage& image) const {
        const Light& light = sources_.lights[image.light];
        const Vec3 toLight = image.imageFromWorld.point(light.centre) - r.centre;
        const float reach = light.radius + r.radius;
        const float squared = std::max(glm::dot(toLight, toLight), 0.25f * reach * reach);
        const float distance = std::sqrt(squared), slack = std::min(1.0f, reach / distance);
        if (r.planar && glm::dot(r.normal, toLight) < -reach) return 0;
        const float cosReceiver = glm::dot(r.normal, toLight) / distance;
        const float cosLight =
            -glm::dot(image.imageFromWorld.vector(light.normal), toLight) / distance;
        const float spread =
            light.planar ? 0.0f : std::acos(std::clamp(light.normalCosine, -1.0f, 1.0f));
        if (light.planar && cosLight < -slack) return 0;
        if (image.depth > 0 && !mayBeSeenInMirror(r, image)) return 0;
        const float facing = std::clamp(cosReceiver + 0.5f * slack, 0.02f, 1.0f);
        const float emitting = std::clamp(cosLight + 0.5f * slack + spread, 0.02f, 1.0f);
        return luminance(light.radiance * image.throughput) * light.area * facing * emitting /
               squared;
    }

    /// Whether lines from the receiver to the image may cross the rectangle of the first mirror.
    bool mayBeSeenInMirror(const Receiver& r, const LightImage& image) const {
        const Chart& mirror = unwrap_.charts[image.mirror[0]];
        const Light& light = sources_.lights[image.light];
        const Vec3 centre = image.imageFromWorld.point(light.centre);
        const float plane = sources_.mirrorOffset[image.mirror[0]];
        const float before = glm::dot(mirror.normal, r.centre) - plane;
        const float behind = plane - glm::dot(mirror.normal, centre);
        if (before < -r.radius || behind < -light.radius) return false;
        const float share = std::max(before, 0.0f) / std::max(before + behind, 1e-20f);
        const Vec2 crossing = mirror.texelCoordinates(r.centre + share * (centre - r.centre));
        // How far the crossing moves as the ends move within their spheres, seen aslant.
        const float cosine = std::max(before + behind, 1e-20f) / glm::distance(centre, r.centre);
        const float reach = (share * light.radius + (1 - share) * r.radius) / cosine;
        const Vec2 margin(reach * glm::length(mirror.uAxis), reach * glm::length(mirror.vAxis));
        return crossing.x > -margin.x && crossing.x < mirror.width + margin.x &&
               crossing.y > -margin.y && crossing.y < mirror.height + margin.y;
    }

    struct Point {
        Vec3 position, shading, geometric;
    };

    Point surfacePoint(const Receiver& r, std::size_t i) const {
        const SurfacePoint& p = r.points[i];
        return {positionAt(scene_, p.triangle, p.barycentric),
                r.side * shadingNormalAt(scene_, p.triangle, p.barycentric),
                r.side * geometricNormal(scene_, p.triangle)};
    }

    /// Irradiance from one image by n samples.
    DirectEstimate gather(const Receiver& r, const LightImage& image, int n, RandomStream& random) {
        const Light& light = sources_.lights[image.light];
        drawSamples(r, image, n, random);
        findVisible();
        Vec3 seen(0), throughput(0);
        float geometry = 0, visible = 0, squares = 0;
        for (const Sample& s : samples_) {
            const float contribution = s.geometry * luminance(s.throughput * s.radiance);
            squares += contribution * contribution;
            geometry += s.geometry;
            throughput += s.geometry * s.throughput;
            seen += s.geometry * s.throughput * s.radiance;
            visible += maxComponent(s.throughput) > 0 ? s.geometry : 0;
        }
        if (geometry <= 0) return {};
        const auto count = static_cast<float>(n);
        if (!hasFormFactor(light)) {
            const Vec3 mean = seen / count;
            const float spread =
                std::max(0.0f, squares / count - luminance(mean) * luminance(mean));
            return {mean, spread / count};
        }
        // The unoccluded part of a plain light is known exactly: only the share of it that is
        // visible is sampled.
        const Vec3 value =
            light.radiance * kPi * formFactor(r, light, image) * (throughput / geometry);
        const float share = visible / geometry;
        const float unoccluded = luminance(value) / std::max(share, 0.5f / count);
        return {value, unoccluded * unoccluded * share * (1 - share) / count};
    }

    /// Pairs of a point of the texel and one of the light, both stratified, that face each other.
    void drawSamples(const Receiver& r, const LightImage& image, int n, RandomStream& random) {
        const Light& light = sources_.lights[image.light];
        const Vec2 shift = random.next2();
        const float rotation = random.next();
        samples_.clear();
        shadowRays_.clear();
        for (int j = 0; j < n; ++j) {
            const auto stratum = static_cast<std::size_t>((j + rotation) / n * r.points.size());
            const Point p = surfacePoint(r, (stratum + r.key) % r.points.size());
            const LightSample s = sampleLight(scene_, light, r2Point(j, shift));
            const float g = geometryTerm(p, image.imageFromWorld.point(s.point),
                                         image.imageFromWorld.vector(s.normal)) /
                            s.density;
            if (g <= 0) continue;
            if (image.depth == 0) {
                addShadowRay(p, s.point);
                samples_.push_back({g, s.radiance, Vec3(1)});
            } else {
                samples_.push_back({g, s.radiance, followImage(p, image, s.point)});
            }
        }
    }

    /// Traces the shadow rays of samples_ (none if they went by mirrors).
    void findVisible() {
        blocked_.resize(shadowRays_.size());
        rays_.occluded(shadowRays_, blocked_);
        for (std::size_t i = 0; i < blocked_.size(); ++i)
            if (blocked_[i]) samples_[i].throughput = Vec3(0);
    }

    static bool hasFormFactor(const Light& light) {
        return light.uniform && light.planar && light.triangles.size() <= kMaxAnalyticTriangles;
    }

    /// ∫ (n·ω)⁺ / π over the directions above the surface, n being the shading normal. Divided by
    /// it the receiver's response integrates to one, as that of the bundles' ratio does.
    static float lobe(const Point& p) { return 0.5f * (1 + glm::dot(p.shading, p.geometric)); }

    static float geometryTerm(const Point& p, const Vec3& y, const Vec3& lightNormal) {
        const Vec3 d = y - p.position;
        const float squared = glm::dot(d, d);
        const float cosReceiver = glm::dot(p.shading, d), cosLight = -glm::dot(lightNormal, d);
        if (cosReceiver <= 0 || glm::dot(p.geometric, d) <= 0) return 0;
        if (cosLight <= kGrazing * std::sqrt(squared)) return 0;
        return cosReceiver * cosLight / (squared * squared * lobe(p));
    }

    /// Mean form factor over a few of the texel's points.
    float formFactor(const Receiver& r, const Light& light, const LightImage& image) const {
        const std::size_t count = std::min<std::size_t>(kFormFactorPoints, r.points.size());
        float sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t k = r.points.size() == kLatinSquare.size() * kLatinSquare.size()
                                      ? kLatinSquare.size() * i + kLatinSquare[i]
                                      : (2 * i + 1) * r.points.size() / (2 * count);
            const Point p = surfacePoint(r, k);
            for (const std::uint32_t t : light.triangles) {
                std::array<Vec3, 3> corner;
                for (int c = 0; c < 3; ++c)
                    corner[c] = image.imageFromWorld.point(scene_.position(t, c));
                const Vec3 n = image.imageFromWorld.vector(light.normal);
                const Vec3 fromLight = p.position - corner[0];
                if (glm::dot(n, fromLight) <= kGrazing * glm::length(fromLight)) continue;
                sum += triangleFormFactor(p.position, p.shading, corner[0], corner[1], corner[2]) /
                       lobe(p);
            }
        }
        return sum / static_cast<float>(count);
    }

    void addShadowRay(const Point& p, const Vec3& y) {
        const Vec3 origin = p.position + rays_.epsilon() * p.geometric;
        const Vec3 d = y - origin;
        shadowRays_.push_back({origin, d, 0, 1 - 2 * rays_.epsilon() / glm::length(d)});
    }

    /// Product of the reflectances of the image's mirrors if the light's point y is seen over
    /// exactly them, else zero.
    Vec3 followImage(const Point& p, const LightImage& image, const Vec3& y) const {
        Vec3 throughput(1);
        Vec3 origin = p.position + rays_.epsilon() * p.geometric;
        Vec3 direction = glm::normalize(image.imageFromWorld.point(y) - origin);
        for (int k = 0; k < image.depth; ++k) {
            const Hit hit = rays_.closest({origin, direction});
            if (!hit) return Vec3(0);
            const Vec3 n = geometricNormal(scene_, hit.triangle);
            const bool front = glm::dot(n, direction) < 0;
            const TriangleCharts& charts = unwrap_.triangleCharts[hit.triangle];
            if ((front ? charts.front : charts.back) != image.mirror[k]) return Vec3(0);
            throughput *= mirrorReflectance(scene_, scene_.material(hit.triangle),
                                            uvAt(scene_, hit.triangle, hit.barycentric));
            origin = positionAt(scene_, hit.triangle, hit.barycentric) +
                     rays_.epsilon() * (front ? n : -n);
            direction = glm::reflect(direction, n);
        }
        const Vec3 d = y - origin;
        const bool seen = !rays_.occluded({origin, d, 0, 1 - 2 * rays_.epsilon() / glm::length(d)});
        return seen ? throughput : Vec3(0);
    }

    struct Sample {
        float geometry;
        Vec3 radiance, throughput;  // throughput: of the mirrors on the way; 0 if occluded
    };

    const Scene& scene_;
    const RayScene& rays_;
    const Unwrap& unwrap_;
    const LightSources& sources_;
    DirectLightParams params_;
    std::vector<float> estimates_;
    std::vector<Ray> shadowRays_;
    std::vector<std::uint8_t> blocked_;
    std::vector<Sample> samples_;
};

/// Runs `visit(gatherer, texel)` for every texel, each thread with a gatherer of its own.
template <class Visit>
void forEachTexel(std::size_t texels, const DirectGatherer& prototype, ProgressCounter& done,
                  Visit visit) {
    parallelFor((texels + kTexelsPerBlock - 1) / kTexelsPerBlock, 4, [&](std::size_t block) {
        DirectGatherer gatherer = prototype;
        const std::size_t end = std::min(texels, (block + 1) * kTexelsPerBlock);
        for (std::size_t i = block * kTexelsPerBlock; i < end; ++i) visit(gatherer, i);
        done.step();
    });
}

/// Which texels lie in or beside a penumbra, or at a shadow's edge.
class PenumbraFinder {
  public:
    PenumbraFinder(const Unwrap& unwrap, const std::vector<DirectEstimate>& estimates)
        : unwrap_(unwrap), estimates_(estimates), entryOf_(unwrap.atlasSize(), kNone) {
        double sum = 0;
        for (std::size_t i = 0; i < estimates.size(); ++i) {
            entryOf_[unwrap.texels[i]] = static_cast<std::uint32_t>(i);
            sum += luminance(estimates[i].value);
        }
        roomLight_ = kRoomShare * static_cast<float>(sum / static_cast<double>(estimates.size()));
    }

    /// How many times the first pass's samples the texel needs; 0: no more.
    int operator()(std::size_t i) const {
        const auto texel = static_cast<std::int64_t>(unwrap_.texels[i]);
        const auto pitch = static_cast<std::int64_t>(unwrap_.atlasWidth);
        const float own = luminance(estimates_[i].value);
        float error = 0;
        bool edge = false;
        // The gutter keeps all neighbours within the atlas.
        for (std::int64_t dy = -1; dy <= 1; ++dy)
            for (std::int64_t dx = -1; dx <= 1; ++dx) {
                const std::uint32_t n = entryOf_[texel + dy * pitch + dx];
                if (n == kNone) continue;
                const float other = luminance(estimates_[n].value);
                const float light = std::max(own, other) + roomLight_;
                error = std::max(error, std::sqrt(estimates_[n].variance) / light);
                edge = edge || std::abs(other - own) > kShadowEdge * light;
            }
        if (error < kRefineAbove && !edge) return 0;
        const float wanted = error * error / (kRefineTo * kRefineTo);
        return static_cast<int>(std::clamp<float>(wanted, kRefinement, kMaxRefinement));
    }

  private:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    const Unwrap& unwrap_;
    const std::vector<DirectEstimate>& estimates_;
    std::vector<std::uint32_t> entryOf_;  // per atlas texel
    float roomLight_ = 0;
};

}  // namespace

std::vector<Vec3> directIrradiance(const Scene& scene, const RayScene& rays, const Unwrap& unwrap,
                                   const LightSources& sources, const DirectLightParams& params,
                                   Progress& progress) {
    const std::size_t texels = unwrap.texels.size();
    std::vector<Vec3> irradiance(texels, Vec3(0));
    if (sources.images.empty()) return irradiance;
    const DirectGatherer prototype(scene, rays, unwrap, sources, params);
    ProgressCounter done(progress, 2 * ((texels + kTexelsPerBlock - 1) / kTexelsPerBlock));
    std::vector<DirectEstimate> first(texels);
    forEachTexel(texels, prototype, done, [&](DirectGatherer& gatherer, std::size_t i) {
        first[i] = gatherer.irradiance(i, params.samples, 0);
    });
    const PenumbraFinder needsMore(unwrap, first);
    forEachTexel(texels, prototype, done, [&](DirectGatherer& gatherer, std::size_t i) {
        irradiance[i] = first[i].value;
        const int times = needsMore(i);
        if (times == 0) return;
        const Vec3 more = gatherer.irradiance(i, times * params.samples, 1).value;
        irradiance[i] =
            (first[i].value + static_cast<float>(times) * more) / static_cast<float>(1 + times);
    });
    return irradiance;
}

}  // namespace vlf
