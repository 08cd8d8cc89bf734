#include "vlf/trace/ray_scene.h"

#include "vlf/base/error.h"
#include "vlf/trace/embree.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace vlf {

namespace {

constexpr std::size_t kPacket = 8;

const char* deviceConfig(RayIsa isa) {
    switch (isa) {
        case RayIsa::sse42: return "isa=sse4.2";
        case RayIsa::avx2: return "isa=avx2";
        case RayIsa::avx512: return "isa=avx512";
        default: return nullptr;
    }
}

RTCRay toEmbree(const Ray& ray) {
    RTCRay r{};
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = ray.tMin, r.tfar = ray.tMax;
    r.mask = 0xffffffffu;
    return r;
}

/// Writes up to eight rays into the lanes of a packet and marks the lanes in use.
void fillPacket(std::span<const Ray> rays, RTCRay8& packet, std::array<int, kPacket>& valid) {
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

}  // namespace

float rayEpsilon(const Scene& scene) {
    float largest = 0;
    for (const Vec3& p : scene.positions) largest = std::max(largest, maxComponent(glm::abs(p)));
    return 4e-6f * std::max(largest, boundingSphere(scene).radius);
}

struct RayScene::Impl {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    float epsilon = 0;

    ~Impl() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
};

RayScene::RayScene(const Scene& scene, RayIsa isa) : impl_(std::make_unique<Impl>()) {
    impl_->device = rtcNewDevice(deviceConfig(isa));
    if (!impl_->device) throw Error("the ray tracing kernels cannot start on this machine");
    RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<Vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Vec3), std::max<std::size_t>(scene.positions.size(), 1)));
    std::copy(scene.positions.begin(), scene.positions.end(), vertices);
    auto* indices = static_cast<std::array<std::uint32_t, 3>*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
        std::max<std::size_t>(scene.triangles.size(), 1)));
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) indices[i] = scene.triangles[i].vertex;
    rtcCommitGeometry(geometry);
    impl_->scene = rtcNewScene(impl_->device);
    rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(impl_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(impl_->scene);
    if (rtcGetDeviceError(impl_->device) != RTC_ERROR_NONE)
        throw Error("the ray tracing kernels could not build the scene: out of memory?");
    impl_->epsilon = rayEpsilon(scene);
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

float RayScene::epsilon() const { return impl_->epsilon; }

Hit RayScene::closest(const Ray& ray) const {
    RTCRayHit query{};
    query.ray = toEmbree(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embree::intersect(impl_->scene, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {query.hit.primID, query.ray.tfar, {query.hit.u, query.hit.v}};
}

bool RayScene::occluded(const Ray& ray) const {
    RTCRay query = toEmbree(ray);
    embree::occluded(impl_->scene, query);
    return query.tfar < 0;
}

void RayScene::closest(std::span<const Ray> rays, std::span<Hit> hits) const {
    for (std::size_t begin = 0; begin < rays.size(); begin += kPacket) {
        const std::size_t count = std::min(kPacket, rays.size() - begin);
        alignas(32) RTCRayHit8 packet;
        alignas(32) std::array<int, kPacket> valid;
        fillPacket(rays.subspan(begin, count), packet.ray, valid);
        for (unsigned& id : packet.hit.geomID) id = RTC_INVALID_GEOMETRY_ID;
        for (unsigned& id : packet.hit.instID[0]) id = RTC_INVALID_GEOMETRY_ID;
        embree::intersectCoherent(valid.data(), impl_->scene, packet);
        for (std::size_t i = 0; i < count; ++i)
            hits[begin + i] = packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                                  ? Hit{}
                                  : Hit{packet.hit.primID[i],
                                        packet.ray.tfar[i],
                                        {packet.hit.u[i], packet.hit.v[i]}};
    }
}

void RayScene::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
    for (std::size_t begin = 0; begin < rays.size(); begin += kPacket) {
        const std::size_t count = std::min(kPacket, rays.size() - begin);
        alignas(32) RTCRay8 packet;
        alignas(32) std::array<int, kPacket> valid;
        fillPacket(rays.subspan(begin, count), packet, valid);
        embree::occluded(valid.data(), impl_->scene, packet);
        for (std::size_t i = 0; i < count; ++i) blocked[begin + i] = packet.tfar[i] < 0;
    }
}

}  // namespace vlf
