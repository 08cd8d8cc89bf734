#pragma once
// Small scenes whose light is known in closed form, or that show one effect, and their answers.

#include "vlf/scene/scene.h"

#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace vlf::test {

/// Puts scenes together from flat pieces (their normals are the winding's) and spheres.
class SceneBuilder {
  public:
    std::uint32_t material(const std::string& name, const Vec3& diffuse,
                           const Vec3& emission = Vec3(0), const Vec3& mirror = Vec3(0)) {
        Material m;
        m.name = name;
        m.diffuse = diffuse;
        m.emission = emission;
        m.mirror = mirror;
        scene_.materials.push_back(m);
        return static_cast<std::uint32_t>(scene_.materials.size() - 1);
    }

    void triangle(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t material) {
        const Vec3 n = glm::normalize(glm::cross(b - a, c - a));
        begin("triangle");
        face({vertex(a, n, {0, 0}), vertex(b, n, {1, 0}), vertex(c, n, {1, 1})}, material);
    }

    /// Parallelogram origin + s u + t v; its front is the side of cross(u, v); uv = (s, t).
    void quad(const Vec3& origin, const Vec3& u, const Vec3& v, std::uint32_t material) {
        const Vec3 n = glm::normalize(glm::cross(u, v));
        begin("quad");
        const std::uint32_t a = vertex(origin, n, {0, 0}), b = vertex(origin + u, n, {1, 0});
        const std::uint32_t c = vertex(origin + u + v, n, {1, 1}),
                            d = vertex(origin + v, n, {0, 1});
        face({a, b, c}, material);
        face({a, c, d}, material);
    }

    /// Axis-aligned box; its fronts look inwards or outwards. Sides in the order -x +x -y +y -z +z.
    void box(const Vec3& lower, const Vec3& upper, bool inwards, std::uint32_t material) {
        const Vec3 size = upper - lower;
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 u(0), v(0), w(0);
            w[axis] = size[axis];
            u[(axis + 1) % 3] = size[(axis + 1) % 3];
            v[(axis + 2) % 3] = size[(axis + 2) % 3];
            if (!inwards) std::swap(u, v);
            quad(lower, u, v, material);
            quad(lower + w, v, u, material);
        }
    }

    /// Icosphere with smooth normals, of 20 · 4^levels triangles.
    void sphere(const Vec3& centre, float radius, int levels, bool inwards,
                std::uint32_t material) {
        static const int kFaces[20][3] = {
            {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
            {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
            {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
        const float g = 0.5f * (1 + std::sqrt(5.0f));
        const Vec3 corners[12] = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                  {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                  {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
        begin("sphere");
        Ball ball{centre, radius, inwards, material, {}};
        for (const auto& f : kFaces)
            subdivide(ball, glm::normalize(corners[f[0]]), glm::normalize(corners[f[1]]),
                      glm::normalize(corners[f[2]]), levels);
    }

    void camera(const std::string& name, const Vec3& eye, const Vec3& look, float verticalFov = 50,
                const Vec3& up = {0, 1, 0}) {
        scene_.cameras.push_back({name, eye, look, up, verticalFov});
    }

    Scene& scene() { return scene_; }

  private:
    struct Ball {
        Vec3 centre;
        float radius;
        bool inwards;
        std::uint32_t material;
        std::map<std::array<float, 3>, std::uint32_t> vertices;
    };

    void begin(const std::string& name) {
        scene_.meshes.push_back({name, static_cast<std::uint32_t>(scene_.triangles.size()), 0});
    }

    std::uint32_t vertex(const Vec3& position, const Vec3& normal, const Vec2& uv) {
        scene_.positions.push_back(position);
        scene_.normals.push_back(normal);
        scene_.uvs.push_back(uv);
        return static_cast<std::uint32_t>(scene_.positions.size() - 1);
    }

    void face(const std::array<std::uint32_t, 3>& vertices, std::uint32_t material) {
        scene_.triangles.push_back({vertices, material});
        ++scene_.meshes.back().triangleCount;
    }

    std::uint32_t ballVertex(Ball& ball, const Vec3& direction) {
        const auto [at, added] =
            ball.vertices.try_emplace({direction.x, direction.y, direction.z}, 0u);
        if (added)
            at->second = vertex(ball.centre + ball.radius * direction,
                                ball.inwards ? -direction : direction, Vec2(0));
        return at->second;
    }

    void subdivide(Ball& ball, const Vec3& a, const Vec3& b, const Vec3& c, int levels) {
        if (levels == 0) {
            const std::uint32_t i = ballVertex(ball, a), j = ballVertex(ball, b);
            const std::uint32_t k = ballVertex(ball, c);
            face(ball.inwards ? std::array{i, k, j} : std::array{i, j, k}, ball.material);
            return;
        }
        const Vec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c);
        const Vec3 ca = glm::normalize(c + a);
        subdivide(ball, a, ab, ca, levels - 1);
        subdivide(ball, b, bc, ab, levels - 1);
        subdivide(ball, c, ca, bc, levels - 1);
        subdivide(ball, ab, bc, ca, levels - 1);
    }

    Scene scene_;
};

/// Closed unit box, all of it emitting `emission` and reflecting `albedo`: inside, the radiance is
/// furnaceRadiance everywhere and in every direction, the irradiance π times that.
inline Scene furnaceBox(const Vec3& albedo, const Vec3& emission) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1), true, b.material("wall", albedo, emission));
    b.camera("inside", {0.3f, 0.4f, 0.2f}, {0.8f, 0.6f, 1.0f}, 80);
    return b.scene();
}

/// The same within an icosphere of radius 1 about the origin.
inline Scene furnaceSphere(const Vec3& albedo, const Vec3& emission, int levels = 2) {
    SceneBuilder b;
    b.sphere(Vec3(0), 1, levels, true, b.material("wall", albedo, emission));
    b.camera("inside", {0.2f, 0.1f, 0.3f}, {1, 0.5f, -0.2f}, 80);
    return b.scene();
}

/// The same with walls that reflect `diffuse` and `mirror`.
inline Scene furnaceMirrorBox(const Vec3& diffuse, const Vec3& mirror, const Vec3& emission) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1), true, b.material("wall", diffuse, emission, mirror));
    b.camera("inside", {0.3f, 0.4f, 0.2f}, {0.8f, 0.6f, 1.0f}, 80);
    return b.scene();
}

inline Vec3 furnaceRadiance(const Vec3& albedo, const Vec3& emission) {
    return emission / (Vec3(1) - albedo);
}

/// Two black squares of side `side`, `distance` apart, facing each other: mesh 0 below, at y = 0,
/// receives; mesh 1 above emits `radiance` downwards. Mean irradiance of the lower square:
/// π · radiance · parallelFormFactor(side / distance).
inline Scene parallelPlates(float side, float distance, float radiance) {
    SceneBuilder b;
    const std::uint32_t black = b.material("black", Vec3(0));
    const std::uint32_t lamp = b.material("lamp", Vec3(0), Vec3(radiance));
    b.quad(Vec3(0), {0, 0, side}, {side, 0, 0}, black);
    b.quad({0, distance, 0}, {side, 0, 0}, {0, 0, side}, lamp);
    return b.scene();
}

/// Two black unit squares that share the edge along x: mesh 0, the floor z in [0, 1], receives;
/// mesh 1, the wall y in [0, 1], emits `radiance` towards +z. Mean irradiance of the floor:
/// π · radiance · kPerpendicularFormFactor.
inline Scene perpendicularPlates(float radiance) {
    SceneBuilder b;
    const std::uint32_t black = b.material("black", Vec3(0));
    const std::uint32_t lamp = b.material("lamp", Vec3(0), Vec3(radiance));
    b.quad(Vec3(0), {0, 0, 1}, {1, 0, 0}, black);
    b.quad(Vec3(0), {1, 0, 0}, {0, 1, 0}, lamp);
    return b.scene();
}

/// Form factor between equal, aligned, parallel squares; x = side / distance.
/// [Howell, A Catalog of Radiation Heat Transfer Configuration Factors, C-11]
inline double parallelFormFactor(double x) {
    const double r = std::sqrt(1 + x * x), pi = std::numbers::pi;
    return 2 / (pi * x * x) *
           (0.5 * std::log(r * r * r * r / (1 + 2 * x * x)) + 2 * x * r * std::atan(x / r) -
            2 * x * std::atan(x));
}

/// Form factor between unit squares at a right angle with a common edge: configuration C-14 for
/// h = w = 1.
inline double perpendicularFormFactor() {
    const double pi = std::numbers::pi;
    return (2 * std::atan(1.0) - std::sqrt(2.0) * std::atan(1 / std::sqrt(2.0)) +
            0.25 * std::log(0.75 * 0.75 * (4.0 / 3))) /
           pi;
}

/// Form factor from a small horizontal patch to a parallel rectangle a x b at height h whose corner
/// is above the patch: configuration B-3.
inline double pointToRectangleFormFactor(double a, double b, double h) {
    const double x = a / h, y = b / h, pi = std::numbers::pi;
    const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
    return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * pi);
}

/// A room of 1 m with a red and a green wall, an open front (z = 1), a lamp (one-sided, 1 cm below
/// the ceiling) and a box on the floor. Camera "front".
inline Scene smallCornell() {
    SceneBuilder b;
    const std::uint32_t white = b.material("white", Vec3(0.73f));
    const std::uint32_t red = b.material("red", {0.63f, 0.06f, 0.05f});
    const std::uint32_t green = b.material("green", {0.12f, 0.45f, 0.09f});
    const std::uint32_t lamp = b.material("lamp", Vec3(0), {17, 12, 4});
    b.quad(Vec3(0), {0, 0, 1}, {1, 0, 0}, white);
    b.quad({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, white);
    b.quad(Vec3(0), {1, 0, 0}, {0, 1, 0}, white);
    b.quad(Vec3(0), {0, 1, 0}, {0, 0, 1}, red);
    b.quad({1, 0, 0}, {0, 0, 1}, {0, 1, 0}, green);
    b.quad({0.35f, 0.99f, 0.35f}, {0.3f, 0, 0}, {0, 0, 0.3f}, lamp);
    b.box({0.55f, 0, 0.45f}, {0.8f, 0.35f, 0.75f}, false, white);
    b.camera("front", {0.5f, 0.5f, 2.4f}, {0.5f, 0.5f, 0}, 38);
    return b.scene();
}

/// A closed white room of 2 x 2 x 2 m about the origin; the wall x = -1 is a mirror of reflectance
/// 0.9, and a lamp of radiance 5, seen directly by no ray from "to mirror", hangs on the wall
/// x = 1: |y|, |z| <= 0.25, facing -x. The camera looks at the lamp's image in the mirror, the
/// middle of the picture.
inline Scene mirrorBox() {
    SceneBuilder b;
    const std::uint32_t white = b.material("white", Vec3(0.5f));
    const std::uint32_t mirror = b.material("mirror", Vec3(0), Vec3(0), Vec3(0.9f));
    const std::uint32_t lamp = b.material("lamp", Vec3(0), Vec3(5));
    b.box(Vec3(-1), Vec3(1), true, white);
    for (int i = 0; i < 2; ++i) b.scene().triangles[i].material = mirror;
    b.quad({0.99f, -0.25f, -0.25f}, {0, 0, 0.5f}, {0, 0.5f, 0}, lamp);
    b.camera("to mirror", {0, 0, 0}, {-1, 0, 0}, 40);
    return b.scene();
}

}  // namespace vlf::test
