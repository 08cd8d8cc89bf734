#include "vlf/propagate/bundle_faces.h"

#include "vlf/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vlf {

namespace {

constexpr double kStraight = 2e-7;  // of the scene's radius: how far rounding moves a vertex

/// A corner of a chart's surface, in metres along the chart's axes and in space.
struct Corner {
    glm::dvec2 place;
    Vec3 position;
};

double cross(const Corner& a, const Corner& b, const Corner& c) {
    const glm::dvec2 ab = b.place - a.place, ac = c.place - a.place;
    return ab.x * ac.y - ab.y * ac.x;
}

/// Convex hull, counter-clockwise (A. M. Andrew 1979).
std::vector<Corner> hullOf(std::vector<Corner> corners) {
    std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
        return std::make_pair(a.place.x, a.place.y) < std::make_pair(b.place.x, b.place.y);
    });
    std::vector<Corner> hull;
    for (const bool upper : {false, true}) {
        const std::size_t first = hull.size();
        for (const Corner& c : corners) {
            while (hull.size() >= first + 2 && cross(hull[hull.size() - 2], hull.back(), c) <= 0)
                hull.pop_back();
            hull.push_back(c);
        }
        hull.pop_back();
        if (!upper) std::reverse(corners.begin(), corners.end());
    }
    return hull;
}

/// Drops corners that are less than `straight` off the line between their neighbours, the least
/// first.
void straighten(std::vector<Corner>& hull, double straight) {
    while (hull.size() > 3) {
        double least = straight;
        std::size_t dropped = hull.size();
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const Corner& before = hull[(i + hull.size() - 1) % hull.size()];
            const Corner& after = hull[(i + 1) % hull.size()];
            const double off = std::abs(cross(before, hull[i], after)) /
                               std::max(glm::distance(before.place, after.place), 1e-30);
            if (off < least) least = off, dropped = i;
        }
        if (dropped == hull.size()) return;
        hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(dropped));
    }
}

/// The fewest triangles for a flat chart's surface: if it is convex, however many the scene has, a
/// fan; else none.
std::vector<std::array<Vec3, 3>> fanOf(const Scene& scene, const Chart& chart,
                                       const std::vector<std::uint32_t>& triangles,
                                       double straight) {
    if (!chart.planar || triangles.size() <= 2) return {};
    const glm::dvec3 u = glm::normalize(glm::dvec3(chart.uAxis));
    const glm::dvec3 v = glm::normalize(glm::dvec3(chart.vAxis));
    std::vector<Corner> corners;
    double doubleArea = 0;
    for (const std::uint32_t t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 p(scene.position(t, k));
            corners.push_back({{glm::dot(u, p), glm::dot(v, p)}, scene.position(t, k)});
        }
        doubleArea += std::abs(
            cross(corners[corners.size() - 3], corners[corners.size() - 2], corners.back()));
    }
    std::vector<Corner> hull = hullOf(std::move(corners));
    straighten(hull, straight);
    std::vector<std::array<Vec3, 3>> fan;
    double covered = 0, perimeter = 0;
    for (std::size_t i = 0; i < hull.size(); ++i)
        perimeter += glm::distance(hull[i].place, hull[(i + 1) % hull.size()].place);
    for (std::size_t i = 2; i < hull.size(); ++i) {
        fan.push_back({hull[0].position, hull[i - 1].position, hull[i].position});
        covered += cross(hull[0], hull[i - 1], hull[i]);
    }
    const bool convex = std::abs(covered - doubleArea) <= 2 * straight * perimeter;
    return convex && fan.size() < triangles.size() ? fan : std::vector<std::array<Vec3, 3>>{};
}

class FaceMaker {
  public:
    FaceMaker(const Scene& scene, const Unwrap& unwrap, const FieldFrame& frame)
        : scene_(scene), unwrap_(unwrap), fans_(unwrap.charts.size()) {
        faces_.frame = frame;
        faces_.atlasWidth = unwrap.atlasWidth;
    }

    BundleFaces make() {
        findFans();
        for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
            addSide(t, unwrap_.triangleCharts[t].front, false);
            addSide(t, unwrap_.triangleCharts[t].back, true);
        }
        pad();
        return std::move(faces_);
    }

  private:
    void findFans() {
        const auto triangles = trianglesOfCharts(unwrap_);
        parallelFor(triangles.size(), 16, [&](std::size_t c) {
            if (triangles[c].empty()) return;
            fans_[c].triangles =
                fanOf(scene_, unwrap_.charts[c], triangles[c], kStraight * faces_.frame.radius);
            fans_[c].first = triangles[c].front();
        });
    }

    void addSide(std::uint32_t triangle, std::uint32_t chart, bool flipped) {
        if (chart == kNoChart) return;
        const Fan& fan = fans_[chart];
        if (fan.triangles.empty()) {
            addFace({scene_.position(triangle, 0), scene_.position(triangle, 1),
                     scene_.position(triangle, 2)},
                    chart, flipped);
        } else if (fan.first == triangle) {
            for (const auto& corners : fan.triangles) addFace(corners, chart, flipped);
        }
    }

    void addFace(const std::array<Vec3, 3>& corners, std::uint32_t chart, bool flipped) {
        const Chart& c = unwrap_.charts[chart];
        for (int k = 0; k < 3; ++k) {
            const Vec3 q = corners[k] - faces_.frame.centre;
            const Vec2 texel = c.texelCoordinates(corners[k]);
            faces_.x[k].push_back(q.x);
            faces_.y[k].push_back(q.y);
            faces_.z[k].push_back(q.z);
            faces_.u[k].push_back(texel.x);
            faces_.v[k].push_back(texel.y);
        }
        faces_.origin.push_back(c.y * unwrap_.atlasWidth + c.x);
        faces_.width.push_back(c.width);
        faces_.height.push_back(c.height);
        faces_.flags.push_back(
            (scene_.materials[c.material].isSpecular() ? BundleFaces::kMirror : 0) |
            (flipped ? BundleFaces::kFlipped : 0));
        ++faces_.count;
    }

    void pad() {
        const std::size_t size = (faces_.count + BundleFaces::kFacePadding - 1) /
                                 BundleFaces::kFacePadding * BundleFaces::kFacePadding;
        for (auto* arrays : {&faces_.x, &faces_.y, &faces_.z, &faces_.u, &faces_.v})
            for (auto& a : *arrays) a.resize(size, 0.0f);
        for (auto* a : {&faces_.origin, &faces_.width, &faces_.height, &faces_.flags})
            a->resize(size, 0);
    }

    struct Fan {
        std::vector<std::array<Vec3, 3>> triangles;
        std::uint32_t first = 0;  // triangle of the chart
    };

    const Scene& scene_;
    const Unwrap& unwrap_;
    std::vector<Fan> fans_;  // by chart
    BundleFaces faces_;
};

}  // namespace

BundleFaces makeBundleFaces(const Scene& scene, const Unwrap& unwrap, const FieldFrame& frame) {
    return FaceMaker(scene, unwrap, frame).make();
}

}  // namespace vlf
