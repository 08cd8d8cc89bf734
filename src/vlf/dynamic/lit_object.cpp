#include "vlf/dynamic/lit_object.h"

namespace vlf {

Vec3 LitObject::irradiance(std::uint32_t triangle, const Vec2& barycentric, bool front) const {
    if (texels) {
        const TriangleCharts& charts = texels->triangleCharts[triangle];
        const std::uint32_t chart = front ? charts.front : charts.back;
        if (chart == kNoChart) return Vec3(0);
        const Chart& c = texels->charts[chart];
        return atlas->sample(c, c.texelCoordinates(positionAt(mesh->scene, triangle, barycentric)));
    }
    if (!front && mesh->closed) return Vec3(0);
    const std::size_t side = front ? 0 : mesh->scene.positions.size();
    const auto& vertex = mesh->scene.triangles[triangle].vertex;
    return (1 - barycentric.x - barycentric.y) * vertexIrradiance[side + vertex[0]] +
           barycentric.x * vertexIrradiance[side + vertex[1]] +
           barycentric.y * vertexIrradiance[side + vertex[2]];
}

}  // namespace vlf
