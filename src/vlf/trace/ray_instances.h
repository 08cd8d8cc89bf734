#pragma once
// Ray tracing over copies of scenes that move: a hierarchy of the copies' boxes over the scenes'
// own hierarchies, which stay as they are.

#include "vlf/math/pose.h"
#include "vlf/trace/ray_scene.h"

#include <cstdint>
#include <memory>
#include <span>

namespace vlf {

/// A scene somewhere in the world. `scene` must outlive what refers to it.
struct RayInstance {
    const RayScene* scene = nullptr;
    Pose pose;
};

/// A hit of an instance; the triangle is the instance's scene's.
struct InstanceHit {
    std::uint32_t instance = 0;
    Hit hit;

    explicit operator bool() const { return static_cast<bool>(hit); }
};

/// Queries as those of RayScene. Safe to use from several threads between calls of place().
class RayInstances {
  public:
    RayInstances();
    ~RayInstances();
    RayInstances(RayInstances&&) noexcept;
    RayInstances& operator=(RayInstances&&) noexcept;

    /// These and no others, numbered in their order. Cheap where only poses differ from the call
    /// before.
    void place(std::span<const RayInstance> instances);

    bool empty() const;

    InstanceHit closest(const Ray& ray) const;
    bool occluded(const Ray& ray) const;
    void closest(std::span<const Ray> rays, std::span<InstanceHit> hits) const;
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

    /// The closest hits of all instances but number `excluded`, which rays pass through.
    void closestBut(std::uint32_t excluded, std::span<const Ray> rays,
                    std::span<InstanceHit> hits) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vlf
