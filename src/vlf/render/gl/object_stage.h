#pragma once
// The objects of a DynamicRoom and all that they do to the pictures of its room: reflections,
// changed light and hard shadows.

#include "vlf/render/gl/changed_light.h"
#include "vlf/render/gl/hit_buffers.h"
#include "vlf/render/gl/mirror_region.h"
#include "vlf/render/gl/object_pass.h"
#include "vlf/render/gl/reflection_probes.h"
#include "vlf/render/gl/shadow_map.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace vlf::gl {

/// Refers to what it is given, which must outlive it. Draws within StateGuard.
class ObjectStage {
  public:
    /// `looksUp`: mirrors of the room may be looked up, and its atlas is as the field has it.
    ObjectStage(const Scene& scene, const LightField& field, ShaderLibrary& shaders, bool looksUp)
        : scene_(scene), field_(field), shaders_(shaders), looksUp_(looksUp) {}

    /// The room's objects and light as they are now.
    void update(const DynamicRoom& room);

    /// The light of the room is another one, or shaders are.
    void outdate() {
        probesStale_ = true;
        shadows_.outdate();
    }

    bool empty() const { return objects_.empty(); }
    /// Whether it knows what objects change of the light that is looked up.
    bool changesLookedUp() const { return change_.has_value(); }
    HitBuffers& hits() { return hits_; }
    const HitBuffers& hits() const { return hits_; }
    const ObjectPass& objects() const { return objects_; }

    /// Draws the objects in mode field or raytraced.
    void draw(const View& view, const RenderSettings& settings) const {
        objects_.draw(view, settings, !shadows_.empty());
    }

    /// hits() has a room now.
    void hitsReloaded() { objects_.hitsReloaded(); }

    /// Draws the shadow map if it has to be; `drawRoom` draws the room's triangles but lamps.
    void drawShadows(const std::function<void()>& drawRoom);

    /// Draws reflection probes if they have to be; see ReflectionProbes::DrawFace.
    void drawProbes(float nearest, const ReflectionProbes::DrawFace& drawFace);

    /// Binds what shaders with any of the defines below read.
    void bind() const;

    /// Of shaders of the room. `probed`: the picture is a face of a probe.
    void addDefines(Defines& defines, bool mirror, bool traced, bool probed) const;

    /// Where a mirror of the room shows objects, or only the light they have changed, within
    /// `part`. `alone`: there is no other plane of mirrors in the room.
    struct Regions {
        std::optional<PixelRectangle> objects, change;
    };
    Regions regions(const View& view, const MirrorPlanes& mirrors, const PixelRectangle& part,
                    bool traced, bool alone) const;

    std::uint64_t bytes() const;

  private:
    const Scene& scene_;
    const LightField& field_;
    ShaderLibrary& shaders_;
    bool looksUp_;
    HitBuffers hits_;
    ObjectPass objects_{shaders_, hits_};
    std::optional<ChangedLight> change_;  ///< once there have been objects
    ReflectionProbes probes_;
    ShadowMap shadows_;
    bool probesStale_ = true;
};

}  // namespace vlf::gl
