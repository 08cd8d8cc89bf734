#include "vlf/scene/import/cut_masks.h"

#include "vlf/base/parallel.h"
#include "vlf/scene/import/limits.h"
#include "vlf/scene/import/mask_outline.h"
#include "vlf/scene/import/polygon_holes.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace vlf {

namespace {

/// Samples for each texel, and how far, in steps between samples, an outline may be from them.
constexpr double kSamplesPerTexel = 2, kTolerance = 0.3;

/// Corners of a triangle in the order of their positions: the same for a neighbour that shares an
/// edge and for the other side of a surface modelled twice, which are then cut alike.
struct OrderedTriangle {
    std::array<std::uint32_t, 3> vertex;
    bool flipped = false;
};

OrderedTriangle ordered(const Scene& scene, const Triangle& triangle) {
    OrderedTriangle result{triangle.vertex};
    const auto order = [&](int i, int j) {
        const Vec3 &a = scene.positions[result.vertex[i]], &b = scene.positions[result.vertex[j]];
        if (std::tie(a.x, a.y, a.z) <= std::tie(b.x, b.y, b.z)) return;
        std::swap(result.vertex[i], result.vertex[j]);
        result.flipped = !result.flipped;
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    return result;
}

/// What becomes of a triangle.
struct Cut {
    MaskCover cover = MaskCover::solid;
    bool coarsened = false;
    std::vector<OutlinePoint> points;
    std::vector<std::array<int, 3>> triangles;  ///< of points; of a mixed cover
};

/// A masked triangle, ready to be cut.
class MaskedTriangle {
  public:
    MaskedTriangle(const Scene& scene, const MaskedMaterials& masked, std::uint32_t index)
        : corners_(ordered(scene, scene.triangles[index])),
          mask_(masked.masks.at(scene.triangles[index].material)),
          image_(masked.images[mask_.image]) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t v = corners_.vertex[k];
            const auto own = masked.uvs.find(v);
            uv_[k] = own != masked.uvs.end() ? own->second : scene.uvs[v];
            if (!isFinite(Vec3(uv_[k], 0))) uv_[k] = Vec2(0);
        }
        setShape(scene);
    }

    /// Steps between the samples of an edge, the masks `halvings` times halved.
    int steps(int halvings, const MaskLimits& limits) const {
        double texels = 0;
        for (int k = 0; k < 3; ++k) texels = std::max(texels, texelsAlong(k));
        const double wanted = std::ceil(std::ldexp(kSamplesPerTexel * texels, -halvings));
        return static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(limits.mostSteps)));
    }

    /// Whether that is fewer than the mask has.
    bool isCoarse(int halvings, const MaskLimits& limits) const {
        return steps(halvings, limits) <
               steps(0, {limits.mostSamples, limits.mostTriangles, 1 << 30});
    }

    Cut cut(int halvings, const MaskLimits& limits) const {
        int count = steps(halvings, limits);
        Cut result;
        if (!hasArea_) return result;
        result.coarsened = isCoarse(halvings, limits);
        for (; count > 0; count /= 2, result.coarsened = true)
            if (tryCut(count, result)) return result;
        const glm::dvec2 centre(1.0 / 3);
        result.cover = excess(centre, levelOf(1)) >= 0 ? MaskCover::solid : MaskCover::none;
        return result;
    }

    bool isFlipped() const { return corners_.flipped; }
    const std::array<std::uint32_t, 3>& vertices() const { return corners_.vertex; }

  private:
    double texelsAlong(int edge) const {
        const glm::dvec2 size(image_.width(), image_.height());
        return glm::length(size * (glm::dvec2(uv_[(edge + 1) % 3]) - glm::dvec2(uv_[edge])));
    }

    void setShape(const Scene& scene) {
        const glm::dvec3 a = scene.positions[corners_.vertex[0]],
                         b = scene.positions[corners_.vertex[1]],
                         c = scene.positions[corners_.vertex[2]];
        const double base = glm::length(b - a),
                     longest = std::max({base, glm::length(c - b), glm::length(a - c)});
        const double height = base > 0 ? glm::length(glm::cross(b - a, c - a)) / base : 0;
        hasArea_ = height > 1e-6 * longest;
        if (!hasArea_) return;
        shape_ = {glm::dvec2(0), glm::dvec2(base, 0) / longest,
                  glm::dvec2(glm::dot(c - a, b - a) / base, height) / longest};
    }

    /// The level of the mask of which two samples fall on a texel.
    int levelOf(int count) const {
        double texels = 0;
        for (int k = 0; k < 3; ++k) texels = std::max(texels, texelsAlong(k));
        const double perStep = kSamplesPerTexel * texels / count;
        const int level = perStep > 1 ? static_cast<int>(std::floor(std::log2(perStep) + 0.01)) : 0;
        return std::min(level, image_.levelCount() - 1);
    }

    /// Opacity minus threshold at weights of the second and third corner.
    float excess(const glm::dvec2& w, int level) const {
        const double first = std::max(0.0, 1 - w.x - w.y);
        const glm::dvec2 uv =
            first * glm::dvec2(uv_[0]) + w.x * glm::dvec2(uv_[1]) + w.y * glm::dvec2(uv_[2]);
        return image_.sample(Vec2(uv), level) - mask_.threshold;
    }

    /// Cuts with `count` steps along an edge; false if the outcome is too complicated for that.
    bool tryCut(int count, Cut& result) const {
        std::array<glm::dvec2, 3> shape = shape_;
        for (glm::dvec2& p : shape) p *= count;
        const int level = levelOf(count);
        const auto part =
            solidPart([&](const glm::dvec2& w) { return excess(w, level); }, count, shape);
        if (!part) return false;
        result.cover = part->cover;
        if (part->cover != MaskCover::mixed) return true;
        if (part->outlines.empty()) result.cover = MaskCover::none;
        for (double tolerance = kTolerance; tolerance > 1e-3; tolerance /= 4)
            if (triangulate(part->outlines, tolerance, result)) return true;
        return triangulate(part->outlines, 0, result);
    }

    static bool triangulate(const std::vector<Outline>& outlines, double tolerance, Cut& result) {
        std::vector<Ring> rings;
        result.points.clear();
        for (const Outline& outline : outlines) {
            const Outline simple = simplified(outline, tolerance);
            if (simple.size() < 3) return false;
            result.points.insert(result.points.end(), simple.begin(), simple.end());
            Ring& ring = rings.emplace_back();
            for (const OutlinePoint& p : simple) ring.push_back(p.place);
        }
        if (result.points.size() > kMaxRegionCorners || !areSimple(rings)) return false;
        auto triangles = triangulateRegion(rings);
        if (!triangles) return false;
        result.triangles = std::move(*triangles);
        return true;
    }

    OrderedTriangle corners_;
    AlphaMask mask_;
    const AlphaImage& image_;
    std::array<Vec2, 3> uv_;
    std::array<glm::dvec2, 3> shape_;  ///< the longest edge is 1
    bool hasArea_ = false;
};

/// Weights of the three corners; exactly 0 on the edge opposite.
glm::dvec3 weightsOf(const OutlinePoint& p) {
    const double first = (p.sides & 2u) ? 0 : 1 - p.weights.x - p.weights.y;
    return {first, p.weights};
}

/// Puts the pieces of cut triangles into a scene.
class PieceWriter {
  public:
    PieceWriter(Scene& scene, const MaskedTriangle& source, std::uint32_t material)
        : scene_(scene), source_(source), material_(material) {}

    void write(const Cut& cut, std::vector<Triangle>& triangles) {
        std::vector<std::uint32_t> vertices;
        for (const OutlinePoint& p : cut.points) vertices.push_back(vertexOf(weightsOf(p)));
        for (const auto& t : cut.triangles) {
            Triangle triangle{{vertices[t[0]], vertices[t[1]], vertices[t[2]]}, material_};
            if (source_.isFlipped()) std::swap(triangle.vertex[1], triangle.vertex[2]);
            triangles.push_back(triangle);
        }
    }

  private:
    std::uint32_t vertexOf(const glm::dvec3& w) {
        const auto& corners = source_.vertices();
        for (int k = 0; k < 3; ++k)
            if (w[k] == 1) return corners[k];
        const auto mix = [&](const auto& values) {
            glm::dvec3 sum(0);
            for (int k = 0; k < 3; ++k)
                for (int c = 0; c < values[corners[k]].length(); ++c)
                    sum[c] += w[k] * static_cast<double>(values[corners[k]][c]);
            return sum;
        };
        const Vec3 position(mix(scene_.positions)), normal(mix(scene_.normals));
        const Vec2 uv(mix(scene_.uvs));
        scene_.positions.push_back(position);
        scene_.normals.push_back(normal);
        scene_.uvs.push_back(uv);
        return static_cast<std::uint32_t>(scene_.positions.size()) - 1;
    }

    Scene& scene_;
    const MaskedTriangle& source_;
    std::uint32_t material_;
};

class MaskCutter {
  public:
    MaskCutter(Scene& scene, const MaskedMaterials& masked, const MaskLimits& limits)
        : scene_(scene), masked_(masked), limits_(limits) {
        for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
            if (masked.masks.contains(scene.triangles[t].material)) indices_.push_back(t);
    }

    /// Finds the cuts, as fine as the limits allow.
    void cut() {
        while (sampleCount() > static_cast<double>(limits_.mostSamples) && !isCoarsest())
            ++halvings_;
        for (;; ++halvings_) {
            cuts_.assign(indices_.size(), {});
            parallelFor(indices_.size(), 4, [&](std::size_t i) {
                cuts_[i] = MaskedTriangle(scene_, masked_, indices_[i]).cut(halvings_, limits_);
            });
            if (pieceCount() <= limits_.mostTriangles + indices_.size() || isCoarsest()) return;
        }
    }

    void replaceTriangles() {
        std::vector<Triangle> triangles;
        std::size_t next = 0;
        for (Mesh& mesh : scene_.meshes) {
            const auto first = static_cast<std::uint32_t>(triangles.size());
            for (std::uint32_t k = 0; k < mesh.triangleCount; ++k)
                next += addTriangle(mesh.firstTriangle + k, next, triangles);
            mesh.firstTriangle = first;
            mesh.triangleCount = static_cast<std::uint32_t>(triangles.size()) - first;
        }
        scene_.triangles = std::move(triangles);
    }

    std::size_t count(MaskCover cover) const {
        return static_cast<std::size_t>(std::count_if(
            cuts_.begin(), cuts_.end(), [&](const Cut& c) { return c.cover == cover; }));
    }
    std::size_t pieceCount() const {
        std::size_t sum = 0;
        for (const Cut& c : cuts_) sum += c.triangles.size();
        return sum;
    }
    std::size_t coarsenedCount() const {
        return static_cast<std::size_t>(
            std::count_if(cuts_.begin(), cuts_.end(), [](const Cut& c) { return c.coarsened; }));
    }

  private:
    double sampleCount() const {
        double sum = 0;
        for (const std::uint32_t t : indices_) {
            const double n = MaskedTriangle(scene_, masked_, t).steps(halvings_, limits_);
            sum += 0.5 * (n + 1) * (n + 2);
        }
        return sum;
    }

    /// Whether no triangle has more than one step, and three samples.
    bool isCoarsest() const { return sampleCount() <= 3.0 * static_cast<double>(indices_.size()); }

    /// Adds triangle t or its pieces; true if it is the masked triangle number `next`.
    bool addTriangle(std::uint32_t t, std::size_t next, std::vector<Triangle>& triangles) {
        const bool isMasked = next < indices_.size() && indices_[next] == t;
        if (!isMasked || cuts_[next].cover == MaskCover::solid)
            triangles.push_back(scene_.triangles[t]);
        else if (cuts_[next].cover == MaskCover::mixed) {
            const MaskedTriangle source(scene_, masked_, t);
            PieceWriter(scene_, source, scene_.triangles[t].material).write(cuts_[next], triangles);
        }
        return isMasked;
    }

    Scene& scene_;
    const MaskedMaterials& masked_;
    MaskLimits limits_;
    std::vector<std::uint32_t> indices_;  ///< of masked triangles
    std::vector<Cut> cuts_;               ///< theirs
    int halvings_ = 0;
};

}  // namespace

void cutMasks(Scene& scene, const MaskedMaterials& masked, const std::string& file,
              ImportReport& report, const MaskLimits& limits) {
    if (masked.masks.empty()) return;
    scene.normals.resize(scene.positions.size(), Vec3(0));
    scene.uvs.resize(scene.positions.size(), Vec2(0));
    MaskCutter cutter(scene, masked, limits);
    cutter.cut();
    const std::size_t vanished = cutter.count(MaskCover::none),
                      cut = cutter.count(MaskCover::mixed);
    if (vanished + cut == 0) return;
    cutter.replaceTriangles();
    const SourceLocation where{file, 0, ""};
    warn(report, where,
         fmt::format("alpha masks: {} triangles are cut into {}, {} are transparent and left out",
                     cut, cutter.pieceCount(), vanished));
    if (const std::size_t coarse = cutter.coarsenedCount())
        warn(report, where,
             fmt::format("alpha masks of {} triangles have more detail than is cut; small holes "
                         "are missing, use smaller masks",
                         coarse));
    checkTriangleCount(scene.triangles.size(), file);
}

}  // namespace vlf
