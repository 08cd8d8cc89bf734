#pragma once
// What a room takes in the memory of the GPU, told without one.

#include "vlf/field/light_field.h"
#include "vlf/render/gl/renderer.h"
#include "vlf/render/gl/room_geometry.h"
#include "vlf/scene/scene.h"

#include <cstdint>

namespace vlf {

/// Bytes of vertices and indices.
std::uint64_t bytesOf(const RoomGeometry& room);

/// Bytes of the scene's textures with all levels of detail, and of its environment.
std::uint64_t textureBytes(const Scene& scene);

/// What a Renderer without limits takes. Precondition: the field is of this scene.
GpuMemory gpuMemoryOf(const Scene& scene, const LightField& field);

}  // namespace vlf
