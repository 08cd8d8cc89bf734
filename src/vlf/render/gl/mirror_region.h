#pragma once
// The part of a view in which mirrors can show given things: elsewhere they are as if these were
// not there.

#include "vlf/field/light_field.h"
#include "vlf/render/gl/room_geometry.h"
#include "vlf/render/gl/view.h"
#include "vlf/scene/scene.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace vlf::gl {

/// The mirrors of a batch.
struct MirrorPlanes {
    static constexpr std::size_t kMost = 8;

    std::vector<Vec4> planes;  ///< unit normal n and d, front: dot(n, p) > d
    bool anywhere = false;     ///< curved, or too many planes: they may show anything anywhere
};

MirrorPlanes mirrorPlanesOf(const Scene& scene, const LightField& field, const RoomGeometry& room,
                            const RoomBatch& batch);

/// Where on the screen the mirrors' images of things can be, within `part` of the view.
class MirrorRegion {
  public:
    MirrorRegion(const View& view, const MirrorPlanes& mirrors);

    void addSphere(const Vec4& sphere);           ///< centre, radius
    void addHull(std::span<const Vec3> corners);  ///< anything between them

    /// Nothing: nowhere.
    std::optional<PixelRectangle> within(const PixelRectangle& part) const;

  private:
    void addImage(const Vec4& plane, std::span<const Vec3> corners);

    const View& view_;
    const MirrorPlanes& mirrors_;
    bool everywhere_ = false;
    Vec2 lower_{1e30f}, upper_{-1e30f};  ///< pixels
};

}  // namespace vlf::gl
