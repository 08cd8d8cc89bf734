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

/// Where squares (cells) of a chart's texels meet.
struct TexelLattice {
    /// The one to four cells about a corner, and their shares in what it has, by their areas: few
    /// texels at the edge of a chart know it but roughly.
    struct Corner {
        std::array<std::uint32_t, 4> cells{};
        std::array<float, 4> shares{};
        int count = 0;
    };
    std::vector<Corner> corners;
    std::vector<std::array<std::uint32_t, 4>> cornersOf;  ///< by cell; bits of the place: the far
                                                          ///< side along u, along v
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
    float area = 0;                      ///< m², of those that are not hidden
    bool open = true;                    ///< none is
    std::uint32_t first = 0, count = 0;  ///< in RoomTexels::grouped
    std::uint32_t corner = 0;            ///< atlas texel of the least u and v of the square
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
    std::vector<Vec3> place;             ///< of covered texels: a point in their middle
    std::vector<std::uint8_t> hidden;    ///< 1: in a gap narrower than a quarter of a texel, which
                                         ///< what comes to blocks and groups does not enter
    std::vector<Vec3> reflectance;       ///< diffuse, of covered texels
    std::vector<float> area;             ///< m², of covered texels
    std::vector<RoomTriangle> triangles;
    std::vector<TexelGroup> groups;
    std::vector<std::uint32_t> grouped;  ///< entries of unwrap.texels
    std::vector<std::uint32_t> groupOf;  ///< of covered texels
    std::vector<std::uint32_t> blockOf;  ///< likewise: quarters of groups
    std::vector<float> blockArea;        ///< m², like that of groups
    std::vector<Vec3> blockReflects;     ///< area by reflectance, m²
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
