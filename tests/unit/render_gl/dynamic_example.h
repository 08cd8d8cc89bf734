#pragma once
// Objects in small rooms, and the truth that their pictures are held against.

#include "open_gl.h"
#include "small_rooms.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/render/cpu/camera_rays.h"
#include "vlf/render/cpu/supersample.h"
#include "vlf/scene/generate/primitives.h"

#include <memory>
#include <numbers>
#include <string>

namespace vlf::test {

inline Material matte(const Vec3& diffuse) {
    Material m;
    m.diffuse = diffuse;
    return m;
}

inline DynamicObject objectOf(std::shared_ptr<const ObjectModel> model, const Vec3& at,
                              float scale) {
    DynamicObject object;
    object.name = "object";
    object.model = std::move(model);
    object.pose.translation = at;
    object.pose.scale = scale;
    object.settings.shading = Shading::flat;
    object.settings.shadow = ShadowKind::none;
    return object;
}

inline DynamicObject objectOf(const std::string& primitive, const Vec3& at, float scale,
                              const Material& material = matte({0.7f, 0.1f, 0.1f})) {
    return objectOf(std::make_shared<const ObjectModel>(makePrimitive(primitive, material)), at,
                    scale);
}

/// A picture of room and objects by tracing rays one by one.
class DynamicPicture {
  public:
    DynamicPicture(const RayScene& rays, const DynamicRoom& room) : rays_(rays), room_(room) {}

    Image render(const StillParams& params) const {
        const CameraRays camera(params.camera, params.width, params.height);
        Image image(params.width, params.height);
        const int n = params.antialias;
        for (int y = 0; y < params.height; ++y)
            for (int x = 0; x < params.width; ++x)
                for (int i = 0; i < n * n; ++i) {
                    const Vec2 at = Vec2(x, y) + samplePoint(i, n);
                    image.at(x, y) += radiance(camera.ray(at.x, at.y), 0) / static_cast<float>(n * n);
                }
        return image;
    }

    /// The number of the lit object that is met first, or -1; reflected once if the ray meets a
    /// mirror of the room.
    int objectAlong(const Ray& ray, int reflections) const {
        const Meeting m = meet(ray);
        if (reflections == 0 || m.object >= 0 || !m.mirrors)
            return reflections == 0 ? m.object : -1;
        return objectAlong(m.reflected, reflections - 1);
    }

  private:
    struct Meeting {
        int object = -1;
        Vec3 own{0}, mirror{0};
        bool mirrors = false;
        Ray reflected;
    };

    Meeting meet(const Ray& ray) const {
        Meeting m;
        const Hit hit = rays_.closest(ray);
        const InstanceHit object = room_.rays().closest(ray);
        if (object && !(hit && hit.t < object.hit.t)) {
            const LitObject& lit = room_.litObjects()[object.instance];
            m.object = static_cast<int>(object.instance);
            Ray local{lit.pose.inversePoint(ray.origin), lit.pose.inverseDirection(ray.direction)};
            const bool front =
                glm::dot(areaVector(lit.mesh->scene, object.hit.triangle), local.direction) < 0;
            finish(m, lit.mesh->scene, object.hit, local, front,
                   lit.irradiance(object.hit.triangle, object.hit.barycentric, front), true);
            m.reflected = {ray.origin + object.hit.t * ray.direction +
                               rays_.epsilon() * lit.pose.direction(side_),
                           lit.pose.direction(m.reflected.direction)};
        } else if (hit) {
            const Scene& scene = room_.scene();
            const bool front = glm::dot(areaVector(scene, hit.triangle), ray.direction) < 0;
            const TriangleCharts& charts = room_.field().triangleCharts[hit.triangle];
            const std::uint32_t c = front ? charts.front : charts.back;
            if (c == kNoChart) return m;
            const Chart& chart = room_.field().charts[c];
            const Vec3 p = positionAt(scene, hit.triangle, hit.barycentric);
            finish(m, scene, hit, ray, front,
                   room_.irradiance().sample(chart, chart.texelCoordinates(p)), !chart.planar);
            m.reflected.origin = p + rays_.epsilon() * side_;
        }
        return m;
    }

    void finish(Meeting& m, const Scene& scene, const Hit& hit, const Ray& ray, bool front,
                const Vec3& irradiance, bool curved) const {
        const Material& material = scene.material(hit.triangle);
        const Vec2 uv = uvAt(scene, hit.triangle, hit.barycentric);
        m.own = diffuseReflectance(scene, material, uv) * irradiance / std::numbers::pi_v<float>;
        if (front || material.emitsBothSides) m.own += emittedRadiance(scene, material, uv);
        m.mirror = mirrorReflectance(scene, material, uv);
        m.mirrors = material.isMirror();
        side_ = (front ? 1.0f : -1.0f) * geometricNormal(scene, hit.triangle);
        Vec3 n = curved ? shadingNormalAt(scene, hit.triangle, hit.barycentric) : side_;
        if (glm::dot(n, side_) < 0) n = -n;
        m.reflected.direction = glm::reflect(ray.direction, n);
        if (glm::dot(m.reflected.direction, side_) <= 0)
            m.reflected.direction = glm::reflect(ray.direction, side_);
    }

    Vec3 radiance(const Ray& ray, int depth) const {
        const Meeting m = meet(ray);
        if (!m.mirrors || depth > 4) return m.own;
        return m.own + m.mirror * radiance(m.reflected, depth + 1);
    }

    const RayScene& rays_;
    const DynamicRoom& room_;
    mutable Vec3 side_{0};
};

inline Image drawn(Renderer& renderer, const StillParams& params) {
    Progress progress;
    return renderStill(renderer, params, progress);
}

}  // namespace vlf::test
