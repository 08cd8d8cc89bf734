#include "vlf/render/drawing/direction_ball.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vlf {

namespace {

/// Of the triangles along a quarter of the equator: enough for a round outline.
constexpr int kMostAlongQuarter = 32;

/// Adds a triangle of the direction set as parts² smaller ones.
class BallMaker {
  public:
    BallMaker(const DirectionSet& set, int parts) : set_(set), parts_(parts) {}

    void add(std::array<std::uint32_t, 3> corner) {
        const Vec3 a = set_.direction(corner[0]), b = set_.direction(corner[1]),
                   c = set_.direction(corner[2]);
        if (glm::dot(a, glm::cross(b, c)) < 0) std::swap(corner[1], corner[2]);
        for (int i = 0; i < parts_; ++i)
            for (int j = 0; i + j < parts_; ++j) {
                addPart(corner, {i, j}, {i + 1, j}, {i, j + 1});
                if (i + j + 1 < parts_) addPart(corner, {i + 1, j}, {i + 1, j + 1}, {i, j + 1});
            }
    }

    std::vector<BallVertex> take() { return std::move(vertices_); }

  private:
    /// Steps from the first corner towards the second and third.
    using Place = std::array<int, 2>;

    void addPart(const std::array<std::uint32_t, 3>& corner, const Place& a, const Place& b,
                 const Place& c) {
        for (const Place& p : {a, b, c}) {
            const Vec3 w = Vec3(parts_ - p[0] - p[1], p[0], p[1]) / static_cast<float>(parts_);
            const Vec3 sum = w.x * set_.direction(corner[0]) + w.y * set_.direction(corner[1]) +
                             w.z * set_.direction(corner[2]);
            vertices_.push_back({glm::normalize(sum), Vec2(w), corner});
        }
    }

    const DirectionSet& set_;
    int parts_;
    std::vector<BallVertex> vertices_;
};

/// The direction at grid coordinates: `turns` in quarters of a turn, see field/direction_set.h.
Vec3 directionAt(float ring, float rings, float turns) {
    const float r = ring / rings, horizontal = r * std::sqrt(2 - r * r);
    const float phi = 0.5f * kPi * turns;
    return {horizontal * std::cos(phi), 1 - r * r, horizontal * std::sin(phi)};
}

}  // namespace

Sphere ballBefore(const Camera& camera, int width, int height, float distance) {
    const float tangent = std::tan(0.5f * camera.verticalFov * (kPi / 180)) *
                          std::min(1.0f, static_cast<float>(width) / static_cast<float>(height));
    const float sine = std::sin(std::atan(0.75f * tangent));
    return {camera.eye + distance * glm::normalize(camera.look - camera.eye), distance * sine};
}

Vec3 weightColor(float relativeToMean) {
    const float t = std::clamp((relativeToMean - 1) / 0.1f, -1.0f, 1.0f);
    const Vec3 end = t < 0 ? Vec3(0.03f, 0.14f, 0.6f) : Vec3(0.6f, 0.05f, 0.03f);
    return glm::mix(Vec3(0.85f), end, std::abs(t));
}

Vec3 directionColor(const DirectionSet& set, const Vec3& d) {
    const float mean = 4 * kPi / static_cast<float>(set.directionCount());
    const std::uint32_t nearest = set.nearest(d);
    const float offCentre = glm::distance(d, set.direction(nearest)) / std::sqrt(mean);
    if (offCentre < ball::kDotRadius)
        return nearest < static_cast<std::uint32_t>(set.lineCount()) ? ball::kUpperDot
                                                                     : ball::kLowerDot;
    const Vec3 weights = set.triple(d).weight;
    const Vec3 cell = weightColor(set.weight(nearest) / mean);
    return std::min({weights.x, weights.y, weights.z}) < ball::kRimWeight ? ball::kRimShade * cell
                                                                          : cell;
}

std::vector<BallVertex> makeBall(const DirectionSet& set) {
    const int rings =
        static_cast<int>(std::lround(std::sqrt(0.5f * static_cast<float>(set.lineCount() - 1))));
    BallMaker maker(set, std::max(1, kMostAlongQuarter / rings));
    const auto add = [&](float ring, float turns) {
        const Vec3 middle = directionAt(ring, static_cast<float>(rings), turns);
        for (const float sense : {1.0f, -1.0f}) maker.add(set.triple(sense * middle).index);
    };
    for (int quarter = 0; quarter < 4; ++quarter)
        for (int row = 0; row < rings; ++row) {
            const auto side = static_cast<float>(row);
            // Each triangle of the grid is found by the place of its middle.
            const float wide = side + 2 / 3.0f, narrow = side + 1 / 3.0f;
            for (int i = 0; i <= row; ++i)
                add(wide, static_cast<float>(quarter) + (static_cast<float>(i) + 1 / 3.0f) / wide);
            for (int i = 0; i < row; ++i)
                add(narrow,
                    static_cast<float>(quarter) + (static_cast<float>(i) + 2 / 3.0f) / narrow);
        }
    return maker.take();
}

}  // namespace vlf
