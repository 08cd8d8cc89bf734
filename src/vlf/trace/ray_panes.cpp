// Rays that pass panes of glass straight.

#include "vlf/trace/embree_scene.h"

namespace vlf {

namespace {

/// Panes nearer to each other than this many epsilons count as one, as they do for a path that
/// starts anew behind each.
constexpr float kGap = 1;

/// The triangles that `keep` picks, of plain materials; their numbers are added to `kept`.
template <class Keep>
Scene partOf(const Scene& scene, Keep keep, std::vector<std::uint32_t>& kept) {
    Scene part;
    part.positions = scene.positions;
    part.materials.resize(scene.materials.size());
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        if (!keep(scene.material(t))) continue;
        part.triangles.push_back(scene.triangles[t]);
        kept.push_back(t);
    }
    return part;
}

}  // namespace

RayScene::Panes RayScene::splitPanes(const Scene& scene, RayIsa isa) {
    std::vector<std::uint32_t> paneTriangles, otherTriangles;
    Scene panes = partOf(scene, [](const Material& m) { return m.isPane(); }, paneTriangles);
    const Scene others =
        partOf(scene, [](const Material& m) { return !m.isPane(); }, otherTriangles);
    RayScene paneRays(panes, isa), otherRays(others, isa);
    panes.materials = scene.materials;
    return {std::move(panes), std::move(paneRays), std::move(otherRays), std::move(otherTriangles)};
}

Transmittance RayScene::Panes::passed(const Ray& ray) const {
    Transmittance left;
    const float length = glm::length(ray.direction);
    const Vec3 direction = ray.direction / length;
    const float step = kGap * panes.epsilon() / length;
    Ray rest = ray;
    while (const Hit hit = panes.closest(rest)) {
        const Material& material = scene.material(hit.triangle);
        const float cosine = std::abs(glm::dot(geometricNormal(scene, hit.triangle), direction));
        const float share = 1 - paneReflectance(cosine, material.ior);
        left.colour *= share * material.transmission;
        left.chance *= share;
        rest.tMin = std::max(hit.t, rest.tMin) + step;
        if (!(rest.tMin < rest.tMax)) break;
    }
    return left;
}

bool RayScene::hasPanes() const {
    return impl_->panes != nullptr;
}

Transmittance RayScene::transmittance(const Ray& ray) const {
    if (!impl_->panes) return {Vec3(occluded(ray) ? 0.0f : 1.0f), 1};
    if (impl_->panes->others.occluded(ray)) return {Vec3(0), 1};
    return impl_->panes->passed(ray);
}

void RayScene::transmittance(std::span<const Ray> rays, std::span<Vec3> colours) const {
    thread_local std::vector<std::uint8_t> blocked;
    blocked.resize(rays.size());
    (impl_->panes ? impl_->panes->others : *this).occluded(rays, blocked);
    for (std::size_t i = 0; i < rays.size(); ++i)
        colours[i] = blocked[i]      ? Vec3(0)
                     : !impl_->panes ? Vec3(1)
                                     : impl_->panes->passed(rays[i]).colour;
}

Hit RayScene::closestBehindPanes(const Ray& ray, Transmittance& transmittance) const {
    transmittance = {};
    if (!impl_->panes) return closest(ray);
    Hit hit = impl_->panes->others.closest(ray);
    Ray before = ray;
    before.tMax = std::min(ray.tMax, hit.t);
    transmittance = impl_->panes->passed(before);
    if (hit) hit.triangle = impl_->panes->triangleOf[hit.triangle];
    return hit;
}

}  // namespace vlf
