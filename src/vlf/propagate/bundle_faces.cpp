#include "vlf/propagate/bundle_faces.h"

namespace vlf {

namespace {

void addFace(const Scene& scene, const Unwrap& unwrap, std::uint32_t triangle, std::uint32_t chart,
             bool flipped, BundleFaces& faces) {
    if (chart == kNoChart) return;
    const Chart& c = unwrap.charts[chart];
    for (int k = 0; k < 3; ++k) {
        const Vec3& p = scene.position(triangle, k);
        const Vec3 q = p - faces.frame.centre;
        const Vec2 texel = c.texelCoordinates(p);
        faces.x[k].push_back(q.x);
        faces.y[k].push_back(q.y);
        faces.z[k].push_back(q.z);
        faces.u[k].push_back(texel.x);
        faces.v[k].push_back(texel.y);
    }
    faces.origin.push_back(c.y * unwrap.atlasWidth + c.x);
    faces.width.push_back(c.width);
    faces.height.push_back(c.height);
    faces.flags.push_back((scene.material(triangle).isSpecular() ? BundleFaces::kMirror : 0) |
                          (flipped ? BundleFaces::kFlipped : 0));
    ++faces.count;
}

void pad(BundleFaces& faces) {
    const std::size_t size = (faces.count + BundleFaces::kFacePadding - 1) /
                             BundleFaces::kFacePadding * BundleFaces::kFacePadding;
    for (auto* arrays : {&faces.x, &faces.y, &faces.z, &faces.u, &faces.v})
        for (auto& a : *arrays) a.resize(size, 0.0f);
    for (auto* a : {&faces.origin, &faces.width, &faces.height, &faces.flags}) a->resize(size, 0);
}

}  // namespace

BundleFaces makeBundleFaces(const Scene& scene, const Unwrap& unwrap, const FieldFrame& frame) {
    BundleFaces faces;
    faces.frame = frame;
    faces.atlasWidth = unwrap.atlasWidth;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        addFace(scene, unwrap, t, unwrap.triangleCharts[t].front, false, faces);
        addFace(scene, unwrap, t, unwrap.triangleCharts[t].back, true, faces);
    }
    pad(faces);
    return faces;
}

}  // namespace vlf
