#include "vlf/scene/import/polygon.h"

namespace vlf {

namespace {

using Point = glm::dvec2;

/// Twice the signed area of a triangle: positive if counter-clockwise.
double turn(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The polygon seen along the largest component of its area vector, counter-clockwise.
std::vector<Point> project(std::span<const Vec3> corners) {
    const glm::dvec3 n = polygonAreaVector(corners);
    const glm::dvec3 size = glm::abs(n);
    const int w = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    int u = (w + 1) % 3, v = (w + 2) % 3;
    if (n[w] < 0) std::swap(u, v);
    std::vector<Point> points;
    points.reserve(corners.size());
    for (const Vec3& c : corners) points.emplace_back(c[u], c[v]);
    return points;
}

/// What is left of a polygon while its ears are cut off: a ring of corners.
class EarClipper {
  public:
    explicit EarClipper(std::vector<Point> points) : points_(std::move(points)) {
        const int n = static_cast<int>(points_.size());
        for (int i = 0; i < n; ++i) {
            previous_.push_back((i + n - 1) % n);
            next_.push_back((i + 1) % n);
        }
        remaining_ = n;
        for (int i = 0; i < n; ++i) ear_.push_back(isEar(i));
    }

    std::vector<std::array<int, 3>> run() {
        std::vector<std::array<int, 3>> triangles;
        int corner = 1;
        while (remaining_ > 3) {
            corner = findEar(corner);
            triangles.push_back({previous_[corner], corner, next_[corner]});
            corner = cut(corner);
        }
        triangles.push_back({previous_[corner], corner, next_[corner]});
        return triangles;
    }

  private:
    double turnAt(int i) const {
        return turn(points_[previous_[i]], points_[i], points_[next_[i]]);
    }

    /// True if cutting off corner i leaves no other reflex corner inside the cut triangle. Corners
    /// that coincide with one of the triangle's (bridges to holes) do not count.
    bool isEar(int i) const {
        const Point &a = points_[previous_[i]], &b = points_[i], &c = points_[next_[i]];
        if (turn(a, b, c) <= 0) return false;
        for (int j = next_[next_[i]]; j != previous_[i]; j = next_[j]) {
            const Point& p = points_[j];
            if (p == a || p == b || p == c || turnAt(j) > 0) continue;
            if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
        }
        return true;
    }

    /// The first ear from `start` on; of a polygon without ears (not simple, or without area) the
    /// corner that turns least the wrong way, preferably one without area.
    int findEar(int start) const {
        int i = start, flattest = start;
        for (int k = 0; k < remaining_; ++k, i = next_[i]) {
            if (ear_[i]) return i;
            if (std::abs(turnAt(i)) < std::abs(turnAt(flattest))) flattest = i;
        }
        return flattest;
    }

    /// Removes corner i and returns the one after it.
    int cut(int i) {
        const int before = previous_[i], after = next_[i];
        next_[before] = after;
        previous_[after] = before;
        --remaining_;
        ear_[before] = isEar(before);
        ear_[after] = isEar(after);
        return after;
    }

    std::vector<Point> points_;
    std::vector<int> previous_, next_;
    std::vector<char> ear_;
    int remaining_ = 0;
};

}  // namespace

glm::dvec3 polygonAreaVector(std::span<const Vec3> corners) {
    glm::dvec3 sum(0);
    const glm::dvec3 origin = corners[0];
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += glm::cross(glm::dvec3(corners[i]) - origin, glm::dvec3(corners[i + 1]) - origin);
    return sum;
}

std::vector<std::array<int, 3>> triangulatePolygon(std::span<const Vec3> corners) {
    if (corners.size() == 3) return {{0, 1, 2}};
    return EarClipper(project(corners)).run();
}

}  // namespace vlf
