#pragma once
// Light transport by random walks: the unbiased truth the baked field is measured against.
// J. Kajiya, "The rendering equation", SIGGRAPH 1986.

#include "vlf/math/random.h"
#include "vlf/render/cpu/lamp_light.h"
#include "vlf/render/cpu/scattering.h"
#include "vlf/render/cpu/surface.h"

#include <functional>
#include <optional>

namespace vlf {

struct PathOptions {
    int maxDepth = 0;            ///< segments of the longest path, the one that ends on the emitter
                                 ///< included; 0: unlimited. 1: emitters seen directly
    bool sampleEmitters = true;  ///< false: find emitters and bright parts of the environment by
                                 ///< chance alone (slow; the same result)
};

/// Whether light can reach a side of a triangle; false for the inside of a solid.
using SideIsOpen = std::function<bool(std::uint32_t triangle, bool front)>;

/// Estimators of radiance and irradiance. Of punctual lights no path over perfect mirrors alone can
/// tell: that light (caustics) is missing, as is their image in mirrors. Refers to the scene and
/// its rays, which must outlive it; safe to use from several threads, each with its own random
/// stream.
class PathIntegrator {
  public:
    PathIntegrator(const Scene& scene, const RayScene& rays, const PathOptions& options = {});

    /// One unbiased sample of the radiance that arrives along a ray (of unit direction) from where
    /// it points, W·m⁻²·sr⁻¹.
    Vec3 radiance(const Ray& ray, RandomStream& random) const;

    /// One unbiased sample of the irradiance at a surface point, W·m⁻². Nothing if the direction
    /// drawn for the sample meets a side of which `isOpen` is false: the point lies within a solid.
    std::optional<Vec3> irradiance(const SidePoint& point, const SideIsOpen& isOpen,
                                   RandomStream& random) const;

  private:
    struct Path;

    Vec3 followPath(Path path, RandomStream& random) const;
    float rivalDensity(const Path& path) const;
    Vec3 emitterSeen(const Path& path, const SidePoint& point) const;
    Vec3 skySeen(const Path& path) const;
    Vec3 directLight(const Surface& surface, const Scattering& scattering,
                     RandomStream& random) const;
    bool scatter(const Surface& surface, const Scattering& scattering, Path& path,
                 RandomStream& random) const;
    Ray rayFrom(const Surface& surface, const Vec3& direction) const;
    bool passGlass(const SidePoint& point, Path& path, RandomStream& random) const;

    const Scene& scene_;
    const RayScene& rays_;
    PathOptions options_;
    LampLight lamps_;
};

}  // namespace vlf
