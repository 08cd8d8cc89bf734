#pragma once
// What rays see of a room and of the objects in it, mirrors followed to what is seen in them.

#include "vlf/dynamic/lit_object.h"
#include "vlf/dynamic/room_texels.h"
#include "vlf/trace/ray_instances.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

inline constexpr std::uint32_t kNoObject = 0xffffffffu;

/// A surface that reflects diffusely, at the end of a ray or on its way, where more is to be said
/// of it than which texel of the room it is; or the environment, which only emits.
struct Sight {
    std::uint32_t ray = 0;
    std::uint32_t texel = kNoTexel;    ///< covered texel of the room; kNoTexel: an object or black
    bool covered = true;               ///< it is there, not beside it
    std::uint32_t object = kNoObject;  ///< of the lit objects
    std::uint32_t triangle = kNoTriangle;
    Vec2 barycentric{0};
    bool front = true;
    bool inMirror = false;
    float distance = 0;         ///< along the way, over mirrors, in lengths of the ray's direction
    Vec3 throughput{1};         ///< of the mirrors on the way
    Vec3 emission{0};           ///< radiance emitted there, W·m⁻²·sr⁻¹
    bool emissionApart = true;  ///< the room's direct light has it already
};

/// The objects that rays may meet, in the order of `rays`' instances.
struct SightObjects {
    const RayInstances* rays = nullptr;
    std::span<const LitObject> lit;
    std::uint32_t own = kNoObject;  ///< rays start on this one and meet it only in mirrors
};

/// What rays have met. A ray has one surface, none if it meets nothing or the inside of a solid, or
/// several where mirrors on its way reflect diffusely, too. A ray without an end that meets nothing
/// sees the environment: its smooth part, and its bright part as another sight.
struct Sights {
    std::vector<std::uint32_t> texel;  ///< by ray: met at once, covered, no emitter; or kNoTexel
    std::vector<float> distance;       ///< by ray, of these
    std::vector<Sight> others;         ///< all else, those in mirrors last
    std::vector<std::uint8_t> within;  ///< by ray: 1 if the first surface it meets shows its inner
                                       ///< side or lies within another, so that the ray starts
                                       ///< within a solid or outside the room
};

/// Traces rays. Refers to what it is given.
class SightTracer {
  public:
    SightTracer(const Scene& scene, const RayScene& rays, const RoomTexels& room)
        : scene_(scene), rays_(rays), room_(room) {}

    /// Of the room alone unless there are objects to be met.
    void setObjects(const SightObjects& objects) { objects_ = objects; }

    /// What the rays see.
    void trace(std::span<const Ray> rays, Sights& sights);

  private:
    struct Path {
        std::uint32_t ray;
        int reflections;
        bool planarOnly;
        float distance;
        Vec3 throughput;
        int glass = 0;  // surfaces passed
    };
    /// Where a path meets a mirror.
    struct MirrorPoint {
        Vec3 position, normal, side, reflectance;
        float roughness, epsilon;
        bool planar;
    };

    void findHits(std::span<const Ray> rays, bool first);
    void meet(const Path& path, const Ray& ray, std::size_t i);
    void meetRoom(const Path& path, const Ray& ray, const Hit& hit);
    void passGlass(Path path, const Ray& ray, const Hit& hit, bool front);
    void meetObject(const Path& path, const Ray& ray, const InstanceHit& hit);
    void leave(const Path& path, const Ray& ray);
    void reflect(Path path, const Ray& ray, float t, const MirrorPoint& mirror);
    std::uint32_t atlasTexel(std::uint32_t chart, const Vec3& position) const;

    const Scene& scene_;
    const RayScene& rays_;
    const RoomTexels& room_;
    SightObjects objects_;
    Sights* sights_ = nullptr;
    struct Memory {
        std::vector<Hit> hits;
        std::vector<InstanceHit> objectHits;
        std::vector<Ray> queue, nextQueue;
        std::vector<Path> paths, nextPaths;
    };
    Memory memory_;  ///< the thread's during trace()
};

/// Diffuse radiance that leaves what is seen: `texelRadiance` is by atlas texel of the room.
Vec3 diffuseRadiance(const Sight& sight, std::span<const Vec3> texelRadiance,
                     std::span<const LitObject> lit);

}  // namespace vlf
