#pragma once
// Parts that several example scenes share. All are placed by the builder's local frame.

#include "vlf/scene/generate/scene_builder.h"

namespace vlf {

/// Triangles of a statue unless SceneOptions say otherwise, and the numbers allowed.
inline constexpr int kStatueTriangles = 10'000;
inline constexpr int kMinStatueTriangles = 1'000, kMaxStatueTriangles = 4'000'000;

/// A flat panel (picture, mirror or window) in a frame that stands `depth` out of the wall. Local
/// frame: the wall is the plane z = 0, +z points into the room, the origin is the panel's centre.
/// Starts the meshes NAME and NAME-frame.
void addFramedPanel(SceneBuilder& builder, const std::string& name, float width, float height,
                    float border, float depth, MaterialId panel, MaterialId frame);

/// A luminaire 4 cm deep that hangs from the ceiling y = 0 of the local frame and shines down.
/// Starts the mesh NAME.
void addCeilingLight(SceneBuilder& builder, const std::string& name, float width, float depth,
                     MaterialId emitter, MaterialId casing);

/// A bumpy torus knot of about `triangles`, 1.1 m high and wide.
void addKnot(SceneBuilder& builder, int triangles, MaterialId material,
             const Vec3& centre = Vec3(0));

/// A bumpy torus knot about 1.1 m high and wide on a pin, above the local origin. `triangles`
/// within a percent. Starts the meshes "statue" and "statue-pin".
void addStatue(SceneBuilder& builder, int triangles, MaterialId material, MaterialId pin);

}  // namespace vlf
