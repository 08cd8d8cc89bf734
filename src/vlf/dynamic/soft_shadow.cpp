#include "vlf/dynamic/soft_shadow.h"

#include "vlf/base/parallel.h"
#include "vlf/base/thread_memory.h"
#include "vlf/dynamic/sight.h"
#include "vlf/dynamic/texel_square.h"
#include "vlf/math/frame.h"
#include "vlf/math/random.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vlf {

namespace {

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

void findObstructions(const RoomTexels& room, std::span<const Sphere> objects,
                      std::vector<Obstruction>& all) {
    all.resize(room.sources.images.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        const LightImage& image = room.sources.images[i];
        const Light& light = room.sources.lights[image.light];
        Obstruction& o = all[i];
        o.objects.clear();
        o.light = {image.imageFromWorld.point(light.centre), light.radius};
        // In the way before the first mirror, between it and the next, and so on.
        for (const Sphere& object : objects)
            for (int segment = 0; segment <= image.depth; ++segment) {
                Sphere seen = object;
                for (int k = segment - 1; k >= 0; --k) {
                    const Vec3& n = room.unwrap.charts[image.mirror[k]].normal;
                    const float offset = room.sources.mirrorOffset[image.mirror[k]];
                    seen.centre -= 2 * (glm::dot(n, seen.centre) - offset) * n;
                }
                o.objects.push_back(seen);
            }
    }
}

bool mayBeShadowed(const Sphere& receiver, const std::vector<Obstruction>& obstructions) {
    return std::any_of(obstructions.begin(), obstructions.end(), [&](const Obstruction& o) {
        return std::any_of(o.objects.begin(), o.objects.end(), [&](const Sphere& object) {
            return mayHide(receiver, o.light, object);
        });
    });
}

/// Whether penumbrae are wider there than the receiver: at distance d from the object one is d
/// times as wide as the light looks.
bool isSmooth(const Sphere& receiver, const std::vector<Obstruction>& obstructions) {
    return std::all_of(obstructions.begin(), obstructions.end(), [&](const Obstruction& o) {
        const float lightDistance = glm::distance(receiver.centre, o.light.centre);
        return std::all_of(o.objects.begin(), o.objects.end(), [&](const Sphere& object) {
            const float distance = glm::distance(receiver.centre, object.centre);
            return !mayHide(receiver, o.light, object) ||
                   distance * 2 * o.light.radius > 2 * receiver.radius * lightDistance;
        });
    });
}

}  // namespace

std::vector<std::uint32_t> texelsInShadow(const Scene& scene, const RoomTexels& room,
                                          std::span<const Sphere> objects) {
    std::vector<Obstruction> obstructions;
    findObstructions(room, objects, obstructions);
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

namespace {

/// Loses light at one texel after the other. One for each thread.
class ShadowedTexel {
  public:
    ShadowedTexel(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                  const RayInstances& casters, std::span<const Sphere> objects,
                  const std::vector<Obstruction>& obstructions, int samples)
        : scene_(scene),
          rays_(rays),
          room_(room),
          casters_(casters),
          objects_(objects),
          obstructions_(obstructions),
          samples_(samples),
          gatherer_(scene, rays, room.unwrap, room.sources, 0),
          tracer_(scene, rays, room) {
        gatherer_.setExtraOccluder(occluderOf(casters));
    }

    Vec3 loss(const LightReceiver& receiver) {
        const ThreadMemory<Memory> lent(memory_);
        sort({receiver.centre, receiver.radius});
        Vec3 sum(0);
        if (anySampled_) {
            gatherer_.setImages(memory_.sampled);
            sum += gatherer_.irradianceBlocked(receiver, samples_);
        }
        if (anyLarge_)
            for (std::uint32_t i = 0; i < objects_.size(); ++i) sum += behind(receiver, i);
        return sum;
    }

  private:
    /// Which images are to be sampled by their points, and which lights look larger than an object.
    void sort(const Sphere& receiver) {
        memory_.sampled.assign(obstructions_.size(), 0);
        memory_.large.assign(room_.sources.lights.size(), 0);
        anySampled_ = anyLarge_ = false;
        for (std::size_t i = 0; i < obstructions_.size(); ++i) {
            const Obstruction& o = obstructions_[i];
            const LightImage& image = room_.sources.images[i];
            float widest = 0;  // sr, of the objects
            bool hidden = false;
            for (const Sphere& object : o.objects)
                if (mayHide(receiver, o.light, object)) {
                    hidden = true;
                    widest = std::max(widest, solidAngle(receiver.centre, object));
                }
            if (!hidden) continue;
            const Light& light = room_.sources.lights[image.light];
            const Vec3 way = o.light.centre - receiver.centre;
            const float seen = light.area / std::max(glm::dot(way, way), 1e-20f);
            if (image.depth == 0 && seen > kLarger * widest)
                memory_.large[image.light] = anyLarge_ = true;
            else
                memory_.sampled[i] = anySampled_ = true;
        }
    }

    /// Of a sphere; of one around the point, all there is.
    static float solidAngle(const Vec3& point, const Sphere& sphere) {
        const Vec3 way = sphere.centre - point;
        const float sine2 = sphere.radius * sphere.radius / std::max(glm::dot(way, way), 1e-20f);
        return sine2 >= 1 ? 4 * kPi : 2 * kPi * (1 - std::sqrt(1 - sine2));
    }

    /// Irradiance of large lights that object i hides.
    Vec3 behind(const LightReceiver& r, std::uint32_t i) {
        const Vec3 way = objects_[i].centre - r.centre;
        const float angle = solidAngle(r.centre, objects_[i]);
        if (angle >= 2 * kPi || glm::dot(r.normal, way) < -objects_[i].radius - r.radius)
            return Vec3(0);
        const Frame frame = frameFromNormal(glm::normalize(way));
        const Vec2 shift(0.5f);  // the same for all: what they miss is the same
        memory_.queue.clear(), memory_.weights.clear();
        for (int k = 0; k < kConeSamples; ++k) {
            const SurfacePoint& p = r.points[static_cast<std::size_t>(k) % r.points.size()];
            const Vec3 geometric = r.side * geometricNormal(*r.scene, p.triangle);
            Vec3 normal = shadingNormalAt(*r.scene, p.triangle, p.barycentric);
            if (glm::dot(normal, geometric) < 0) normal = -normal;
            const Vec2 u = r2Point(static_cast<std::uint32_t>(k), shift);
            const float z = 1 - u.x * angle / (2 * kPi), phi = 2 * kPi * u.y;
            const float s = std::sqrt(std::max(0.0f, 1 - z * z));
            const Vec3 direction = frame.toWorld({s * std::cos(phi), s * std::sin(phi), z});
            const float cosine = glm::dot(normal, direction);
            if (cosine <= 0 || glm::dot(geometric, direction) <= 0) continue;
            const float lobe = 0.5f * (1 + glm::dot(normal, geometric));
            memory_.queue.push_back(
                {positionAt(*r.scene, p.triangle, p.barycentric) + rays_.epsilon() * geometric,
                 direction});
            memory_.weights.push_back(cosine / lobe * angle / kConeSamples);
        }
        return emissionBehind(i);
    }

    /// Along the rays that meet object i first, what large lights would send without it.
    Vec3 emissionBehind(std::uint32_t object) {
        memory_.hits.resize(memory_.queue.size());
        casters_.closest(memory_.queue, memory_.hits);
        std::size_t kept = 0;
        for (std::size_t k = 0; k < memory_.queue.size(); ++k) {
            if (!memory_.hits[k] || memory_.hits[k].instance != object) continue;
            memory_.queue[kept] = memory_.queue[k], memory_.weights[kept] = memory_.weights[k],
            memory_.hits[kept] = memory_.hits[k];
            ++kept;
        }
        memory_.queue.resize(kept);
        if (kept == 0) return Vec3(0);
        tracer_.trace(memory_.queue, memory_.sights);
        Vec3 sum(0);
        for (const Sight& sight : memory_.sights.others) {
            if (sight.inMirror || sight.emission == Vec3(0) || sight.triangle == kNoTriangle)
                continue;
            const std::uint32_t light = room_.triangles[sight.triangle].light;
            if (light != kNoLight && memory_.large[light] &&
                sight.distance > memory_.hits[sight.ray].hit.t)
                sum += memory_.weights[sight.ray] * sight.emission;
        }
        return sum;
    }

    static constexpr float kLarger = 2;
    static constexpr int kConeSamples = 32;

    const Scene& scene_;
    const RayScene& rays_;
    const RoomTexels& room_;
    const RayInstances& casters_;
    std::span<const Sphere> objects_;
    const std::vector<Obstruction>& obstructions_;
    int samples_;
    LightGatherer gatherer_;
    SightTracer tracer_;
    bool anySampled_ = false, anyLarge_ = false;
    struct Memory {
        std::vector<std::uint8_t> sampled, large;  ///< by image, by light
        std::vector<Ray> queue;
        std::vector<float> weights;
        std::vector<InstanceHit> hits;
        Sights sights;
    };
    Memory memory_;  ///< the thread's during loss()
};

}  // namespace

ExtraOccluder occluderOf(const RayInstances& instances) {
    return [&instances](std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
        thread_local std::vector<std::uint8_t> own;
        own.resize(rays.size());
        instances.occluded(rays, own);
        for (std::size_t i = 0; i < own.size(); ++i) blocked[i] |= own[i];
    };
}

const TexelLoss& SoftShadows::find(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                                   const Coverage& coverage, const RayInstances& casters,
                                   std::span<const Sphere> objects, int samples, float slight) {
    findObstructions(room, objects, obstructions_);
    groups_.clear();
    for (std::uint32_t g = 0; g < room.groups.size(); ++g)
        if (mayBeShadowed(room.groups[g].bounds, obstructions_)) groups_.push_back(g);
    if (parts_.size() < groups_.size()) parts_.resize(groups_.size());
    parallelFor(groups_.size(), [&](std::size_t i) {
        ShadowedTexel texel(scene, rays, room, casters, objects, obstructions_, samples);
        const auto find = [&](std::uint32_t entry) {
            LightReceiver receiver = texelReceiver(scene, room.unwrap, entry);
            receiver.points = coverage.points(room, entry);
            return receiver.points.empty() ? Vec3(0) : texel.loss(receiver);
        };
        parts_[i].clear();
        const auto keep = [&](std::uint32_t t, const Vec3& loss) {
            if (loss != Vec3(0)) parts_[i].emplace_back(room.entryOf[t], loss);
        };
        const TexelGroup& group = room.groups[groups_[i]];
        if (isSmooth(group.bounds, obstructions_)) {
            TexelSquare(room, group).light(slight, find, keep);
            return;
        }
        for (std::uint32_t k = group.first; k < group.first + group.count; ++k) {
            const std::uint32_t entry = room.grouped[k];
            const LightReceiver r = texelReceiver(scene, room.unwrap, entry);
            if (mayBeShadowed({r.centre, r.radius}, obstructions_))
                keep(room.unwrap.texels[entry], find(entry));
        }
    });
    loss_.entries.clear(), loss_.loss.clear();
    for (std::size_t i = 0; i < groups_.size(); ++i)
        for (const auto& [entry, loss] : parts_[i]) {
            loss_.entries.push_back(entry);
            loss_.loss.push_back(loss);
        }
    return loss_;
}

}  // namespace vlf
