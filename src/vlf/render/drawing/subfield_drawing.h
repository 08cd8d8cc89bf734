#pragma once
// Diagrams of one parallel subfield, all of it or one of its tiles, as lines through space and
// colours of charts.

#include "vlf/field/direction_set.h"
#include "vlf/field/light_field.h"
#include "vlf/render/drawing/diagram_params.h"
#include "vlf/render/drawing/pen.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

#include <array>
#include <map>
#include <vector>

namespace vlf {

namespace subfield {

enum : std::uint32_t {
    roomEdges,  ///< creases and contours of the room
    sphere,
    rays,
    rayEnds,
    tiles,
    border,  ///< of the grid of tiles
    cells,
    tileEdges,
    beam,  ///< edges of what the tile's rays sweep
    kPenCount
};

inline constexpr std::array<Pen, kPenCount> kPens{{
    {1.0f, 0.75f, 0},
    {1.0f, 0.5f, 1},
    {1.0f, 0.45f, 2},
    {5.0f, 1.0f, 3},
    {0.8f, 0.4f, 4},
    {1.6f, 1.0f, 4},
    {0.7f, 0.8f, 5},
    {2.0f, 1.0f, 6},
    {1.3f, 0.9f, 6},
}};

inline constexpr Vec3 kGridInk{0.05f, 0.2f, 0.5f}, kTileInk{0.75f, 0.12f, 0.01f},
    kRayInk{0.1f, 0.3f, 0.7f};
inline constexpr std::array<Vec3, 7> kColors{kInk,     kGridInk, kRayInk, kTileInk,
                                             kGridInk, kTileInk, kTileInk};

/// Opacities of the room as glass: charts that the tile's rays meet, within and beside its beam,
/// and all else.
inline constexpr float kSeenInBeam = 0.9f, kSeenOfChart = 0.4f, kSeenElse = 0.04f;
inline constexpr int kMaxLayers = 32;  ///< surfaces behind one another that are looked through

}  // namespace subfield

/// The part of the field that is drawn.
struct SubfieldSelection {
    std::uint32_t direction = 0;
    ParallelSubfield subfield;
    int tileSize = 1;  ///< cells
    int tileX = 0, tileY = 0;

    int tiles() const { return (subfield.cells + tileSize - 1) / tileSize; }  ///< along a side
    Vec2 tileLower() const { return Vec2(tileX, tileY) * static_cast<float>(tileSize); }  ///< cells
    Vec2 tileUpper() const {
        return glm::min(tileLower() + static_cast<float>(tileSize),
                        Vec2(static_cast<float>(subfield.cells)));
    }
    bool inTile(const Vec3& p) const;
    /// World point at cell coordinates and depth.
    Vec3 at(const Vec2& cell, float depth = 0) const;
    Ray ray(const Vec2& cell) const { return {at(cell), subfield.direction}; }
};

/// `set` is the direction set of the field's record; what `params` leaves open is chosen to show
/// well from the camera. Throws InputError if a direction or tile is not in the field, or the field
/// does not say how it was made.
SubfieldSelection selectSubfield(const LightField& field, const DirectionSet& set,
                                 const DiagramParams& params, const Camera& camera);

/// Looks along the camera's line of sight, from a little higher, at all of the field's bounding
/// sphere and the grid before it.
Camera subfieldOverview(const Camera& camera, const FieldFrame& frame, const Vec3& direction,
                        int width, int height);

/// All lines but those of the room: of kind `subfield` a ray through every tile (of every so many,
/// where there are many) up to the first surface it meets, of kind `tile` the tile's beam.
std::vector<PenLine> subfieldLines(const RayScene& rays, const FieldFrame& frame,
                                   const SubfieldSelection& selection, DiagramKind kind);

/// All surfaces along a ray, nearest first, up to kMaxLayers.
std::vector<Hit> hitsAlong(const RayScene& rays, Ray ray);

/// The charts that the rays of the selected tile meet, on either side, each in a colour.
std::map<std::uint32_t, Vec3> tileChartColors(const RayScene& rays, const LightField& field,
                                              const SubfieldSelection& selection);

}  // namespace vlf
