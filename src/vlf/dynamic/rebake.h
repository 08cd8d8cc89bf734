#pragma once
// A room baked again with its objects as part of it: what dynamic light is held against.

#include "vlf/base/progress.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/propagate/bake.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace vlf {

/// The parameters a field was baked with, its texel size fixed, so that the room's charts stay
/// alike. What the record does not hold is as its preset says.
BakeParams paramsOf(const BakeRecord& record);

struct RebakedRoom {
    Scene scene;  ///< posedScene: the room's triangles first
    LightField field;
};

/// Throws as bake().
RebakedRoom rebake(const DynamicRoom& room, const BakeParams& params, Progress& progress);

/// Whether a place of one side of a triangle (`front`: that of its winding normal) is within a
/// solid of the room or has something above it closer than `gap`, in metres: nobody sees its light,
/// and of two bakes each may fill it in otherwise.
bool isConcealed(const Scene& scene, const RayScene& rays,
                 std::span<const TriangleCharts> triangleCharts, std::uint32_t triangle, bool front,
                 const Vec3& position, float gap);

/// Irradiance of the room's texels with objects in it against that of the same places after
/// baking again. Left out are texels within objects, places concealed by something closer than a
/// texel is wide, and lamps: behind those that all but touch a ceiling, light is noise. All
/// relative, 0.01 = 1 %.
struct RoomLightError {
    std::size_t texels = 0;
    double relativeRmse = 0;  ///< √(Σ(E−E*)² / ΣE*²), E dynamic, E* baked again
    /// The same of the texels that the objects change, by more than kChanged of what they had or of
    /// the room's mean: √(Σ(E−E*)² / Σ(E*−E₀)²), E₀ without objects.
    std::size_t changedTexels = 0;
    double changeError = 0;
    /// √(Σ(E*−E₀)² / ΣE₀²) of the other texels: what baking again changes by itself.
    double noise = 0;

    static constexpr float kChanged = 0.02f;
};

/// `rebaked` is of posedScene of the room's objects.
RoomLightError compareRoomLight(const DynamicRoom& room, const LightField& rebaked);

}  // namespace vlf
