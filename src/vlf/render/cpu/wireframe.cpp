#include "vlf/render/cpu/wireframe.h"

#include "vlf/base/parallel.h"
#include "vlf/render/cpu/camera_rays.h"
#include "vlf/render/drawing/mesh_edges.h"
#include "vlf/render/drawing/wireframe_lines.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace vlf {

namespace {

using namespace wireframe;

/// A short piece of a line, all of it visible or all of it hidden.
struct Stroke {
    Vec2 from, to;
    float strength;
    std::uint32_t pen;
};

/// A line as it is to be drawn where it is visible and where not.
struct Line {
    Vec3 from, to;
    std::uint32_t whereVisible;
    bool showHidden;
};

class StrokeMaker {
  public:
    /// `objects` may be null.
    StrokeMaker(const Scene& scene, const RayScene& rays, const DynamicRoom* objects,
                const Projection& projection)
        : rays_(rays),
          objects_(objects ? &objects->rays() : nullptr),
          projection_(projection),
          cue_(boundingSphere(scene), projection.eye()) {}

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
            const float strength = density * cue_.strength(segment->depthAt((i + 0.5f) * s));
            strokes.push_back({segment->at(i * s), segment->at((i + 1) * s), strength,
                               blocked[i] ? hidden : line.whereVisible});
        }
        return count;
    }

    bool visible(const Vec3& p) const {
        return !rays_.occluded(sightOf(p)) && !(objects_ && objects_->occluded(sightOf(p)));
    }

  private:
    std::vector<std::uint8_t> findBlocked(const PictureSegment& segment, int count) const {
        std::vector<Ray> sights;
        for (int i = 0; i < count; ++i) {
            const float s = (i + 0.5f) / count;
            sights.push_back(sightOf(projection_.unproject(segment.at(s), segment.depthAt(s))));
        }
        std::vector<std::uint8_t> blocked(sights.size());
        rays_.occluded(sights, blocked);
        if (!objects_ || objects_->empty()) return blocked;
        for (int i = 0; i < count; ++i)
            if (!blocked[i]) blocked[i] = objects_->occluded(sights[i]);
        return blocked;
    }

    Ray sightOf(const Vec3& p) const {
        return {projection_.eye(), p - projection_.eye(), 0, 1 - kSurfaceSlack};
    }

    const RayScene& rays_;
    const RayInstances* objects_;
    const Projection& projection_;
    DepthCue cue_;
};

/// The object's mesh in the world.
Scene posedMesh(const LitObject& object) {
    Scene scene = object.mesh->scene;
    for (Vec3& p : scene.positions) p = object.pose.point(p);
    for (Vec3& n : scene.normals) n = object.pose.direction(n);
    return scene;
}

std::vector<Line> edgeLines(const Scene& scene, const Vec3& eye) {
    std::vector<Line> lines;
    for (const MeshEdge& edge : meshEdges(scene)) {
        const bool strong = edge.crease || edge.isContour(eye);
        lines.push_back({edge.from, edge.to, strong ? creases : triangleEdges, edge.crease});
    }
    return lines;
}

/// Of the visible triangles, on the side that is seen.
void addNormals(const Scene& scene, const StrokeMaker& maker, const Vec3& eye,
                std::vector<Line>& lines) {
    for (const PenLine& normal : vlf::normalLines(scene)) {
        if (!maker.visible(normal.from)) continue;
        const Vec3 along = normal.to - normal.from;
        const float side = glm::dot(along, eye - normal.from) < 0 ? -1.0f : 1.0f;
        lines.push_back({normal.from, normal.from + side * along, normal.pen, false});
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
            sheets[kPens[s.pen].sheet].line(s.from, s.to, kPens[s.pen].thickness,
                                            s.strength * kPens[s.pen].strength);
    return total;
}

}  // namespace

void drawSegment(LineLayer& layer, const Projection& projection, const Vec3& from, const Vec3& to,
                 const Pen& pen) {
    if (const std::optional<PictureSegment> s = projection.project(from, to))
        layer.line(s->from.position, s->to.position, pen.thickness, pen.strength);
}

Image drawWireframe(const Scene& scene, const RayScene& rays, const Camera& camera, int width,
                    int height, bool normals, Progress& progress, std::uint64_t& traced,
                    const DynamicRoom* objects) {
    const CameraRays requireView(camera, width, height);
    const Projection projection(camera, width, height);
    const StrokeMaker maker(scene, rays, objects, projection);
    std::vector<Line> lines = edgeLines(scene, camera.eye);
    if (normals) addNormals(scene, maker, camera.eye, lines);
    if (objects)
        for (const LitObject& object : objects->litObjects()) {
            const Scene posed = posedMesh(object);
            std::ranges::copy(edgeLines(posed, camera.eye), std::back_inserter(lines));
            if (normals) addNormals(posed, maker, camera.eye, lines);
        }
    std::vector<LineLayer> sheets(kColors.size(), LineLayer(width, height));
    traced = drawLines(lines, maker, sheets, progress);
    if (normals) traced += scene.triangles.size();
    Image image(width, height, kPaper);
    for (std::size_t i = 0; i < sheets.size(); ++i) sheets[i].drawOn(image, kColors[i]);
    return image;
}

}  // namespace vlf
