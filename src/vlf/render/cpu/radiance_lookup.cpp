#include "vlf/render/cpu/radiance_lookup.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vlf {

namespace {

constexpr float kMinCosine = 1e-3f;
constexpr float kFar = std::numeric_limits<float>::max();
constexpr int kMaxSteps = 24;  // cells that a line of sight is followed over
constexpr int kMaxLayers = 3;
constexpr int kDepthSteps = 2;  // towards the mean depth of a rough mirror

// Tuned on a room with a statue before a mirror, for the PSNR against traced reflections.
constexpr float kTolerance = 5;        // cells: surfaces closer than this count as one
constexpr float kEdgeSoftness = 0.4f;  // width of the blend at an edge, in votes
constexpr float kCompression = 2;      // of the darkest sample: brighter ones count less

/// A sum of samples that does not let a lamp's edge bleed: bright samples count less, in
/// proportion, as if each had been tone-mapped before the mean and the mean mapped back (B. Karis,
/// "Tone mapping", 2013), with the darkest sample as the unit of brightness.
class CompressedMean {
  public:
    void add(const Vec3& radiance, float weight) {
        if (weight <= 0 || count_ == static_cast<int>(samples_.size())) return;
        samples_[count_++] = {radiance, weight, luminance(radiance)};
    }

    Vec3 mean() const {
        float darkest = kFar, brightest = 0;
        for (int i = 0; i < count_; ++i) {
            darkest = std::min(darkest, samples_[i].luminance);
            brightest = std::max(brightest, samples_[i].luminance);
        }
        if (brightest <= 0) return Vec3(0);
        const float unit = kCompression * std::max(darkest, brightest / 256);
        Vec3 sum(0);
        float weights = 0;
        for (int i = 0; i < count_; ++i) {
            const float w = samples_[i].weight / (unit + samples_[i].luminance);
            sum += w * samples_[i].radiance;
            weights += w;
        }
        return sum / weights;
    }

  private:
    struct Sample {
        Vec3 radiance;
        float weight, luminance;
    };
    std::array<Sample, 12> samples_;
    int count_ = 0;
};

/// Calls visit(x, y, weight) for the four cells around c, with bilinear weights.
template <class Visit>
void forFourCells(const Vec2& c, const Visit& visit) {
    const float fx = c.x - 0.5f, fy = c.y - 0.5f;
    const int x = static_cast<int>(std::floor(fx)), y = static_cast<int>(std::floor(fy));
    const float s = fx - static_cast<float>(x), t = fy - static_cast<float>(y);
    visit(x, y, (1 - s) * (1 - t));
    visit(x + 1, y, s * (1 - t));
    visit(x, y + 1, (1 - s) * t);
    visit(x + 1, y + 1, s * t);
}

}  // namespace

/// One direction's subfield along the line of sight.
///
/// Behind the mirror that line is q(s) = p - ω s, s metres from p. The subfield shows q(s) at cell
/// coordinates cell + s · drift; a cell that stores distance d shows the point with s = d / ratio
/// of a line of sight through it, for the two points are equally deep behind the mirror's plane.
class MirrorLookup::View {
  public:
    View() = default;
    View(const RadianceField& field, std::span<const TileRow> rows, const Vec2& cell,
         const Vec2& drift, float ratio, float barycentricWeight)
        : weight(barycentricWeight),
          field_(&field),
          rows_(rows),
          cell_(cell),
          drift_(drift),
          metres_(field.maxDistance / 65535 / ratio) {}

    float weight = 0;

    Vec2 at(float s) const { return cell_ + s * drift_; }

    const RadianceElement* element(int x, int y) const {
        if (rows_.empty()) return nullptr;
        const RadianceElement* e = field_->element(rows_, x, y);
        return e && e->distance > 0 ? e : nullptr;
    }

    /// s of the point that an element shows.
    float depth(const RadianceElement& e) const { return static_cast<float>(e.distance) * metres_; }

    /// s of the first surface that the line of sight meets, cells taken as flat; where it passes
    /// behind one, the depth that was seen just before. kFar where the mirror is not seen.
    float firstSurface(float tolerance) const;

  private:
    const RadianceField* field_ = nullptr;
    std::span<const TileRow> rows_;  ///< of the mirror; empty: not seen in this direction
    Vec2 cell_{0}, drift_{0};
    float metres_ = 0;  ///< of s per unit of distance
};

float MirrorLookup::View::firstSurface(float tolerance) const {
    // Cell by cell, after J. Amanatides and A. Woo, "A fast voxel traversal algorithm", 1987.
    const Vec2 start = glm::floor(cell_);
    int x = static_cast<int>(start.x), y = static_cast<int>(start.y);
    const Vec2 perCell = 1.0f / glm::max(glm::abs(drift_), Vec2(1e-9f));
    const int stepX = drift_.x > 0 ? 1 : -1, stepY = drift_.y > 0 ? 1 : -1;
    float nextX = (stepX > 0 ? start.x + 1 - cell_.x : cell_.x - start.x) * perCell.x;
    float nextY = (stepY > 0 ? start.y + 1 - cell_.y : cell_.y - start.y) * perCell.y;
    float seen = kFar;
    float in = 0;
    for (int i = 0; i < kMaxSteps; ++i) {
        const float out = std::min(nextX, nextY);
        if (const RadianceElement* e = element(x, y)) {
            const float s = depth(*e);
            if (s < in - tolerance && seen < kFar) break;
            seen = s;
            if (s < out) break;
        } else if (seen < kFar) {
            break;
        }
        in = out;
        if (nextX < nextY)
            x += stepX, nextX += perCell.x;
        else
            y += stepY, nextY += perCell.y;
    }
    return seen;
}

/// What the subfields show around the point at s of the line of sight.
struct MirrorLookup::Layer {
    Vec3 radiance{0};     ///< of the samples at that depth
    float surface = 0;    ///< weight of these
    float open = 0;       ///< weight of the samples that see through to something deeper
    float behind = kFar;  ///< least depth of those

    /// How much of the line of sight ends here; at an edge the samples vote.
    float coverage() const {
        if (surface <= 0) return 0;
        const float vote = surface / (surface + open);
        return std::clamp((vote - 0.5f) / kEdgeSoftness + 0.5f, 0.0f, 1.0f);
    }
};

MirrorLookup::MirrorLookup(const FieldFrame& frame, const RadianceField& radiance, MirrorKind kind)
    : radiance_(radiance),
      kind_(kind),
      directions_(radiance.lines),
      tolerance_(kTolerance * 2 * frame.radius / static_cast<float>(radiance.cells)) {
    for (int i = 0; i < directions_.lineCount(); ++i)
        subfields_.push_back(makeSubfield(
            frame, directions_.direction(static_cast<std::uint32_t>(i)), radiance_.cells));
}

MirrorLookup::View MirrorLookup::viewOf(std::uint32_t direction, float weight,
                                        const MirrorPoint& point, const Vec3& toEye) const {
    const float cosine = glm::dot(directions_.direction(direction), point.normal);
    if (cosine < kMinCosine) return {};
    const ParallelSubfield& subfield = subfields_[direction % subfields_.size()];
    return {radiance_,
            radiance_.rowsOf(direction, point.chart),
            subfield.cellCoordinates(point.position),
            -Vec2(glm::dot(subfield.xAxis, toEye), glm::dot(subfield.yAxis, toEye)),
            glm::dot(toEye, point.normal) / cosine,
            weight};
}

SeenInMirror MirrorLookup::see(const MirrorPoint& point, const Vec3& toEye, LookupKind kind) const {
    const DirectionTriple triple = directions_.triple(toEye);
    Views views;
    for (int k = 0; k < 3; ++k) views[k] = viewOf(triple.index[k], triple.weight[k], point, toEye);
    if (kind == LookupKind::plain) return linear(views, 0);
    return kind_ == MirrorKind::rough ? meanDepthCorrected(views) : depthCorrected(views);
}

/// Interpolated at s of the line of sight.
SeenInMirror MirrorLookup::linear(const Views& views, float s) const {
    Vec3 sum(0);
    float weights = 0, distances = 0;
    for (const View& view : views)
        forFourCells(view.at(s), [&](int x, int y, float w) {
            const RadianceElement* e = view.element(x, y);
            if (!e) return;
            sum += w * view.weight * unpackRgb9e5(e->rgb9e5());
            distances += w * view.weight * view.depth(*e);
            weights += w * view.weight;
        });
    return weights > 0 ? SeenInMirror{sum / weights, distances / weights} : SeenInMirror{};
}

SeenInMirror MirrorLookup::meanDepthCorrected(const Views& views) const {
    SeenInMirror seen = linear(views, 0);
    for (int i = 0; i < kDepthSteps; ++i) {
        const SeenInMirror next = linear(views, seen.distance);
        if (next.distance <= 0) break;
        seen = next;
    }
    return seen;
}

MirrorLookup::Layer MirrorLookup::layerAt(const Views& views, float s) const {
    Layer layer;
    CompressedMean mean;
    for (const View& view : views) {
        // Parallax is corrected: all views are nearly equally good, but fade in and out.
        const float weight = std::sqrt(std::sqrt(view.weight));
        forFourCells(view.at(s), [&](int x, int y, float w) {
            const RadianceElement* e = view.element(x, y);
            if (!e) return;
            w *= weight;
            const float depth = view.depth(*e);
            if (std::abs(depth - s) <= tolerance_) {
                mean.add(unpackRgb9e5(e->rgb9e5()), w);
                layer.surface += w;
            } else if (depth > s) {
                layer.open += w;
                layer.behind = std::min(layer.behind, depth);
            }
        });
    }
    if (layer.surface > 0) layer.radiance = mean.mean();
    return layer;
}

SeenInMirror MirrorLookup::depthCorrected(const Views& views) const {
    std::array<float, 3> depths;
    std::transform(views.begin(), views.end(), depths.begin(),
                   [&](const View& view) { return view.firstSurface(tolerance_); });
    std::sort(depths.begin(), depths.end());
    if (depths[0] == kFar) return linear(views, 0);

    CompressedMean layers;
    float left = 1;  // of the line of sight
    float s = depths[0], most = 0, distance = 0;
    for (int i = 0; i < kMaxLayers && left > 0; ++i) {
        const Layer layer = layerAt(views, s);
        const auto deeper = std::upper_bound(depths.begin(), depths.end(), s + tolerance_);
        const float next = std::min(layer.behind, deeper != depths.end() ? *deeper : kFar);
        const bool last = i == kMaxLayers - 1 || next == kFar;
        const float coverage = last && layer.surface > 0 ? 1 : layer.coverage();
        layers.add(layer.radiance, left * coverage);
        if (left * coverage > most) most = left * coverage, distance = s;
        left *= 1 - coverage;
        if (last) break;
        s = next;
    }
    return left < 1 ? SeenInMirror{layers.mean(), distance} : linear(views, 0);
}

}  // namespace vlf
