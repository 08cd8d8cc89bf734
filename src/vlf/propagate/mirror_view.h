#pragma once
// What the cells of a mirror chart show: reflected rays followed to diffuse surfaces.

#include "vlf/field/light_field.h"
#include "vlf/propagate/mirror_cells.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

struct MirrorView {
    Vec3 radiance{0};    ///< leaving the mirror, W·m⁻²·sr⁻¹
    float distance = 0;  ///< from the mirror to the image of what is seen, metres; 0: nothing, the
                         ///< cell lies within a solid or outside the room
};

/// Distance behind a mirror of the image of a point at distance d > 0 before it: the mean of the
/// tangential and the sagittal focus, 1/d' = 1/d + κ (1/cosθ + cosθ), for curvature κ (1/m,
/// positive where the mirror is convex) and angle of incidence θ. `longest` where the image lies
/// beyond that or is real (a concave mirror).
float imageDistance(float d, float curvature, float cosine, float longest);

/// Follows rays from mirror charts. Light seen is emission (of the emitting side) and ρE/π of the
/// field's atlas. A guard cell outside the room or within a solid, as under the mirror's frame,
/// shows what the chart's point next to it does.
class MirrorViewTracer {
  public:
    /// Distances are limited to `longest`, which is also that of rays that leave the scene.
    MirrorViewTracer(const Scene& scene, const RayScene& rays, const LightField& field,
                     float longest)
        : scene_(scene), rays_(rays), field_(field), longest_(longest) {}

    /// What each of the cells (of one chart) shows in unit direction `toEye`. In a planar mirror
    /// seen in the mirror the distance goes on, along the path. Valid until the next call.
    const std::vector<MirrorView>& trace(std::span<const MirrorCell> cells, const Vec3& toEye,
                                         bool planar);

  private:
    struct Path {
        std::uint32_t cell;
        Vec3 throughput;
        float length;    ///< metres so far
        bool unfolding;  ///< whether what comes next decides the distance
        bool first;      ///< from the cell itself
    };
    struct Arrival;

    void start(bool planar);
    std::uint32_t chartHit(const Ray& ray, const Hit& hit) const;
    void restart(Path path, const Ray& ray);
    bool isHidden(const Vec3& p) const;
    void advance();
    void arrive(const Path& path, const Ray& ray, const Hit& hit);
    Vec3 radianceSeen(const Arrival& at) const;
    void reflect(Path path, const Vec3& direction, const Arrival& at);
    void formImages();

    const Scene& scene_;
    const RayScene& rays_;
    const LightField& field_;
    float longest_;
    std::span<const MirrorCell> cells_;
    Vec3 toEye_{0};
    std::vector<MirrorView> views_;
    std::vector<Path> paths_, nextPaths_;
    std::vector<Ray> rayQueue_, nextRays_;
    std::vector<Hit> hits_;
};

}  // namespace vlf
