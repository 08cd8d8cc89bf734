#include "vlf/render/cpu/wireframe.h"

#include "vlf/base/parallel.h"
#include "vlf/render/cpu/camera_rays.h"
#include "vlf/render/cpu/mesh_edges.h"

#include <algorithm>
#include <array>
#include <vector>

namespace vlf {

namespace {

constexpr Vec3 kNormalInk{0.8f, 0.18f, 0.02f};

constexpr float kStrokeLength = 2;      ///< pixels between tests of visibility
constexpr float kFullStrength = 14;     ///< pixels: shorter edges of triangles are paler
constexpr float kFarStrength = 0.4f;    ///< of what lies at the far end of the scene
constexpr float kSurfaceSlack = 5e-4f;  ///< part of the way to the eye in which nothing hides

enum Sheet { hidden, triangleEdges, creases, normalLines, kSheets };

struct Pen {
    float thickness;  ///< pixels
    float strength;
    Vec3 color;
};

constexpr std::array<Pen, kSheets> kPens{{
    {1.0f, 0.16f, kInk},
    {0.9f, 0.45f, kInk},
    {1.5f, 1.0f, kInk},
    {1.0f, 0.9f, kNormalInk},
}};

/// A short piece of a line, all of it visible or all of it hidden.
struct Stroke {
    Vec2 from, to;
    float strength;
    Sheet sheet;
};

/// A line as it is to be drawn where it is visible and where not.
struct Line {
    Vec3 from, to;
    Sheet whereVisible;
    bool showHidden;
};

class StrokeMaker {
  public:
    StrokeMaker(const Scene& scene, const RayScene& rays, const Projection& projection)
        : rays_(rays), projection_(projection) {
        const Sphere sphere = boundingSphere(scene);
        const float distance = glm::distance(sphere.centre, projection.eye());
        near_ = std::max(distance - sphere.radius, 0.0f);
        far_ = distance + sphere.radius;
    }

    /// Appends the strokes of a line; returns the number of rays traced.
    std::uint64_t add(const Line& line, std::vector<Stroke>& strokes) const {
        const std::optional<PictureSegment> segment = projection_.project(line.from, line.to);
        if (!segment) return 0;
        const float length = segment->length();
        const int count = std::max(1, static_cast<int>(std::ceil(length / kStrokeLength)));
        const std::vector<std::uint8_t> blocked = findBlocked(*segment, count);
        const float density =
            line.whereVisible == triangleEdges ? std::min(length / kFullStrength, 1.0f) : 1;
        for (int i = 0; i < count; ++i) {
            if (blocked[i] && !line.showHidden) continue;
            const float s = 1.0f / count;
            const float strength = density * depthCue(segment->depthAt((i + 0.5f) * s));
            strokes.push_back({segment->at(i * s), segment->at((i + 1) * s), strength,
                               blocked[i] ? hidden : line.whereVisible});
        }
        return count;
    }

    bool visible(const Vec3& p) const { return !rays_.occluded(sightOf(p)); }

  private:
    std::vector<std::uint8_t> findBlocked(const PictureSegment& segment, int count) const {
        std::vector<Ray> sights;
        for (int i = 0; i < count; ++i) {
            const float s = (i + 0.5f) / count;
            sights.push_back(sightOf(projection_.unproject(segment.at(s), segment.depthAt(s))));
        }
        std::vector<std::uint8_t> blocked(sights.size());
        rays_.occluded(sights, blocked);
        return blocked;
    }

    Ray sightOf(const Vec3& p) const {
        return {projection_.eye(), p - projection_.eye(), 0, 1 - kSurfaceSlack};
    }

    float depthCue(float depth) const {
        const float t = std::clamp((depth - near_) / std::max(far_ - near_, 1e-20f), 0.0f, 1.0f);
        return glm::mix(1.0f, kFarStrength, t * t);
    }

    const RayScene& rays_;
    const Projection& projection_;
    float near_, far_;  ///< metres
};

std::vector<Line> edgeLines(const Scene& scene, const Vec3& eye) {
    std::vector<Line> lines;
    for (const MeshEdge& edge : meshEdges(scene)) {
        const bool strong = edge.crease || edge.isContour(eye);
        lines.push_back({edge.from, edge.to, strong ? creases : triangleEdges, edge.crease});
    }
    return lines;
}

/// Half the size of the triangle long, on the side that is seen.
void addNormals(const Scene& scene, const StrokeMaker& maker, const Vec3& eye,
                std::vector<Line>& lines) {
    const float longest = 0.08f * boundingSphere(scene).radius;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const Vec3 centre = positionAt(scene, t, Vec2(1 / 3.0f));
        if (!maker.visible(centre)) continue;
        const Vec3 normal = shadingNormalAt(scene, t, Vec2(1 / 3.0f));
        const float side = glm::dot(normal, eye - centre) < 0 ? -1.0f : 1.0f;
        const float length = std::min(0.5f * std::sqrt(2 * area(scene, t)), longest);
        lines.push_back({centre, centre + side * length * normal, normalLines, false});
    }
}

std::uint64_t drawLines(const std::vector<Line>& lines, const StrokeMaker& maker,
                        std::vector<LineLayer>& sheets, Progress& progress) {
    constexpr std::size_t kPart = 256;
    std::vector<std::vector<Stroke>> strokes((lines.size() + kPart - 1) / kPart);
    std::vector<std::uint64_t> traced(strokes.size(), 0);
    ProgressCounter counter(progress, strokes.size());
    parallelFor(strokes.size(), [&](std::size_t part) {
        for (std::size_t i = part * kPart; i < std::min((part + 1) * kPart, lines.size()); ++i)
            traced[part] += maker.add(lines[i], strokes[part]);
        counter.step();
    });
    std::uint64_t total = 0;
    for (const std::uint64_t n : traced) total += n;
    for (const std::vector<Stroke>& part : strokes)
        for (const Stroke& s : part)
            sheets[s.sheet].line(s.from, s.to, kPens[s.sheet].thickness,
                                 s.strength * kPens[s.sheet].strength);
    return total;
}

}  // namespace

void drawSegment(LineLayer& layer, const Projection& projection, const Vec3& from, const Vec3& to,
                 float thickness, float strength) {
    if (const std::optional<PictureSegment> s = projection.project(from, to))
        layer.line(s->from.position, s->to.position, thickness, strength);
}

Image drawWireframe(const Scene& scene, const RayScene& rays, const Camera& camera, int width,
                    int height, bool normals, Progress& progress, std::uint64_t& traced) {
    const CameraRays requireView(camera, width, height);
    const Projection projection(camera, width, height);
    const StrokeMaker maker(scene, rays, projection);
    std::vector<Line> lines = edgeLines(scene, camera.eye);
    if (normals) addNormals(scene, maker, camera.eye, lines);
    std::vector<LineLayer> sheets(kSheets, LineLayer(width, height));
    traced = drawLines(lines, maker, sheets, progress);
    if (normals) traced += scene.triangles.size();
    Image image(width, height, kPaper);
    for (int i = 0; i < kSheets; ++i) sheets[i].drawOn(image, kPens[i].color);
    return image;
}

}  // namespace vlf
