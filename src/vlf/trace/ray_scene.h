#pragma once
// Ray tracing kernels (Embree) over a Scene's triangles.

#include "vlf/math/vector.h"
#include "vlf/scene/scene.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

namespace vlf {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

/// A ray; `direction` need not be unit, distances are in units of its length.
struct Ray {
    Vec3 origin;
    Vec3 direction;
    float tMin = 0;
    float tMax = std::numeric_limits<float>::infinity();
};

/// Closest intersection. `barycentric` are the weights of the second and third vertex.
struct Hit {
    std::uint32_t triangle = kNoTriangle;
    float t = std::numeric_limits<float>::infinity();
    Vec2 barycentric{0};

    explicit operator bool() const { return triangle != kNoTriangle; }
};

/// Instruction set of the kernels: part of what makes a result reproducible.
enum class RayIsa { automatic, sse42, avx2, avx512 };

/// Distance by which a ray's origin is to be moved off a surface it starts on, in metres: grows
/// with the scene and with its distance from the world's origin.
float rayEpsilon(const Scene& scene);

/// What is left of light along a ray that passes panes straight.
struct Transmittance {
    Vec3 colour{1};    ///< 0 if anything else is in the way
    float chance = 1;  ///< that a ray which goes on by chance passes all of them
};

/// Acceleration structure over all triangles of a scene. Immutable and safe to use from several
/// threads. Keeps its own copy of the geometry.
class RayScene {
  public:
    explicit RayScene(const Scene& scene, RayIsa isa = RayIsa::automatic);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    Hit closest(const Ray& ray) const;

    /// True if anything lies in (tMin, tMax).
    bool occluded(const Ray& ray) const;

    /// Many rays at once (packets of 8); coherent rays gain the most. hits.size() == rays.size().
    void closest(std::span<const Ray> rays, std::span<Hit> hits) const;

    /// Many shadow rays at once: blocked[i] is 1 if ray i is occluded, else 0.
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

    /// Whether any triangle is a pane of glass.
    bool hasPanes() const;

    /// What passes in (tMin, tMax) through the panes of the scene, and past the rest of it.
    Transmittance transmittance(const Ray& ray) const;

    /// Colours of many rays.
    void transmittance(std::span<const Ray> rays, std::span<Vec3> colours) const;

    /// The closest intersection with anything but panes, and what passes those before it.
    Hit closestBehindPanes(const Ray& ray, Transmittance& transmittance) const;

    /// rayEpsilon of the scene.
    float epsilon() const;

  private:
    friend class RayInstances;
    struct Panes;
    static Panes splitPanes(const Scene& scene, RayIsa isa);
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vlf
