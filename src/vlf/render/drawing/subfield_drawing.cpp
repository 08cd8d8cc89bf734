#include "vlf/render/drawing/subfield_drawing.h"

#include "vlf/base/error.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>

namespace vlf {

namespace {

constexpr int kMostCells = 65535, kMostCellsOfTile = 256;
constexpr int kUsualTile = 16;  ///< cells, of fields whose radiance is not stored by tiles

/// The axes of a camera's view.
struct ViewAxes {
    Vec3 right, up, forward;

    explicit ViewAxes(const Camera& camera) {
        forward = glm::normalize(camera.look - camera.eye);
        right = glm::normalize(glm::cross(forward, glm::normalize(camera.up)));
        up = glm::cross(right, forward);
    }
};

/// From the left, above and behind the room towards the camera: shows the grid at a good angle.
Vec3 usualDirection(const Camera& camera) {
    const ViewAxes view(camera);
    return glm::normalize(0.75f * view.right - 0.45f * view.up - 0.5f * view.forward);
}

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

/// Well separated colours for consecutive numbers: hues by the golden ratio.
Vec3 paletteColor(std::size_t i) {
    const float hue = 6 * glm::fract(0.08f + 0.618034f * static_cast<float>(i));
    const Vec3 rgb =
        glm::clamp(glm::abs(glm::mod(Vec3(hue, hue + 4, hue + 2), 6.0f) - 3.0f) - 1.0f, 0.0f, 1.0f);
    return glm::mix(Vec3(0.04f), Vec3(0.75f), rgb);
}

/// Lines every `step` cells of [lower, upper] in the plane where the rays begin.
void addGrid(std::vector<PenLine>& lines, const SubfieldSelection& s, const Vec2& lower,
             const Vec2& upper, int step, std::uint32_t pen) {
    const auto side = static_cast<float>(step);
    for (float x = lower.x; x < upper.x + side; x += side) {
        const float c = std::min(x, upper.x);
        lines.push_back({s.at({c, lower.y}), s.at({c, upper.y}), pen});
    }
    for (float y = lower.y; y < upper.y + side; y += side) {
        const float c = std::min(y, upper.y);
        lines.push_back({s.at({lower.x, c}), s.at({upper.x, c}), pen});
    }
}

/// The bounding sphere's outline, seen along the direction.
void addSphere(std::vector<PenLine>& lines, const FieldFrame& frame, const Vec3& direction) {
    constexpr int kSides = 96;
    const Frame axes = frameFromNormal(direction);
    const auto point = [&](int k) {
        const float angle = 2 * kPi * static_cast<float>(k) / kSides;
        return frame.centre + frame.radius * axes.toWorld({std::cos(angle), std::sin(angle), 0});
    };
    for (int i = 0; i < kSides; ++i) lines.push_back({point(i), point(i + 1), subfield::sphere});
}

void addBundle(std::vector<PenLine>& lines, const RayScene& rays, const SubfieldSelection& s) {
    constexpr int kMostAlongSide = 16;
    const int step = (s.tiles() + kMostAlongSide - 1) / kMostAlongSide;
    for (int y = step / 2; y < s.tiles(); y += step)
        for (int x = step / 2; x < s.tiles(); x += step) {
            const Ray ray = s.ray((Vec2(x, y) + 0.5f) * static_cast<float>(s.tileSize));
            const Hit hit = rays.closest(ray);
            if (!hit) continue;
            const Vec3 end = ray.origin + hit.t * ray.direction;
            lines.push_back({ray.origin, end, subfield::rays});
            lines.push_back({end, end, subfield::rayEnds});
        }
}

void addBeam(std::vector<PenLine>& lines, const SubfieldSelection& s, float length) {
    const Vec2 lower = s.tileLower(), upper = s.tileUpper();
    for (const Vec2& corner : {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}})
        lines.push_back({s.at(corner), s.at(corner, length), subfield::beam});
}

}  // namespace

bool SubfieldSelection::inTile(const Vec3& p) const {
    const Vec2 c = subfield.cellCoordinates(p), lower = tileLower(), upper = tileUpper();
    return c.x >= lower.x && c.y >= lower.y && c.x < upper.x && c.y < upper.y;
}

Vec3 SubfieldSelection::at(const Vec2& cell, float depth) const {
    const ParallelSubfield& f = subfield;
    const float scale = 1 / glm::dot(f.xAxis, f.xAxis);
    return scale * ((cell.x - f.xOffset) * f.xAxis + (cell.y - f.yOffset) * f.yAxis) +
           (depth - f.depthOffset) * f.direction;
}

SubfieldSelection selectSubfield(const LightField& field, const DirectionSet& set,
                                 const DiagramParams& params, const Camera& camera) {
    if (field.record.cells < 1 || field.record.cells > kMostCells ||
        field.record.tileSize > kMostCellsOfTile)
        throw InputError("the light field does not say how many cells and tiles it was made with");
    SubfieldSelection selection;
    selection.direction = chooseDirection(set, params, camera);
    selection.subfield =
        makeSubfield(field.frame, set.direction(selection.direction), field.record.cells);
    selection.tileSize = field.record.tileSize > 0 ? field.record.tileSize : kUsualTile;
    selection.tileX = chooseTile(params.tileX, selection.tiles());
    selection.tileY = chooseTile(params.tileY, selection.tiles());
    return selection;
}

Camera subfieldOverview(const Camera& camera, const FieldFrame& frame, const Vec3& direction,
                        int width, int height) {
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

std::vector<PenLine> subfieldLines(const RayScene& rays, const FieldFrame& frame,
                                   const SubfieldSelection& s, DiagramKind kind) {
    const Vec2 all(static_cast<float>(s.subfield.cells));
    std::vector<PenLine> lines;
    addSphere(lines, frame, s.subfield.direction);
    if (kind == DiagramKind::subfield) addBundle(lines, rays, s);
    addGrid(lines, s, Vec2(0), all, s.tileSize, subfield::tiles);
    addGrid(lines, s, Vec2(0), all, s.subfield.cells, subfield::border);
    addGrid(lines, s, s.tileLower(), s.tileUpper(), 1, subfield::cells);
    addGrid(lines, s, s.tileLower(), s.tileUpper(), s.tileSize, subfield::tileEdges);
    if (kind == DiagramKind::tile) addBeam(lines, s, 2 * frame.radius);
    return lines;
}

/// All surfaces along a ray, nearest first.
std::vector<Hit> hitsAlong(const RayScene& rays, Ray ray) {
    std::vector<Hit> hits;
    while (static_cast<int>(hits.size()) < subfield::kMaxLayers) {
        const Hit hit = rays.closest(ray);
        if (!hit) break;
        hits.push_back(hit);
        ray.tMin = hit.t + rays.epsilon() / glm::length(ray.direction);
    }
    return hits;
}

std::map<std::uint32_t, Vec3> tileChartColors(const RayScene& rays, const LightField& field,
                                              const SubfieldSelection& selection) {
    std::set<std::uint32_t> charts;
    const Vec2 upper = selection.tileUpper();
    for (float y = selection.tileLower().y + 0.5f; y < upper.y; ++y)
        for (float x = selection.tileLower().x + 0.5f; x < upper.x; ++x)
            for (const Hit& hit : hitsAlong(rays, selection.ray({x, y}))) {
                charts.insert(field.triangleCharts[hit.triangle].front);
                charts.insert(field.triangleCharts[hit.triangle].back);
            }
    charts.erase(kNoChart);
    std::map<std::uint32_t, Vec3> colors;
    for (const std::uint32_t chart : charts) colors.emplace(chart, paletteColor(colors.size()));
    return colors;
}

}  // namespace vlf
