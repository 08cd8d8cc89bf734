#include "vlf/dynamic/soft_shadow.h"

#include "vlf/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

constexpr std::size_t kTexelsPerBlock = 8;

/// Whether a line from within `receiver` to within `light` may meet `object`: the cones that the
/// two spheres fill overlap.
bool mayHide(const Sphere& receiver, const Sphere& light, const Sphere& object) {
    const Vec3 toLight = light.centre - receiver.centre;
    const Vec3 toObject = object.centre - receiver.centre;
    const float lightDistance = glm::length(toLight), objectDistance = glm::length(toObject);
    const float objectReach = object.radius + receiver.radius;
    const float lightReach = light.radius + receiver.radius;
    if (objectDistance - objectReach > lightDistance + lightReach) return false;
    if (objectDistance <= objectReach || lightDistance <= lightReach) return true;
    const float cosine = glm::dot(toLight, toObject) / (lightDistance * objectDistance);
    const float angle = std::acos(std::clamp(cosine, -1.0f, 1.0f));
    return angle <= std::asin(lightReach / lightDistance) + std::asin(objectReach / objectDistance);
}

/// A light or an image of it, and the objects as they stand in its way: those before mirrors, and
/// the images of those behind.
struct Obstruction {
    Sphere light;
    std::vector<Sphere> objects;
};

std::vector<Obstruction> findObstructions(const RoomTexels& room, std::span<const Sphere> objects) {
    std::vector<Obstruction> all;
    for (const LightImage& image : room.sources.images) {
        const Light& light = room.sources.lights[image.light];
        Obstruction o;
        o.light = {image.imageFromWorld.point(light.centre), light.radius};
        for (const Sphere& object : objects) {
            o.objects.push_back(object);
            Sphere reflected = object;
            for (int k = image.depth - 1; k >= 0; --k) {
                const Vec3& n = room.unwrap.charts[image.mirror[k]].normal;
                const float offset = room.sources.mirrorOffset[image.mirror[k]];
                reflected.centre -= 2 * (glm::dot(n, reflected.centre) - offset) * n;
                o.objects.push_back(reflected);
            }
            if (image.depth > 1) {
                const Vec3& n = room.unwrap.charts[image.mirror[0]].normal;
                const float offset = room.sources.mirrorOffset[image.mirror[0]];
                Sphere once = object;
                once.centre -= 2 * (glm::dot(n, once.centre) - offset) * n;
                o.objects.push_back(once);
            }
        }
        all.push_back(std::move(o));
    }
    return all;
}

bool mayBeShadowed(const Sphere& receiver, const std::vector<Obstruction>& obstructions) {
    return std::any_of(obstructions.begin(), obstructions.end(), [&](const Obstruction& o) {
        return std::any_of(o.objects.begin(), o.objects.end(), [&](const Sphere& object) {
            return mayHide(receiver, o.light, object);
        });
    });
}

}  // namespace

std::vector<std::uint32_t> texelsInShadow(const Scene& scene, const RoomTexels& room,
                                          std::span<const Sphere> objects) {
    const std::vector<Obstruction> obstructions = findObstructions(room, objects);
    std::vector<std::uint32_t> found;
    for (const TexelGroup& group : room.groups) {
        if (!mayBeShadowed(group.bounds, obstructions)) continue;
        for (std::uint32_t i = group.first; i < group.first + group.count; ++i) {
            const std::uint32_t entry = room.grouped[i];
            const LightReceiver r = texelReceiver(scene, room.unwrap, entry);
            if (mayBeShadowed({r.centre, r.radius}, obstructions)) found.push_back(entry);
        }
    }
    return found;
}

TexelLoss findSoftShadows(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                          const Coverage& coverage, std::span<const Sphere> objects,
                          const ExtraOccluder& occluder, int samples) {
    TexelLoss result;
    result.entries = texelsInShadow(scene, room, objects);
    result.loss.resize(result.entries.size());
    const std::size_t blocks = (result.entries.size() + kTexelsPerBlock - 1) / kTexelsPerBlock;
    parallelFor(blocks, 1, [&](std::size_t block) {
        LightGatherer gatherer(scene, rays, room.unwrap, room.sources, 0);
        gatherer.setExtraOccluder(occluder);
        const std::size_t end = std::min(result.entries.size(), (block + 1) * kTexelsPerBlock);
        for (std::size_t i = block * kTexelsPerBlock; i < end; ++i) {
            LightReceiver receiver = texelReceiver(scene, room.unwrap, result.entries[i]);
            receiver.points = coverage.points(room, result.entries[i]);
            if (!receiver.points.empty())
                result.loss[i] = gatherer.irradianceBlocked(receiver, samples);
        }
    });
    return result;
}

}  // namespace vlf
