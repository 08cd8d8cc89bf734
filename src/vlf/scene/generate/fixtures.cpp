#include "vlf/scene/generate/fixtures.h"

#include <cmath>

namespace vlf {

namespace {

/// Centre line of the (2, 3) torus knot in the xy plane, t in [0, 1].
Vec3 knotCurve(float t) {
    constexpr float kRadius = 0.33f, kSwing = 0.14f;
    const float a = 2 * kPi * t, r = kRadius + kSwing * std::cos(3 * a);
    return {r * std::sin(2 * a), -r * std::cos(2 * a), kSwing * std::sin(3 * a)};
}

/// Point of the bumpy tube about the knot. The frame is that of its chords: the curve never
/// passes near the origin's axis, so the sum of two neighbours serves as a normal and the frame
/// closes after one turn.
Vec3 knotSurface(float u, float v) {
    constexpr float kStep = 1e-3f, kTube = 0.085f, kBump = 0.10f;
    const Vec3 before = knotCurve(u - kStep), after = knotCurve(u + kStep);
    const Vec3 tangent = glm::normalize(after - before);
    const Vec3 binormal = glm::normalize(glm::cross(tangent, after + before));
    const Vec3 normal = glm::cross(binormal, tangent);
    const float around = 2 * kPi * v;
    const float bumps = std::sin(2 * kPi * 48 * u) * std::sin(4 * around);
    const Vec3 out = std::cos(around) * normal - std::sin(around) * binormal;
    return knotCurve(u) + kTube * (1 + kBump * bumps) * out;
}

}  // namespace

void addFramedPanel(SceneBuilder& builder, const std::string& name, float width, float height,
                    float border, float depth, MaterialId panel, MaterialId frame) {
    const float w = 0.5f * width, h = 0.5f * height, z = 0.5f * depth;
    builder.beginMesh(name);
    builder.addQuad({-w, -h, z}, {w, -h, z}, {w, h, z}, {-w, h, z}, panel);
    builder.beginMesh(name + "-frame");
    builder.addCells(
        {{-w - border, -w, w, w + border}, {-h - border, -h, h, h + border}, {0, depth}},
        [](int i, int j, int) { return i != 1 || j != 1; },
        [&](const Vec3&, const Vec3& normal) { return normal.z < 0 ? kLeaveOut : frame; });
}

void addCeilingLight(SceneBuilder& builder, const std::string& name, float width, float depth,
                     MaterialId emitter, MaterialId casing) {
    constexpr float kThickness = 0.04f;
    const float x = 0.5f * width, z = 0.5f * depth, y = -kThickness;
    builder.beginMesh(name);
    builder.addBox({-x, y, -z}, {x, 0, z}, {casing, casing, emitter, kLeaveOut, casing, casing});
}

void addKnot(SceneBuilder& builder, int triangles, MaterialId material, const Vec3& centre) {
    constexpr float kLengthToGirth = 8;
    const float quads = 0.5f * static_cast<float>(triangles);
    const int nv = static_cast<int>(std::lround(std::sqrt(quads / kLengthToGirth)));
    const int nu = static_cast<int>(std::lround(quads / static_cast<float>(nv)));
    builder.addTorus(
        nu, nv, [&](float u, float v) { return knotSurface(u, v) + centre; }, material);
}

void addStatue(SceneBuilder& builder, int triangles, MaterialId material, MaterialId pin) {
    constexpr float kCentre = 0.66f, kPinTop = 0.12f;
    builder.beginMesh("statue");
    addKnot(builder, triangles, material, Vec3(0, kCentre, 0));
    builder.beginMesh("statue-pin");
    const std::array<Vec2, 3> profile{Vec2(0.02f, 0), Vec2(0.02f, kPinTop), Vec2(0, kPinTop)};
    builder.addLathe(profile, 12, pin);
}

}  // namespace vlf
