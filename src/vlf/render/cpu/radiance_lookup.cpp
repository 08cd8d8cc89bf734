#include "vlf/render/cpu/radiance_lookup.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {
constexpr float kMinCosine = 1e-3f;
}

/// The mirror as one direction's subfield shows it, along the line from the eye on.
///
/// Behind the mirror the line of sight is q(s) = p - ω s, s metres from p. The subfield shows q at
/// cell coordinates cell + s · drift, at distance ratio · s from the mirror.
struct MirrorLookup::View {
    const RadianceField* radiance = nullptr;
    const TileBlock* block = nullptr;  ///< nullptr: the mirror is not seen in this direction
    float weight = 0;
    Vec2 cell{0}, drift{0};
    float ratio = 1;

    Vec2 at(float s) const { return cell + s * drift; }

    const RadianceElement* element(int x, int y) const {
        const RadianceElement* e = block ? radiance->element(*block, x, y) : nullptr;
        return e && e->distance > 0 ? e : nullptr;
    }
    const RadianceElement* nearest(const Vec2& c) const {
        return element(static_cast<int>(std::floor(c.x)), static_cast<int>(std::floor(c.y)));
    }
    /// s of the point that an element shows.
    float parameter(const RadianceElement& e) const {
        return e.distance * (radiance->maxDistance / 65535) / ratio;
    }
};

MirrorLookup::MirrorLookup(const LightField& field)
    : radiance_(field.radiance), directions_(field.radiance.lines) {
    for (int i = 0; i < directions_.lineCount(); ++i)
        subfields_.push_back(makeSubfield(field.frame, directions_.direction(i), radiance_.cells));
}

MirrorLookup::View MirrorLookup::viewOf(std::uint32_t direction, float weight,
                                        const MirrorPoint& point, const Vec3& toEye) const {
    View view;
    const Vec3& own = directions_.direction(direction);
    const float cosine = glm::dot(own, point.normal);
    if (cosine < kMinCosine) return view;
    const ParallelSubfield& subfield = subfields_[direction % subfields_.size()];
    view.radiance = &radiance_;
    view.block = radiance_.find(direction, point.chart);
    view.weight = weight;
    view.cell = subfield.cellCoordinates(point.position);
    view.drift = -Vec2(glm::dot(subfield.xAxis, toEye), glm::dot(subfield.yAxis, toEye));
    view.ratio = glm::dot(toEye, point.normal) / cosine;
    return view;
}

Vec3 MirrorLookup::mirrorRadiance(const MirrorPoint& point, const Vec3& toEye,
                                  LookupKind kind) const {
    const DirectionTriple triple = directions_.triple(toEye);
    std::array<View, 3> views;
    for (int k = 0; k < 3; ++k)
        views[k] = viewOf(triple.index[k], triple.weight[k], point, toEye);
    return kind == LookupKind::plain ? plain(views) : depthCorrected(views);
}

namespace {

/// Radiance and weight.
struct Sum {
    Vec3 radiance{0};
    float weight = 0;

    void add(const Vec3& r, float w) { radiance += w * r, weight += w; }
    Vec3 mean() const { return weight > 0 ? radiance / weight : Vec3(0); }
};

template <class Visit>
void forFourCells(const Vec2& c, Visit visit) {
    const float fx = c.x - 0.5f, fy = c.y - 0.5f;
    const int x = static_cast<int>(std::floor(fx)), y = static_cast<int>(std::floor(fy));
    const float s = fx - x, t = fy - y;
    visit(x, y, (1 - s) * (1 - t));
    visit(x + 1, y, s * (1 - t));
    visit(x, y + 1, (1 - s) * t);
    visit(x + 1, y + 1, s * t);
}

}  // namespace

Vec3 MirrorLookup::plain(const std::array<View, 3>& views) const {
    Sum sum;
    for (const View& view : views)
        forFourCells(view.cell, [&](int x, int y, float w) {
            if (const RadianceElement* e = view.element(x, y))
                sum.add(unpackRgb9e5(e->rgb9e5), w * view.weight);
        });
    return sum.mean();
}

Vec3 MirrorLookup::depthCorrected(const std::array<View, 3>& views) const {
    return plain(views);
}

}  // namespace vlf
