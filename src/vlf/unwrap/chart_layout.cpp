#include "vlf/unwrap/chart_layout.h"

#include "vlf/math/frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace vlf {

namespace {

constexpr std::size_t kMaxCandidates = 48;  // edges tried as the rectangle's direction
constexpr std::uint32_t kMaxSide = 8192;    // texels

struct Rectangle {
    Vec2 uAxis{1, 0};
    Vec2 lower{0}, upper{0};  // along uAxis and its left normal
    float area = std::numeric_limits<float>::infinity();
};

Vec2 leftOf(const Vec2& a) {
    return {-a.y, a.x};
}

Rectangle rectangleAlong(const std::vector<Vec2>& points, const Vec2& uAxis) {
    Rectangle r{uAxis, Vec2(std::numeric_limits<float>::max()),
                Vec2(std::numeric_limits<float>::lowest())};
    for (const Vec2& p : points) {
        const Vec2 q(glm::dot(uAxis, p), glm::dot(leftOf(uAxis), p));
        r.lower = glm::min(r.lower, q);
        r.upper = glm::max(r.upper, q);
    }
    const Vec2 size = r.upper - r.lower;
    r.area = size.x * size.y;
    return r;
}

/// Triangle corners in the plane, three by three.
std::vector<Vec2> project(const Scene& scene, const ChartGroup& group, const Frame& frame,
                          const Vec3& origin) {
    std::vector<Vec2> points;
    for (const std::uint32_t t : group.triangles)
        for (int c = 0; c < 3; ++c) {
            const Vec3 p = scene.position(t, c) - origin;
            points.emplace_back(glm::dot(p, frame.tangent), glm::dot(p, frame.bitangent));
        }
    return points;
}

/// Unit directions of the longest edges.
std::vector<Vec2> candidateDirections(const std::vector<Vec2>& points) {
    std::vector<Vec2> edges;
    for (std::size_t i = 0; i < points.size(); i += 3)
        for (int c = 0; c < 3; ++c) edges.push_back(points[i + (c + 1) % 3] - points[i + c]);
    const std::size_t count = std::min(edges.size(), kMaxCandidates);
    std::partial_sort(edges.begin(), edges.begin() + count, edges.end(),
                      [](const Vec2& a, const Vec2& b) { return glm::dot(a, a) > glm::dot(b, b); });
    edges.resize(count);
    std::erase_if(edges, [](const Vec2& e) { return glm::dot(e, e) <= 0; });
    for (Vec2& e : edges) e = glm::normalize(e);
    return edges.empty() ? std::vector<Vec2>{{1, 0}} : edges;
}

Rectangle smallestRectangle(const std::vector<Vec2>& points) {
    Rectangle best;
    for (const Vec2& direction : candidateDirections(points)) {
        const Rectangle r = rectangleAlong(points, direction);
        if (r.area < 0.9999f * best.area) best = r;
    }
    return best;
}

std::uint32_t texelCount(float extent, float texelSize) {
    // A hundredth of a texel more than a whole number is rounding, not another texel.
    const float count = std::ceil(extent / texelSize - 0.01f);
    return static_cast<std::uint32_t>(std::clamp(count, 1.0f, static_cast<float>(kMaxSide)));
}

}  // namespace

Chart layOutChart(const Scene& scene, const ChartGroup& group, float texelSize) {
    const Frame frame = frameFromNormal(group.axis);
    const Vec3 origin = scene.position(group.triangles[0], 0);
    const Rectangle r = smallestRectangle(project(scene, group, frame, origin));
    const Vec2 size = glm::max(r.upper - r.lower, Vec2(1e-3f * texelSize));

    Chart chart;
    chart.width = texelCount(size.x, texelSize);
    chart.height = texelCount(size.y, texelSize);
    chart.normal = group.axis;
    chart.planar = group.planar;
    chart.material = scene.triangles[group.triangles[0]].material;
    const float u = chart.width / size.x, v = chart.height / size.y;
    const Vec2 left = leftOf(r.uAxis);
    chart.uAxis = u * (r.uAxis.x * frame.tangent + r.uAxis.y * frame.bitangent);
    chart.vAxis = v * (left.x * frame.tangent + left.y * frame.bitangent);
    chart.uOffset = -u * r.lower.x - glm::dot(chart.uAxis, origin);
    chart.vOffset = -v * r.lower.y - glm::dot(chart.vAxis, origin);
    return chart;
}

Chart backOf(const Chart& chart) {
    Chart back = chart;
    back.normal = -chart.normal;
    return back;
}

}  // namespace vlf
