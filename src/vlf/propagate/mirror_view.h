#pragma once
// What the cells of a chart of a mirror or glass show: reflected rays, and those that solid glass
// transmits, followed to diffuse surfaces. Of a rough
// mirror they are many a cell, and emitters are sought by points on them, too (E. Veach and
// L. Guibas, "Optimally combining sampling techniques for Monte Carlo rendering", 1995).

#include "vlf/field/light_field.h"
#include "vlf/math/random.h"
#include "vlf/propagate/mirror_cells.h"
#include "vlf/propagate/shared_views.h"
#include "vlf/scene/emitter_sampler.h"
#include "vlf/scene/light_beam.h"
#include "vlf/scene/scene.h"
#include "vlf/scene/sky.h"
#include "vlf/trace/ray_scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

struct MirrorView {
    Vec3 radiance{0};    ///< leaving the mirror, W·m⁻²·sr⁻¹; of a pane, what it reflects alone
    float distance = 0;  ///< from the mirror to the image of what is seen, metres (of a rough one
                         ///< the harmonic mean, of solid glass that of what is seen through it or,
                         ///< where it is curved, next to none); 0: nothing, the cell lies within a
                         ///< solid or outside the room
};

/// How many samples of what a rough mirror reflects make the light of a cell.
struct GlossSamples {
    int reflections = 32;  ///< rays by its lobe
    int emitters = 8;      ///< points on emitters, directions of the bright part of the sky, and
                           ///< punctual lights where there are more than eight
};

/// Distance behind a mirror of the image of a point at distance d > 0 before it: the mean of the
/// tangential and the sagittal focus, 1/d' = 1/d + κ (1/cosθ + cosθ), for curvature κ (1/m,
/// positive where the mirror is convex) and angle of incidence θ. `longest` where the image lies
/// beyond that or is real (a concave mirror).
float imageDistance(float d, float curvature, float cosine, float longest);

/// Follows rays from mirror charts. Light seen is emission (of the emitting side), ρE/π of the
/// field's atlas, and the environment where rays leave the scene. A guard cell outside the room or
/// within a solid, as under the mirror's frame, shows what the chart's point next to it does.
class MirrorViewTracer {
  public:
    /// Distances are limited to `longest`, which is also that of rays that leave the scene; a
    /// quarter of it where they see an environment. `cellSize`: of cells, metres.
    MirrorViewTracer(const Scene& scene, const RayScene& rays, const LightField& field,
                     const EmitterSampler& emitters, const Sky& sky, const GlossSamples& samples,
                     float longest, float cellSize)
        : scene_(scene),
          rays_(rays),
          field_(field),
          emitters_(emitters),
          sky_(sky),
          samples_(samples),
          longest_(longest),
          cellSize_(cellSize) {}

    /// What each of the cells (of one chart) shows in unit direction `toEye`. In a planar mirror
    /// seen in the mirror the distance goes on, along the path. Valid until the next call.
    const std::vector<MirrorView>& trace(std::span<const MirrorCell> cells, const Vec3& toEye,
                                         bool planar, RandomStream& random);

  private:
    struct Path {
        std::uint32_t cell;
        Vec3 throughput;
        float length;        ///< metres so far
        bool unfolding;      ///< whether what comes next decides the distance
        bool first;          ///< from the cell itself
        bool scattered;      ///< by a rough mirror
        float raysPerPoint;  ///< density of a rough mirror's rays, times how many there are for a
                             ///< point of emitters that is sought from it, sr⁻¹; 0: none is sought
        float straight = 0;  ///< metres since then, by way of panes
    };
    struct Arrival;
    struct RoughPoint;
    struct PointLight {
        std::uint32_t cell;
        Vec3 radiance;
    };
    /// How far what is seen by the rays of a rough mirror's cell lies.
    struct Distances {
        float inverseSum = 0;
        int count = 0;
    };

    void start(bool planar);
    void startGlass(bool planar);
    void passGlass(const Path& path, const Vec3& direction, const Arrival& at);
    void startRough(float roughness, RandomStream& random);
    void scatter(Path path, const RoughPoint& at, const GlossSamples& samples,
                 RandomStream& random);
    void addPoint(const Path& path, const RoughPoint& at, const GlossSamples& samples,
                  const SidePoint& point);
    void addSky(const Path& path, const RoughPoint& at, const GlossSamples& samples,
                const Sky::Sample& sample);
    void addPunctual(const Path& path, const RoughPoint& at, int picks, RandomStream& random);
    void addBeam(const Path& path, const RoughPoint& at, const LightBeam& beam, float weight);
    void leave(const Path& path, const Ray& ray);
    float pointDensity(std::uint32_t triangle, float distance, float cosine) const;
    float emitterWeight(const Path& path, const Ray& ray, const Hit& hit) const;
    void addVisiblePoints();
    Vec3 pointWithin(const MirrorCell& cell) const;
    std::uint32_t chartHit(const Ray& ray, const Hit& hit) const;
    void restart(Path path, const Ray& ray);
    bool isHidden(const Vec3& p) const;
    void advance(RandomStream& random);
    void arrive(const Path& path, const Ray& ray, const Hit& hit, RandomStream& random);
    void noteDistance(const Path& path, float distance);
    Vec3 diffuseRadiance(const Arrival& at) const;
    void reflect(Path path, const Vec3& direction, const Arrival& at, RandomStream& random);
    void share();
    void formImages();

    const Scene& scene_;
    const RayScene& rays_;
    const LightField& field_;
    const EmitterSampler& emitters_;
    const Sky& sky_;
    GlossSamples samples_;
    float longest_, cellSize_;
    std::span<const MirrorCell> cells_;
    Vec3 toEye_{0};
    std::vector<MirrorView> views_;
    std::vector<Distances> distances_;    ///< by cell; empty: of a perfect mirror
    std::vector<ViewPoint> viewPoints_;   ///< the cells' of a rough mirror
    std::vector<std::uint32_t> shownBy_;  ///< by cell: the cell that is traced for it
    std::vector<Path> paths_, nextPaths_;
    std::vector<Ray> rayQueue_, nextRays_;
    std::vector<Hit> hits_;
    std::vector<PointLight> pointLights_;  ///< of points on emitters, by shadowRays_
    std::vector<Ray> shadowRays_;
    std::vector<Vec3> passed_;
};

}  // namespace vlf
