#pragma once
// What rays see of the room without its objects, mirrors followed to the diffuse surface behind.

#include "vlf/dynamic/room_texels.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// The end of a ray. A mirror with a diffuse part ends it too, at the mirror, with the mirror's
/// throughput lost to whoever follows no further: see RoomSights.
struct Sight {
    std::uint32_t texel = kNoTexel;  ///< covered texel of the atlas; kNoTexel: black
    std::uint32_t triangle = kNoTriangle;
    float distance = 0;  ///< along the way, over mirrors, metres; 0: nothing met
    int mirrors = 0;     ///< on the way
    Vec3 throughput{1};  ///< of these mirrors
    Vec3 emission{0};    ///< radiance emitted there, W·m⁻²·sr⁻¹
};

/// Traces them. Refers to what it is given.
class RoomSights {
  public:
    RoomSights(const Scene& scene, const RayScene& rays, const RoomTexels& room)
        : scene_(scene), rays_(rays), room_(room) {}

    /// Calls take(ray's number, sight) for every diffuse surface met: one per ray, and one more for
    /// each mirror with a diffuse part on the way. Rays that meet nothing are not told of. Those
    /// over mirrors are told of after all others. `Scratch` is memory of the caller's thread.
    struct Scratch {
        std::vector<Ray> rays, nextRays;
        std::vector<Hit> hits;
        struct Path {
            std::uint32_t ray;
            float distance;
            Vec3 throughput;
        };
        std::vector<Path> paths, nextPaths;
    };
    template <class Take>
    void trace(std::span<const Ray> rays, Scratch& scratch, Take take) const {
        scratch.hits.resize(rays.size());
        rays_.closest(rays, scratch.hits);
        scratch.nextRays.clear(), scratch.nextPaths.clear();
        for (std::uint32_t i = 0; i < rays.size(); ++i)
            if (scratch.hits[i]) end({i, 0, Vec3(1)}, rays[i], scratch.hits[i], scratch, take, 0);
        for (int reflections = 1; !scratch.nextRays.empty(); ++reflections) {
            std::swap(scratch.rays, scratch.nextRays);
            std::swap(scratch.paths, scratch.nextPaths);
            scratch.nextRays.clear(), scratch.nextPaths.clear();
            scratch.hits.resize(scratch.rays.size());
            rays_.closest(scratch.rays, scratch.hits);
            for (std::size_t i = 0; i < scratch.rays.size(); ++i)
                if (scratch.hits[i])
                    end(scratch.paths[i], scratch.rays[i], scratch.hits[i], scratch, take,
                        reflections);
        }
    }

  private:
    static constexpr int kMaxReflections = 16;  // as in the bake

    template <class Take>
    void end(const Scratch::Path& path, const Ray& ray, const Hit& hit, Scratch& scratch, Take take,
             int reflections) const {
        const bool front = glm::dot(areaVector(scene_, hit.triangle), ray.direction) < 0;
        const TriangleCharts& charts = room_.unwrap.triangleCharts[hit.triangle];
        const std::uint32_t chart = front ? charts.front : charts.back;
        if (chart == kNoChart) return;
        const Material& material = scene_.material(hit.triangle);
        const Vec3 position = ray.origin + hit.t * ray.direction;
        if (!material.isPureMirror() || material.isEmitter())
            take(path.ray, Sight{texelAt(chart, position), hit.triangle, path.distance + hit.t,
                                 reflections, path.throughput, emissionAt(material, hit, front)});
        if (reflections < kMaxReflections && material.isMirror())
            reflect(path, ray, hit, chart, front, position, scratch);
    }

    std::uint32_t texelAt(std::uint32_t chart, const Vec3& position) const;
    Vec3 emissionAt(const Material& material, const Hit& hit, bool front) const;
    void reflect(Scratch::Path path, const Ray& ray, const Hit& hit, std::uint32_t chart,
                 bool front, const Vec3& position, Scratch& scratch) const;

    const Scene& scene_;
    const RayScene& rays_;
    const RoomTexels& room_;
};

}  // namespace vlf
