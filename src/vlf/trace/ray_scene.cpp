#include "vlf/trace/ray_scene.h"

#include "vlf/base/error.h"
#include "vlf/trace/embree_scene.h"

#include <algorithm>
#include <array>

namespace vlf {

namespace {

EmbreeDevice newDevice(const char* config) {
    EmbreeDevice device(rtcNewDevice(config));
    if (!device) throw Error("the ray tracing kernels cannot start on this machine");
    return device;
}

}  // namespace

RTCDevice embreeDevice(RayIsa isa) {
    switch (isa) {
        case RayIsa::sse42: {
            static const EmbreeDevice device = newDevice("isa=sse4.2");
            return device.get();
        }
        case RayIsa::avx2: {
            static const EmbreeDevice device = newDevice("isa=avx2");
            return device.get();
        }
        case RayIsa::avx512: {
            static const EmbreeDevice device = newDevice("isa=avx512");
            return device.get();
        }
        default: {
            static const EmbreeDevice device = newDevice(nullptr);
            return device.get();
        }
    }
}

float rayEpsilon(const Scene& scene) {
    float largest = 0;
    for (const Vec3& p : scene.positions) largest = std::max(largest, maxComponent(glm::abs(p)));
    return 4e-6f * std::max(largest, boundingSphere(scene).radius);
}

RayScene::RayScene(const Scene& scene, RayIsa isa) : impl_(std::make_unique<Impl>()) {
    const RTCDevice device = embreeDevice(isa);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<Vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Vec3), std::max<std::size_t>(scene.positions.size(), 1)));
    std::copy(scene.positions.begin(), scene.positions.end(), vertices);
    auto* indices = static_cast<std::array<std::uint32_t, 3>*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
        std::max<std::size_t>(scene.triangles.size(), 1)));
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) indices[i] = scene.triangles[i].vertex;
    rtcCommitGeometry(geometry);
    impl_->scene.reset(rtcNewScene(device));
    rtcSetSceneFlags(impl_->scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(impl_->scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(impl_->scene.get());
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
        throw Error("the ray tracing kernels could not build the scene: out of memory?");
    impl_->epsilon = rayEpsilon(scene);
    if (hasPane(scene)) impl_->panes = std::make_unique<Panes>(splitPanes(scene, isa));
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

float RayScene::epsilon() const {
    return impl_->epsilon;
}

Hit RayScene::closest(const Ray& ray) const {
    RTCRayHit query;
    return embree::closest(impl_->scene.get(), ray, query);
}

bool RayScene::occluded(const Ray& ray) const {
    return embree::occluded(impl_->scene.get(), ray);
}

void RayScene::closest(std::span<const Ray> rays, std::span<Hit> hits) const {
    embree::closest(impl_->scene.get(), rays,
                    [&](std::size_t i, const Hit& hit, unsigned) { hits[i] = hit; });
}

void RayScene::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
    embree::occluded(impl_->scene.get(), rays, blocked);
}

}  // namespace vlf
