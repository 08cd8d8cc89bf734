#pragma once
// The scene's triangles as the GPU draws them: by side, each vertex with its place in the
// irradiance atlas.

#include "vlf/field/light_field.h"
#include "vlf/render/gl/shaders/shared.h"
#include "vlf/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vlf {

struct RoomVertex {
    Vec3 position{0};
    std::array<std::int16_t, 2> geometricNormal{};  ///< octahedral, as the next; of mirrors only
    std::array<std::int16_t, 2> mirrorNormal{};     ///< about which the mirror reflects
    Vec2 uv{0};                                     ///< of textures, v downwards
    Vec2 atlasUv{0};                                ///< in [0, 1]²; as ObjectGeometry says
    std::uint32_t mirror = 0;  ///< index into RoomGeometry::mirrorCharts or roughCharts; likewise
};
static_assert(sizeof(RoomVertex) == 40);

/// Triangles of one material and side, drawn in one call.
struct RoomBatch {
    shared::MaterialData data;
    std::uint32_t material = 0;  ///< of the scene, for its textures
    bool mirror = false;         ///< a perfect one, or glass
    bool glass = false, pane = false;
    bool rough = false;  ///< a rough one
    bool cull = false;   ///< the other side is in another batch
    std::uint32_t firstIndex = 0, indexCount = 0;
};

struct RoomGeometry {
    std::vector<RoomVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<RoomBatch> batches;  ///< those of mirrors last
    std::vector<std::uint32_t> mirrorCharts, roughCharts;
    std::vector<std::uint32_t> mirrorTriangles;  ///< the scene's, in the order of mirrors' batches;
                                                 ///< data.flags.y: where a batch begins
};

/// Precondition: the field is of this scene.
RoomGeometry makeRoomGeometry(const Scene& scene, const LightField& field);

}  // namespace vlf
