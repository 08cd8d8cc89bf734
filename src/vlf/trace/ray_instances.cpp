#include "vlf/trace/ray_instances.h"

#include "vlf/base/error.h"
#include "vlf/trace/embree_scene.h"

#include <cmath>
#include <limits>
#include <vector>

namespace vlf {

namespace {
constexpr int kMaxCrossings = 64;  // of one instance by a ray
}

using EmbreeGeometry =
    std::unique_ptr<std::remove_pointer_t<RTCGeometry>, EmbreeRelease<rtcReleaseGeometry>>;

struct RayInstances::Impl {
    EmbreeScene scene;
    std::vector<EmbreeGeometry> geometries;
    std::vector<const RayScene*> scenes;

    /// New geometries for other scenes than before.
    void renew(std::span<const RayInstance> instances) {
        const RTCDevice device = embreeDevice(RayIsa::automatic);
        scene.reset(rtcNewScene(device));
        rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC);
        geometries.clear();
        scenes.clear();
        for (const RayInstance& instance : instances) {
            geometries.emplace_back(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE));
            rtcSetGeometryInstancedScene(geometries.back().get(),
                                         instance.scene->impl_->scene.get());
            rtcAttachGeometryByID(scene.get(), geometries.back().get(),
                                  static_cast<unsigned>(scenes.size()));
            scenes.push_back(instance.scene);
        }
    }

    bool sameScenes(std::span<const RayInstance> instances) const {
        return std::equal(scenes.begin(), scenes.end(), instances.begin(), instances.end(),
                          [](const RayScene* s, const RayInstance& i) { return s == i.scene; });
    }
};

RayInstances::RayInstances() : impl_(std::make_unique<Impl>()) {}
RayInstances::~RayInstances() = default;
RayInstances::RayInstances(RayInstances&&) noexcept = default;
RayInstances& RayInstances::operator=(RayInstances&&) noexcept = default;

void RayInstances::place(std::span<const RayInstance> instances) {
    if (!impl_->scene || !impl_->sameScenes(instances)) impl_->renew(instances);
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const Mat4 matrix = instances[i].pose.matrix();
        const RTCGeometry geometry = impl_->geometries[i].get();
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &matrix[0][0]);
        rtcCommitGeometry(geometry);
    }
    rtcCommitScene(impl_->scene.get());
    if (rtcGetDeviceError(embreeDevice(RayIsa::automatic)) != RTC_ERROR_NONE)
        throw Error("the ray tracing kernels could not place the objects: out of memory?");
}

bool RayInstances::empty() const {
    return impl_->scenes.empty();
}

InstanceHit RayInstances::closest(const Ray& ray) const {
    if (empty()) return {};
    RTCRayHit query;
    const Hit hit = embree::closest(impl_->scene.get(), ray, query);
    return {hit ? query.hit.instID[0] : 0, hit};
}

bool RayInstances::occluded(const Ray& ray) const {
    return !empty() && embree::occluded(impl_->scene.get(), ray);
}

void RayInstances::closest(std::span<const Ray> rays, std::span<InstanceHit> hits) const {
    if (empty()) {
        std::fill(hits.begin(), hits.end(), InstanceHit{});
        return;
    }
    embree::closest(impl_->scene.get(), rays,
                    [&](std::size_t i, const Hit& hit, unsigned instance) {
                        hits[i] = {hit ? instance : 0, hit};
                    });
}

void RayInstances::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
    if (empty())
        std::fill(blocked.begin(), blocked.end(), std::uint8_t{0});
    else
        embree::occluded(impl_->scene.get(), rays, blocked);
}

void RayInstances::closestBut(std::uint32_t excluded, std::span<const Ray> rays,
                              std::span<InstanceHit> hits) const {
    closest(rays, hits);
    thread_local std::vector<std::uint32_t> crossing;
    thread_local std::vector<Ray> beyond;
    thread_local std::vector<InstanceHit> found;
    crossing.clear(), beyond.clear();
    const auto follow = [&](std::uint32_t i, float from) {
        crossing.push_back(i);
        beyond.push_back(rays[i]);
        beyond.back().tMin = std::nextafter(from, std::numeric_limits<float>::infinity());
    };
    for (std::uint32_t i = 0; i < rays.size(); ++i)
        if (hits[i] && hits[i].instance == excluded) follow(i, hits[i].hit.t);
    for (int pass = 0; pass < kMaxCrossings && !crossing.empty(); ++pass) {
        found.resize(beyond.size());
        closest(beyond, found);
        const std::vector<std::uint32_t> before(crossing);
        crossing.clear(), beyond.clear();
        for (std::size_t k = 0; k < before.size(); ++k) {
            hits[before[k]] = found[k];
            if (found[k] && found[k].instance == excluded) follow(before[k], found[k].hit.t);
        }
    }
    for (const std::uint32_t i : crossing) hits[i] = {};
}

}  // namespace vlf
