#pragma once
// What a line drawing of a scene is made of, besides its edges: pens, paleness, shading normals.

#include "vlf/render/drawing/pen.h"
#include "vlf/scene/scene.h"

#include <algorithm>
#include <array>
#include <vector>

namespace vlf {

namespace wireframe {

/// Pens, each with a sheet of its own.
enum : std::uint32_t { hidden, triangleEdges, creases, normalLines, kPenCount };

inline constexpr std::array<Pen, kPenCount> kPens{{
    {1.0f, 0.16f, hidden},
    {0.9f, 0.45f, triangleEdges},
    {1.5f, 1.0f, creases},
    {1.0f, 0.9f, normalLines},
}};
inline constexpr std::array<Vec3, kPenCount> kColors{kInk, kInk, kInk, Vec3(0.8f, 0.18f, 0.02f)};

inline constexpr float kStrokeLength = 2;    ///< pixels between tests of visibility
inline constexpr float kFullStrength = 14;   ///< pixels: shorter edges of triangles are paler
inline constexpr float kFarStrength = 0.4f;  ///< of what lies at the far end of the scene
inline constexpr float kSurfaceSlack =
    5e-4f;  ///< part of the way to the eye in which nothing hides

}  // namespace wireframe

/// Lines are paler with distance, from the near to the far end of the scene.
struct DepthCue {
    float near = 0, far = 0;  ///< metres along the line of sight

    DepthCue(const Sphere& scene, const Vec3& eye) {
        const float distance = glm::distance(scene.centre, eye);
        near = std::max(distance - scene.radius, 0.0f);
        far = distance + scene.radius;
    }
    float strength(float depth) const {
        const float t = std::clamp((depth - near) / std::max(far - near, 1e-20f), 0.0f, 1.0f);
        return glm::mix(1.0f, wireframe::kFarStrength, t * t);
    }
};

/// The shading normal at the centre of every triangle, half the triangle's size long: where the
/// eye is on the other side it is to be drawn there.
std::vector<PenLine> normalLines(const Scene& scene);

}  // namespace vlf
