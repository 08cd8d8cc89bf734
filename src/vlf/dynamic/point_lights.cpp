#include "vlf/dynamic/point_lights.h"

#include "vlf/base/parallel.h"
#include "vlf/dynamic/emitter_points.h"
#include "vlf/propagate/light_gatherer.h"
#include "vlf/scene/light_beam.h"

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
constexpr float kFar = 200;  // radii of the room

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

struct PowerfulLight {
    PointLight light;
    float power;  ///< luminous, on the room
};

/// From infinity, along a direction, with irradiance across it.
PowerfulLight distantLight(const Vec3& toLight, const Vec3& irradiance, const FieldFrame& room) {
    const float distance = kFar * room.radius;
    PointLight light;
    light.position = room.centre + distance * toLight;
    light.intensity = irradiance * distance * distance;
    return {light, luminance(irradiance) * kPi * room.radius * room.radius};
}

PowerfulLight lightOf(const PunctualLight& source, const FieldFrame& room, float epsilon) {
    if (source.kind == PunctualKind::directional)
        return distantLight(-source.direction, source.intensity, room);
    PointLight light;
    light.position = source.position;
    light.intensity = source.intensity;
    light.radius = 2 * epsilon;
    if (source.kind == PunctualKind::spot) {
        const float outer = std::cos(source.outerCone);
        light.normal = source.direction;
        light.cone = {outer, 1 / std::max(std::cos(source.innerCone) - outer, 1e-6f)};
    }
    return {light, luminance(powerOf(source))};
}

PowerfulLight lightOf(const SkyLight& sky, const FieldFrame& room) {
    Vec3 mean(0);
    for (const Vec3& share : sky.shares) mean += share;
    mean /= static_cast<float>(SkyLight::kShares);
    return distantLight(sky.axis, glm::length(mean) * sky.sky.brightFlux(), room);
}

Piece pieceOf(const PunctualLight& light) {
    const Vec3 power = powerOf(light);
    return {light.position, light.kind == PunctualKind::spot ? light.direction : Vec3(0), power,
            luminance(power), 0};
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
        const float lightFactor = light.factor(-way / distance);
        if (!(cosine > 0 && lightFactor > 0) || distance <= light.radius) continue;
        rays.push_back({origin, way, 0, 1 - light.radius / distance});
        factors.push_back(cosine * lightFactor / (distance * distance + light.area / kPi));
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
    const auto most = static_cast<std::size_t>(std::max(1, maxLights));
    std::vector<PowerfulLight> lights;
    std::vector<Piece> pieces = emitterPieces(scene, room.sources);
    const bool themselves = scene.lights.size() < most;
    for (const PunctualLight& light : scene.lights)
        if (themselves || light.kind == PunctualKind::directional)
            lights.push_back(lightOf(light, room.frame, rays.epsilon()));
        else
            pieces.push_back(pieceOf(light));
    if (room.sources.sky && room.sources.sky->sky.hasBright())
        lights.push_back(lightOf(*room.sources.sky, room.frame));
    const std::size_t left = most > lights.size() ? most - lights.size() : 1;
    if (!pieces.empty())
        for (const Cluster& c : cluster(pieces, room.frame.radius, left))
            lights.push_back({lightOf(c, pieces, rays.epsilon()), c.weight});
    std::stable_sort(
        lights.begin(), lights.end(),
        [](const PowerfulLight& a, const PowerfulLight& b) { return a.power > b.power; });
    for (const PowerfulLight& l : lights) lighting.lights.push_back(l.light);
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
