#include "vlf/render/cpu/subfield_diagram.h"

#include "vlf/base/error.h"
#include "vlf/field/direction_set.h"
#include "vlf/render/cpu/field_shader.h"
#include "vlf/render/cpu/mesh_edges.h"
#include "vlf/render/cpu/supersample.h"
#include "vlf/render/cpu/wireframe.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace vlf {

namespace {

constexpr Vec3 kGridInk{0.05f, 0.2f, 0.5f}, kTileInk{0.75f, 0.12f, 0.01f},
    kRayInk{0.1f, 0.3f, 0.7f};

constexpr int kMostCells = 65535, kMostCellsOfTile = 256;
constexpr int kUsualTile = 16;  ///< cells, of fields whose radiance is not stored by tiles

constexpr int kMaxLayers = 32;  ///< surfaces behind one another that are looked through
constexpr float kSeenInBeam = 0.9f, kSeenOfChart = 0.4f, kSeenElse = 0.04f;  ///< opacities

/// The axes of a camera's view.
struct ViewAxes {
    Vec3 right, up, forward;

    explicit ViewAxes(const Camera& camera) {
        forward = glm::normalize(camera.look - camera.eye);
        right = glm::normalize(glm::cross(forward, glm::normalize(camera.up)));
        up = glm::cross(right, forward);
    }
};

/// Looks along the camera's line of sight, from a little higher, at all of the field's bounding
/// sphere and the grid before it.
Camera overviewOf(const Camera& camera, const FieldFrame& frame, const Vec3& direction, int width,
                  int height) {
    constexpr float kFov = 35;  ///< degrees
    const ViewAxes view(camera);
    const float aspect = std::min(1.0f, static_cast<float>(width) / height);
    const float halfAngle = std::atan(std::tan(0.5f * kFov * (kPi / 180)) * aspect);
    const float distance = 1.45f * frame.radius / std::sin(halfAngle);
    Camera overview = camera;
    overview.look = frame.centre - 0.5f * frame.radius * direction;
    overview.eye = overview.look - distance * glm::normalize(view.forward - 0.3f * view.up);
    overview.up = view.up;
    overview.verticalFov = kFov;
    overview.shift = Vec2(0);
    return overview;
}

/// From the left, above and behind the room towards the camera: shows the grid at a good angle.
Vec3 usualDirection(const Camera& camera) {
    const ViewAxes view(camera);
    return glm::normalize(0.75f * view.right - 0.45f * view.up - 0.5f * view.forward);
}

/// The part of the field that is drawn.
struct Selection {
    ParallelSubfield subfield;
    int tileSize = 1;
    int tileX = 0, tileY = 0;

    int tiles() const { return (subfield.cells + tileSize - 1) / tileSize; }
    Vec2 tileLower() const { return Vec2(tileX, tileY) * static_cast<float>(tileSize); }
    Vec2 tileUpper() const {
        return glm::min(tileLower() + static_cast<float>(tileSize),
                        Vec2(static_cast<float>(subfield.cells)));
    }
    bool inTile(const Vec3& p) const {
        const Vec2 c = subfield.cellCoordinates(p), lower = tileLower(), upper = tileUpper();
        return c.x >= lower.x && c.y >= lower.y && c.x < upper.x && c.y < upper.y;
    }
    /// World point at cell coordinates and depth.
    Vec3 at(const Vec2& cell, float depth = 0) const {
        const ParallelSubfield& f = subfield;
        const float scale = 1 / glm::dot(f.xAxis, f.xAxis);
        return scale * ((cell.x - f.xOffset) * f.xAxis + (cell.y - f.yOffset) * f.yAxis) +
               (depth - f.depthOffset) * f.direction;
    }
    Ray ray(const Vec2& cell) const { return {at(cell), subfield.direction}; }
};

std::uint32_t chooseDirection(const DirectionSet& set, const DiagramParams& params,
                              const Camera& camera) {
    const std::uint32_t direction = params.direction.value_or(set.nearest(usualDirection(camera)));
    if (direction < static_cast<std::uint32_t>(set.directionCount())) return direction;
    throw InputError("no direction " + std::to_string(direction) + ": the light field has " +
                     std::to_string(set.directionCount()));
}

int chooseTile(const std::optional<std::uint32_t>& wanted, int tiles) {
    if (!wanted) return tiles / 2;
    if (*wanted < static_cast<std::uint32_t>(tiles)) return static_cast<int>(*wanted);
    throw InputError("no tile " + std::to_string(*wanted) + ": there are " + std::to_string(tiles) +
                     " along each side");
}

Selection select(const LightField& field, const DiagramParams& params, const Camera& camera) {
    const DirectionSet set(field.record.directions);
    if (field.record.cells < 1 || field.record.cells > kMostCells ||
        field.record.tileSize > kMostCellsOfTile)
        throw InputError("the light field does not say how many cells and tiles it was made with");
    Selection selection;
    selection.subfield = makeSubfield(
        field.frame, set.direction(chooseDirection(set, params, camera)), field.record.cells);
    selection.tileSize = field.record.tileSize > 0 ? field.record.tileSize : kUsualTile;
    selection.tileX = chooseTile(params.tileX, selection.tiles());
    selection.tileY = chooseTile(params.tileY, selection.tiles());
    return selection;
}

/// All surfaces along a ray, nearest first.
std::vector<Hit> hitsAlong(const RayScene& rays, Ray ray) {
    std::vector<Hit> hits;
    while (static_cast<int>(hits.size()) < kMaxLayers) {
        const Hit hit = rays.closest(ray);
        if (!hit) break;
        hits.push_back(hit);
        ray.tMin = hit.t + rays.epsilon() / glm::length(ray.direction);
    }
    return hits;
}

/// Charts that the rays of the selected tile meet, on either side.
std::set<std::uint32_t> chartsInTile(const RayScene& rays, const LightField& field,
                                     const Selection& selection) {
    std::set<std::uint32_t> charts;
    const Vec2 upper = selection.tileUpper();
    for (float y = selection.tileLower().y + 0.5f; y < upper.y; ++y)
        for (float x = selection.tileLower().x + 0.5f; x < upper.x; ++x)
            for (const Hit& hit : hitsAlong(rays, selection.ray({x, y}))) {
                charts.insert(field.triangleCharts[hit.triangle].front);
                charts.insert(field.triangleCharts[hit.triangle].back);
            }
    charts.erase(kNoChart);
    return charts;
}

/// Well separated colours for consecutive numbers: hues by the golden ratio.
Vec3 paletteColor(std::size_t i) {
    const float hue = 6 * glm::fract(0.08f + 0.618034f * static_cast<float>(i));
    const Vec3 rgb =
        glm::clamp(glm::abs(glm::mod(Vec3(hue, hue + 4, hue + 2), 6.0f) - 3.0f) - 1.0f, 0.0f, 1.0f);
    return glm::mix(Vec3(0.04f), Vec3(0.75f), rgb);
}

/// The room as glass, the charts that a tile meets coloured, most of all within its beam.
class GlassRoom {
  public:
    GlassRoom(const Scene& scene, const RayScene& rays, const LightField& field,
              const Selection& selection)
        : scene_(scene), rays_(rays), field_(field), selection_(selection) {
        for (const std::uint32_t chart : chartsInTile(rays, field, selection))
            colors_.emplace(chart, paletteColor(colors_.size()));
    }

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
    const Selection& selection_;
    std::map<std::uint32_t, Vec3> colors_;
};

/// Pens on one sheet of paper.
class Drawing {
  public:
    Drawing(const Projection& projection, Image& image) : projection_(projection), image_(image) {}

    const Vec3& eye() const { return projection_.eye(); }
    LineLayer sheet() const { return LineLayer(image_.width, image_.height); }
    void line(LineLayer& sheet, const Vec3& from, const Vec3& to, float thickness,
              float strength) const {
        drawSegment(sheet, projection_, from, to, thickness, strength);
    }
    void dot(LineLayer& sheet, const Vec3& p, float diameter, float strength) const {
        if (const std::optional<PicturePoint> at = projection_.project(p))
            sheet.dot(at->position, diameter, strength);
    }
    /// Lines every `step` cells of [lower, upper] in the plane where the rays begin.
    void grid(LineLayer& sheet, const Selection& s, const Vec2& lower, const Vec2& upper, int step,
              float thickness, float strength) const {
        for (float x = lower.x; x < upper.x + step; x += step) {
            const float c = std::min(x, upper.x);
            line(sheet, s.at({c, lower.y}), s.at({c, upper.y}), thickness, strength);
        }
        for (float y = lower.y; y < upper.y + step; y += step) {
            const float c = std::min(y, upper.y);
            line(sheet, s.at({lower.x, c}), s.at({upper.x, c}), thickness, strength);
        }
    }
    void lay(const LineLayer& sheet, const Vec3& color) const { sheet.drawOn(image_, color); }

  private:
    const Projection& projection_;
    Image& image_;
};

void drawRoom(const Drawing& drawing, const Scene& scene) {
    LineLayer sheet = drawing.sheet();
    for (const MeshEdge& edge : meshEdges(scene))
        if (edge.crease || edge.isContour(drawing.eye()))
            drawing.line(sheet, edge.from, edge.to, 1, 0.75f);
    drawing.lay(sheet, kInk);
}

/// The bounding sphere's outline, seen along the direction.
void drawSphere(const Drawing& drawing, const FieldFrame& frame, const Vec3& direction) {
    constexpr int kSides = 96;
    const Frame axes = frameFromNormal(direction);
    LineLayer sheet = drawing.sheet();
    for (int i = 0; i < kSides; ++i) {
        const auto point = [&](int k) {
            const float angle = 2 * kPi * static_cast<float>(k) / kSides;
            return frame.centre +
                   frame.radius * axes.toWorld({std::cos(angle), std::sin(angle), 0});
        };
        drawing.line(sheet, point(i), point(i + 1), 1, 0.5f);
    }
    drawing.lay(sheet, kGridInk);
}

/// A ray through the middle of every tile (of every so many, where there are many), up to the
/// first surface it meets.
void drawBundle(const Drawing& drawing, const RayScene& rays, const Selection& s) {
    constexpr int kMostAlongSide = 16;
    const int step = (s.tiles() + kMostAlongSide - 1) / kMostAlongSide;
    LineLayer lines = drawing.sheet(), ends = drawing.sheet();
    for (int y = step / 2; y < s.tiles(); y += step)
        for (int x = step / 2; x < s.tiles(); x += step) {
            const Ray ray = s.ray((Vec2(x, y) + 0.5f) * static_cast<float>(s.tileSize));
            const Hit hit = rays.closest(ray);
            if (!hit) continue;
            const Vec3 end = ray.origin + hit.t * ray.direction;
            drawing.line(lines, ray.origin, end, 1, 0.45f);
            drawing.dot(ends, end, 5, 1);
        }
    drawing.lay(lines, kRayInk);
    drawing.lay(ends, kTileInk);
}

/// The selected tile's cells and the edges of its beam.
void drawTile(const Drawing& drawing, const Selection& s, float radius) {
    LineLayer cells = drawing.sheet(), edges = drawing.sheet();
    const Vec2 lower = s.tileLower(), upper = s.tileUpper();
    drawing.grid(cells, s, lower, upper, 1, 0.7f, 0.8f);
    drawing.grid(edges, s, lower, upper, s.tileSize, 2, 1);
    for (const Vec2& corner : {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}})
        drawing.line(edges, s.at(corner), s.at(corner, 2 * radius), 1.3f, 0.9f);
    drawing.lay(cells, kTileInk);
    drawing.lay(edges, kTileInk);
}

void drawGrid(const Drawing& drawing, const Selection& s) {
    LineLayer sheet = drawing.sheet();
    const Vec2 all(static_cast<float>(s.subfield.cells));
    drawing.grid(sheet, s, Vec2(0), all, s.tileSize, 0.8f, 0.4f);
    drawing.grid(sheet, s, Vec2(0), all, s.subfield.cells, 1.6f, 1);
    drawing.lay(sheet, kGridInk);
}

}  // namespace

Image drawSubfieldDiagram(const Scene& scene, const RayScene& rays, const LightField& field,
                          const Camera& camera, int width, int height, int antialias,
                          const DiagramParams& params, Progress& progress, std::uint64_t& traced) {
    const Selection selection = select(field, params, camera);
    const Camera overview =
        overviewOf(camera, field.frame, selection.subfield.direction, width, height);
    const Projection projection(overview, width, height);
    const bool oneTile = params.kind == DiagramKind::tile;
    Image image(width, height, kPaper);
    if (oneTile) {
        const GlassRoom room(scene, rays, field, selection);
        image = supersample(
            CameraRays(overview, width, height), width, height, antialias,
            [&](std::span<const Ray> r, std::span<Vec3> seen) { return room.shade(r, seen); },
            progress, traced);
    }
    const Drawing drawing(projection, image);
    drawRoom(drawing, scene);
    drawSphere(drawing, field.frame, selection.subfield.direction);
    if (!oneTile) drawBundle(drawing, rays, selection);
    drawGrid(drawing, selection);
    drawTile(drawing, selection, oneTile ? field.frame.radius : 0);
    return image;
}

}  // namespace vlf
