#pragma once
// Where objects may stand in the way of the room's lights.

#include "vlf/dynamic/object_model.h"
#include "vlf/dynamic/room_texels.h"
#include "vlf/math/pose.h"
#include "vlf/propagate/light_gatherer.h"
#include "vlf/scene/scene.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// An object that stands in the way.
struct ShadowCaster {
    const ObjectModel* model = nullptr;
    Pose pose;
    Sphere sphere;  ///< around it, in the world
};

ShadowCaster casterOf(const ObjectModel& model, const Pose& pose);

/// A planar light of a few triangles; of another it is not known where it is met.
class LightPlane {
  public:
    LightPlane() = default;
    LightPlane(const Scene& scene, const Light& light, const Affine& imageFromWorld);

    /// Whether a ray from `origin` along `way` may meet the emitting side beyond the way's end.
    bool mayBeMet(const Vec3& origin, const Vec3& way) const {
        if (triangles_.empty()) return true;
        const float height = glm::dot(normal_, origin) - offset_;
        const float descent = -glm::dot(normal_, way);
        if (descent <= 0 || height <= descent) return false;
        const Vec3 point = origin + height / descent * way;
        return std::ranges::any_of(triangles_, [&](const std::array<Edge, 3>& edges) {
            return std::ranges::all_of(
                edges, [&](const Edge& e) { return glm::dot(e.inward, point) >= e.offset; });
        });
    }

  private:
    struct Edge {
        Vec3 inward;
        float offset;
    };
    Vec3 normal_{0};
    float offset_ = 0;
    std::vector<std::array<Edge, 3>> triangles_;  ///< none: it is not known
};

/// A light or an image of it, and the objects as they stand in its way: those before mirrors, and
/// the images of those behind.
struct Obstruction {
    struct Object {
        Sphere sphere;
        std::uint32_t number = 0;
        int segment = 0;  ///< of the way from a receiver to the light: behind so many mirrors
    };

    Sphere light;
    std::vector<Sphere> pieces;  ///< of it, which cover it; none: it is small or far
    LightPlane plane;
    std::vector<Object> objects;
};

/// An object that may hide a part of an image.
struct MayHide {
    std::uint32_t image;
    const Obstruction::Object* object;
};

class Obstructions {
  public:
    /// Of no objects. What it refers to must outlive it.
    Obstructions(const Scene& scene, const RayScene& rays, const RoomTexels& room);

    void place(std::span<const ShadowCaster> objects);

    const ShadowCaster& caster(std::uint32_t number) const { return casters_[number]; }
    std::size_t casterCount() const { return casters_.size(); }

    /// The image of a place, or of a direction, behind the first `segment` mirrors of an image, and
    /// what has its image there.
    Vec3 unfold(Vec3 place, std::size_t image, int segment) const;
    Vec3 unfoldDirection(Vec3 direction, std::size_t image, int segment) const;
    Vec3 fold(Vec3 place, std::size_t image, int segment) const;
    Vec3 foldDirection(Vec3 direction, std::size_t image, int segment) const;

    /// Of image i of the room's sources.
    const Obstruction& of(std::size_t i) const { return all_[i]; }
    std::size_t size() const { return all_.size(); }

    /// Whether the receiver, or a part of it, may see the image.
    bool maySee(const LightReceiver& receiver, std::size_t image) const {
        return gatherer_.likelyEffect(receiver, room_.sources.images[image]) > 0;
    }
    /// Patches of a caster in the world.
    std::span<const SurfacePatch> patches(std::uint32_t number) const {
        return std::span(patches_).subspan(std::size_t{number} * ObjectModel::kPatches,
                                           ObjectModel::kPatches);
    }

    /// Whether it may hide a part of the image from a part of the receiver that may see it.
    bool mayHide(const LightReceiver& receiver, std::size_t image,
                 const Obstruction::Object& object) const;

    /// Whether any object may take light from a part of the receiver.
    bool mayShadow(const LightReceiver& receiver) const;

    /// All objects that may, and of which images.
    void findShadows(const LightReceiver& receiver, std::vector<MayHide>& found) const;

    /// Whether penumbrae, those found, are wider there than the receiver.
    bool areSmooth(const LightReceiver& receiver, std::span<const MayHide> shadows) const;

    /// All texels of a group.
    LightReceiver receiverOf(const TexelGroup& group) const;

  private:
    Vec3 reflectAt(std::uint32_t mirror, const Vec3& place) const;

    const RoomTexels& room_;
    LightGatherer gatherer_;
    std::vector<Obstruction> all_;
    std::vector<ShadowCaster> casters_;
    std::vector<SurfacePatch> patches_;
};

}  // namespace vlf
