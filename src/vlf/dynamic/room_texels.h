#pragma once
// The texels of a baked room as dynamic light reads and changes them.

#include "vlf/field/light_field.h"
#include "vlf/propagate/light_sources.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"
#include "vlf/unwrap/unwrap.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vlf {

inline constexpr std::uint32_t kNoTexel = 0xffffffffu;

/// Squares of a chart's texels and those beside them: around[c][k] are the four cells about corner
/// k of cell c (k's bits: the far side along u, along v), kNone where there is none.
struct TexelLattice {
    static constexpr std::uint32_t kNone = 0xffffffffu;

    std::vector<std::array<std::array<std::uint32_t, 4>, 4>> around;
};

inline constexpr std::uint32_t kNoLight = 0xffffffffu;

/// A triangle of the room as rays meet it.
struct RoomTriangle {
    Vec3 areaVector{0};
    TriangleCharts charts;
    std::uint32_t light = kNoLight;  ///< of RoomTexels::sources that it is a part of
    bool plain = true;               ///< neither mirror nor emitter
};

/// Covered texels that lie together.
struct TexelGroup {
    Sphere bounds;                       ///< of their surface
    float area = 0;                      ///< m²
    std::uint32_t first = 0, count = 0;  ///< in RoomTexels::grouped
};

/// What does not change while objects move. Arrays are by atlas texel.
struct RoomTexels {
    static constexpr int kGroupSide = 8;  ///< texels along a group's side, at most

    Unwrap unwrap;
    LightSources sources;
    FieldFrame frame;
    std::vector<std::uint32_t> source;   ///< the covered texel of the same chart that stands for a
                                         ///< texel, itself if it is covered; kNoTexel: none
    std::vector<std::uint8_t> excluded;  ///< 1: within a solid or cut by a wall: not to be seen
    std::vector<Vec3> reflectance;       ///< diffuse, of covered texels
    std::vector<float> area;             ///< m², of covered texels
    std::vector<RoomTriangle> triangles;
    std::vector<TexelGroup> groups;
    std::vector<std::uint32_t> grouped;  ///< entries of unwrap.texels
    std::vector<std::uint32_t> groupOf;  ///< of covered texels
    std::vector<std::uint32_t> blockOf;  ///< likewise: quarters of groups
    std::vector<float> blockArea;        ///< m²
    std::vector<std::uint8_t> placeOf;   ///< in the group: three bits of u, three of v
    TexelLattice groupLattice, blockLattice;
    Vec3 meanReflectance{0};             ///< diffuse, over all area
    float totalArea = 0;                 ///< m²
    std::vector<std::uint32_t> entryOf;  ///< of unwrap.texels, of covered texels

    /// All light after any number of further bounces by that of the first: a geometric series,
    /// between surfaces of the mean reflectance.
    Vec3 gain() const { return 1.0f / glm::max(Vec3(0.05f), Vec3(1) - meanReflectance); }
};

/// Throws InputError if the field is not of the scene.
RoomTexels makeRoomTexels(const Scene& scene, const RayScene& rays, const LightField& field);

}  // namespace vlf
