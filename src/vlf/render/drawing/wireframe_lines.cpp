#include "vlf/render/drawing/wireframe_lines.h"

namespace vlf {

std::vector<PenLine> normalLines(const Scene& scene) {
    const float longest = 0.08f * boundingSphere(scene).radius;
    std::vector<PenLine> lines;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const Vec3 centre = positionAt(scene, t, Vec2(1 / 3.0f));
        const float length = std::min(0.5f * std::sqrt(2 * area(scene, t)), longest);
        const Vec3 normal = shadingNormalAt(scene, t, Vec2(1 / 3.0f));
        lines.push_back({centre, centre + length * normal, wireframe::normalLines});
    }
    return lines;
}

}  // namespace vlf
