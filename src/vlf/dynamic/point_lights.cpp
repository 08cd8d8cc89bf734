#include "vlf/dynamic/point_lights.h"

#include "vlf/base/parallel.h"
#include "vlf/dynamic/emitter_points.h"
#include "vlf/propagate/light_gatherer.h"

#include <algorithm>
#include <limits>

namespace vlf {

namespace {

constexpr int kEmitterPoints = 256;
constexpr float kWide = 0.2f;          // of a light that is to be split, relative to the room
constexpr float kNormalWeight = 0.5f;  // of a difference of normals, in radii of the room
constexpr float kLeastAlike = 0.5f;    // length of a mean normal that still is one
constexpr std::size_t kAmbientTexels = 1024;
constexpr int kAmbientSamples = 16;
constexpr std::size_t kVerticesPerBlock = 256;

/// A piece of an emitter; of a body that shines in all directions, the normal is zero.
struct Piece {
    Vec3 position, normal, power;
    float weight, area;
};

std::vector<Piece> emitterPieces(const Scene& scene, const LightSources& sources) {
    std::vector<Piece> pieces;
    const EmitterPoints emitters = spreadPoints(scene, sources, kEmitterPoints, 0);
    for (const EmitterShare& share : emitters.shares) {
        const LightImage& image = sources.images[share.image];
        if (image.depth > 0) continue;
        const Light& light = sources.lights[image.light];
        const bool allRound = !light.planar && light.normalCosine <= 0;
        for (std::uint32_t p = share.first; p < share.first + share.count; ++p) {
            const EmitterPoint& point = emitters.points[p];
            const Vec3 power = kPi * point.area * point.radiance;
            pieces.push_back({point.position, allRound ? Vec3(0) : point.normal, power,
                              luminance(power), point.area});
        }
    }
    return pieces;
}

/// Pieces first to last - 1 of a list, and how far they are from being one light.
struct Cluster {
    std::size_t first = 0, last = 0;
    Vec3 position{0}, normal{0}, power{0};  ///< means, and the sum
    float area = 0, weight = 0;
    float spread = 0;  ///< mean square distance, in radii of the room, from the means
    int axis = 0;      ///< along which they differ most: of position, then of the normal
};

float coordinate(const Piece& piece, int axis, float radius) {
    return axis < 3 ? piece.position[axis] / radius : kNormalWeight * piece.normal[axis - 3];
}

Cluster clusterOf(const std::vector<Piece>& pieces, std::size_t first, std::size_t last,
                  float radius) {
    Cluster c{.first = first, .last = last};
    for (std::size_t i = first; i < last; ++i) {
        const Piece& p = pieces[i];
        c.position += p.weight * p.position;
        c.normal += p.weight * p.normal;
        c.power += p.power;
        c.weight += p.weight;
        c.area += p.area;
    }
    if (c.weight > 0) c.position /= c.weight, c.normal /= c.weight;
    const Piece mean{c.position, c.normal, Vec3(0), 0, 0};
    float most = 0;
    for (int axis = 0; axis < 6; ++axis) {
        float variance = 0;
        for (std::size_t i = first; i < last; ++i) {
            const float d = coordinate(pieces[i], axis, radius) - coordinate(mean, axis, radius);
            variance += pieces[i].weight * d * d;
        }
        if (c.weight > 0) variance /= c.weight;
        c.spread += variance;
        if (variance > most) most = variance, c.axis = axis;
    }
    return c;
}

/// Splits the cluster whose power times spread is largest until all are narrow.
std::vector<Cluster> cluster(std::vector<Piece>& pieces, float radius, std::size_t maxLights) {
    std::vector<Cluster> clusters{clusterOf(pieces, 0, pieces.size(), radius)};
    while (clusters.size() < maxLights) {
        const auto cost = [](const Cluster& c) {
            return c.spread > kWide * kWide && c.last - c.first > 1 ? c.weight * c.spread : 0;
        };
        const auto worst =
            std::max_element(clusters.begin(), clusters.end(),
                             [&](const Cluster& a, const Cluster& b) { return cost(a) < cost(b); });
        if (cost(*worst) <= 0) break;
        const Cluster whole = *worst;
        const Piece mean{whole.position, whole.normal, Vec3(0), 0, 0};
        const float middle = coordinate(mean, whole.axis, radius);
        const auto begin = pieces.begin() + static_cast<std::ptrdiff_t>(whole.first);
        const auto end = pieces.begin() + static_cast<std::ptrdiff_t>(whole.last);
        const auto cut = std::stable_partition(
            begin, end, [&](const Piece& p) { return coordinate(p, whole.axis, radius) < middle; });
        if (cut == begin || cut == end) break;
        const auto at = static_cast<std::size_t>(cut - pieces.begin());
        *worst = clusterOf(pieces, whole.first, at, radius);
        clusters.push_back(clusterOf(pieces, at, whole.last, radius));
    }
    return clusters;
}

/// At the middle, if that is on the emitters, else at the nearest of them: in between there may be
/// walls.
PointLight lightOf(const Cluster& c, const std::vector<Piece>& pieces, float epsilon) {
    PointLight light;
    light.area = c.area;
    const bool allRound = glm::length(c.normal) < kLeastAlike;
    if (allRound) {
        light.position = c.position;
        light.intensity = c.power / (4 * kPi);
        for (std::size_t i = c.first; i < c.last; ++i)
            light.radius =
                std::max(light.radius, 1.01f * glm::distance(pieces[i].position, c.position));
        return light;
    }
    light.normal = glm::normalize(c.normal);
    light.intensity = c.power / kPi;
    float least = std::numeric_limits<float>::max();
    for (std::size_t i = c.first; i < c.last; ++i) {
        const float distance = glm::distance(pieces[i].position, c.position);
        if (distance < least) least = distance, light.position = pieces[i].position;
    }
    if (least < 0.5f * std::sqrt(c.area)) light.position = c.position;
    light.position += 2 * epsilon * light.normal;
    return light;
}

Vec3 meanIndirect(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                  const IrradianceAtlas& atlas) {
    const std::size_t count = room.unwrap.texels.size();
    const std::size_t step = std::max<std::size_t>(1, count / kAmbientTexels);
    std::vector<Vec3> direct((count + step - 1) / step);
    parallelFor(direct.size(), 32, [&](std::size_t i) {
        LightGatherer gatherer(scene, rays, room.unwrap, room.sources, 0);
        direct[i] =
            gatherer.irradiance(texelReceiver(scene, room.unwrap, i * step), kAmbientSamples, 0)
                .value;
    });
    glm::dvec3 sum(0);
    double area = 0;
    for (std::size_t i = 0; i < direct.size(); ++i) {
        const std::uint32_t texel = room.unwrap.texels[i * step];
        const double a = room.area[texel];
        sum += a * glm::dvec3(atlas.irradiance[texel] - direct[i]);
        area += a;
    }
    return area > 0 ? glm::max(Vec3(sum / area), Vec3(0)) : Vec3(0);
}

/// Adds the light on the vertices first to last - 1, those beyond the mesh's number being backs.
void addLight(const PointLight& light, const ObjectMesh& mesh, const Pose& pose,
              const RayScene& room, std::size_t first, std::size_t last,
              std::span<Vec3> irradiance) {
    thread_local std::vector<Ray> rays;
    thread_local std::vector<float> factors;
    thread_local std::vector<std::size_t> lit;
    thread_local std::vector<std::uint8_t> blocked;
    rays.clear(), factors.clear(), lit.clear();
    const std::size_t vertices = mesh.scene.positions.size();
    for (std::size_t i = first; i < last; ++i) {
        const std::size_t v = i % vertices;
        const Vec3 normal = (i < vertices ? 1.0f : -1.0f) * pose.direction(mesh.scene.normals[v]);
        const Vec3 origin = pose.point(mesh.scene.positions[v]) + room.epsilon() * normal;
        const Vec3 way = light.position - origin;
        const float distance = glm::length(way);
        const float cosine = glm::dot(normal, way) / distance;
        const float lightCosine =
            light.normal == Vec3(0) ? 1 : -glm::dot(light.normal, way) / distance;
        if (!(cosine > 0 && lightCosine > 0) || distance <= light.radius) continue;
        rays.push_back({origin, way, 0, 1 - light.radius / distance});
        factors.push_back(cosine * lightCosine / (distance * distance + light.area / kPi));
        lit.push_back(i);
    }
    blocked.resize(rays.size());
    room.occluded(rays, blocked);
    for (std::size_t k = 0; k < rays.size(); ++k)
        if (!blocked[k]) irradiance[lit[k]] += factors[k] * light.intensity;
}

}  // namespace

PointLighting estimatePointLights(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                                  const IrradianceAtlas& atlas, int maxLights) {
    PointLighting lighting;
    lighting.ambient = meanIndirect(scene, rays, room, atlas);
    std::vector<Piece> pieces = emitterPieces(scene, room.sources);
    if (pieces.empty()) return lighting;
    std::vector<Cluster> clusters =
        cluster(pieces, room.frame.radius, static_cast<std::size_t>(std::max(1, maxLights)));
    std::stable_sort(clusters.begin(), clusters.end(),
                     [](const Cluster& a, const Cluster& b) { return a.weight > b.weight; });
    for (const Cluster& c : clusters) lighting.lights.push_back(lightOf(c, pieces, rays.epsilon()));
    return lighting;
}

void shadeByLights(const PointLighting& lighting, const ObjectMesh& mesh, const Pose& pose,
                   const RayScene& rays, std::span<Vec3> irradiance) {
    std::fill(irradiance.begin(), irradiance.end(), lighting.ambient);
    const std::size_t blocks = (irradiance.size() + kVerticesPerBlock - 1) / kVerticesPerBlock;
    parallelFor(blocks, [&](std::size_t block) {
        const std::size_t first = block * kVerticesPerBlock;
        const std::size_t last = std::min(irradiance.size(), first + kVerticesPerBlock);
        for (const PointLight& light : lighting.lights)
            addLight(light, mesh, pose, rays, first, last, irradiance);
    });
}

}  // namespace vlf
