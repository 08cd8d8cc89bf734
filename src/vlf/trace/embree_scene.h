#pragma once
// What the ray tracing classes share: Embree's devices and the packets of rays.

#include "vlf/trace/embree.h"
#include "vlf/trace/ray_scene.h"

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace vlf {

template <auto release>
struct EmbreeRelease {
    template <typename T>
    void operator()(T* object) const {
        release(object);
    }
};
using EmbreeDevice =
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, EmbreeRelease<rtcReleaseDevice>>;
using EmbreeScene =
    std::unique_ptr<std::remove_pointer_t<RTCScene>, EmbreeRelease<rtcReleaseScene>>;

/// The process's device for an instruction set: scenes that are to be placed together as instances
/// need one in common. Throws Error if it cannot start.
RTCDevice embreeDevice(RayIsa isa);

/// The scene in two parts.
struct RayScene::Panes {
    Scene scene;  ///< triangles of the panes alone
    RayScene panes, others;
    std::vector<std::uint32_t> triangleOf;  ///< of the whole scene, by triangle of `others`

    Transmittance passed(const Ray& ray) const;
};

struct RayScene::Impl {
    EmbreeScene scene;
    float epsilon = 0;
    std::unique_ptr<Panes> panes;  ///< null: there are none
};

namespace embree {

inline constexpr std::size_t kPacket = 8;

inline RTCRay toEmbree(const Ray& ray) {
    RTCRay r{};
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = ray.tMin, r.tfar = ray.tMax;
    r.mask = 0xffffffffu;
    return r;
}

/// Writes up to eight rays into the lanes of a packet and marks the lanes in use.
inline void fillPacket(std::span<const Ray> rays, RTCRay8& packet,
                       std::array<int, kPacket>& valid) {
    for (std::size_t i = 0; i < kPacket; ++i) {
        valid[i] = i < rays.size() ? -1 : 0;
        const Ray& ray = rays[std::min(i, rays.size() - 1)];
        packet.org_x[i] = ray.origin.x, packet.org_y[i] = ray.origin.y;
        packet.org_z[i] = ray.origin.z;
        packet.dir_x[i] = ray.direction.x, packet.dir_y[i] = ray.direction.y;
        packet.dir_z[i] = ray.direction.z;
        packet.tnear[i] = ray.tMin, packet.tfar[i] = ray.tMax;
        packet.time[i] = 0, packet.mask[i] = 0xffffffffu, packet.id[i] = 0, packet.flags[i] = 0;
    }
}

/// The closest hit of one ray; `query` holds what Embree found of it.
inline Hit closest(RTCScene scene, const Ray& ray, RTCRayHit& query) {
    query = {};
    query.ray = toEmbree(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect(scene, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {query.hit.primID, query.ray.tfar, {query.hit.u, query.hit.v}};
}

/// Calls take(i, hit, instance) for the closest hit of every ray i.
template <class Take>
void closest(RTCScene scene, std::span<const Ray> rays, Take take) {
    for (std::size_t begin = 0; begin < rays.size(); begin += kPacket) {
        const std::size_t count = std::min(kPacket, rays.size() - begin);
        alignas(32) RTCRayHit8 packet;
        alignas(32) std::array<int, kPacket> valid;
        fillPacket(rays.subspan(begin, count), packet.ray, valid);
        for (unsigned& id : packet.hit.geomID) id = RTC_INVALID_GEOMETRY_ID;
        for (unsigned& id : packet.hit.instID[0]) id = RTC_INVALID_GEOMETRY_ID;
        intersectCoherent(valid.data(), scene, packet);
        for (std::size_t i = 0; i < count; ++i)
            take(begin + i,
                 packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                     ? Hit{}
                     : Hit{packet.hit.primID[i],
                           packet.ray.tfar[i],
                           {packet.hit.u[i], packet.hit.v[i]}},
                 packet.hit.instID[0][i]);
    }
}

inline bool occluded(RTCScene scene, const Ray& ray) {
    RTCRay query = toEmbree(ray);
    occluded(scene, query);
    return query.tfar < 0;
}

inline void occluded(RTCScene scene, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    for (std::size_t begin = 0; begin < rays.size(); begin += kPacket) {
        const std::size_t count = std::min(kPacket, rays.size() - begin);
        alignas(32) RTCRay8 packet;
        alignas(32) std::array<int, kPacket> valid;
        fillPacket(rays.subspan(begin, count), packet, valid);
        occluded(valid.data(), scene, packet);
        for (std::size_t i = 0; i < count; ++i) blocked[begin + i] = packet.tfar[i] < 0;
    }
}

}  // namespace embree

}  // namespace vlf
