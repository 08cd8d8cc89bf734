#include "vlf/render/cpu/subfield_diagram.h"

#include "vlf/render/cpu/field_shader.h"
#include "vlf/render/cpu/supersample.h"
#include "vlf/render/cpu/wireframe.h"
#include "vlf/render/drawing/mesh_edges.h"
#include "vlf/render/drawing/subfield_drawing.h"

#include <map>
#include <utility>
#include <vector>

namespace vlf {

namespace {

using namespace subfield;

/// The room as glass, the charts that a tile meets coloured, most of all within its beam.
class GlassRoom {
  public:
    GlassRoom(const Scene& scene, const RayScene& rays, const LightField& field,
              const SubfieldSelection& selection)
        : scene_(scene),
          rays_(rays),
          field_(field),
          selection_(selection),
          colors_(tileChartColors(rays, field, selection)) {}

    std::uint64_t shade(std::span<const Ray> rays, std::span<Vec3> colors) const {
        std::uint64_t traced = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const std::vector<Hit> hits = hitsAlong(rays_, rays[i]);
            traced += hits.size() + 1;
            colors[i] = kPaper;
            for (auto hit = hits.rbegin(); hit != hits.rend(); ++hit) {
                const auto [color, opacity] = layer(*hit, rays[i]);
                colors[i] = glm::mix(colors[i], color, opacity);
            }
        }
        return traced;
    }

  private:
    std::pair<Vec3, float> layer(const Hit& hit, const Ray& ray) const {
        const TriangleCharts& charts = field_.triangleCharts[hit.triangle];
        auto color = colors_.find(chartAt(field_, pointFacing(scene_, hit, ray.direction)));
        if (color == colors_.end()) color = colors_.find(charts.front);
        if (color == colors_.end()) color = colors_.find(charts.back);
        if (color == colors_.end()) return {kInk, kSeenElse};
        const Vec3 p = positionAt(scene_, hit.triangle, hit.barycentric);
        return {color->second, selection_.inTile(p) ? kSeenInBeam : kSeenOfChart};
    }

    const Scene& scene_;
    const RayScene& rays_;
    const LightField& field_;
    const SubfieldSelection& selection_;
    std::map<std::uint32_t, Vec3> colors_;
};

void drawLines(Image& image, const Projection& projection, const Scene& scene,
               const std::vector<PenLine>& lines) {
    const std::vector<MeshEdge> edges = meshEdges(scene);
    for (int sheet = 0; sheet < static_cast<int>(kColors.size()); ++sheet) {
        LineLayer layer(image.width, image.height);
        const auto draw = [&](const Vec3& from, const Vec3& to, const Pen& pen) {
            if (pen.sheet == sheet) drawSegment(layer, projection, from, to, pen);
        };
        for (const MeshEdge& edge : edges)
            if (edge.crease || edge.isContour(projection.eye()))
                draw(edge.from, edge.to, kPens[roomEdges]);
        for (const PenLine& line : lines) draw(line.from, line.to, kPens[line.pen]);
        layer.drawOn(image, kColors[sheet]);
    }
}

}  // namespace

Image drawSubfieldDiagram(const Scene& scene, const RayScene& rays, const LightField& field,
                          const Camera& camera, int width, int height, int antialias,
                          const DiagramParams& params, Progress& progress, std::uint64_t& traced) {
    const SubfieldSelection selection =
        selectSubfield(field, DirectionSet(field.record.directions), params, camera);
    const Camera overview =
        subfieldOverview(camera, field.frame, selection.subfield.direction, width, height);
    Image image(width, height, kPaper);
    if (params.kind == DiagramKind::tile) {
        const GlassRoom room(scene, rays, field, selection);
        image = supersample(
            CameraRays(overview, width, height), width, height, antialias,
            [&](std::span<const Ray> r, int, std::span<Vec3> seen) { return room.shade(r, seen); },
            progress, traced);
    }
    drawLines(image, Projection(overview, width, height), scene,
              subfieldLines(rays, field.frame, selection, params.kind));
    return image;
}

}  // namespace vlf
