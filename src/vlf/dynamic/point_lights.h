#pragma once
// A few point lights and an ambient term that stand for a baked room's emitters and the light they
// spread: what `lights` shades with and hard shadows are cast by.

#include "vlf/dynamic/object_model.h"
#include "vlf/dynamic/room_texels.h"
#include "vlf/field/irradiance_atlas.h"
#include "vlf/math/pose.h"
#include "vlf/math/vector.h"

#include <algorithm>
#include <span>
#include <vector>

namespace vlf {

/// A small emitting plane: towards a direction at angle θ from `normal` it sends intensity · cosθ⁺;
/// in every direction the same where `normal` is zero; of a spot intensity times the cone's factor
/// (see coneFactor).
struct PointLight {
    Vec3 position{0};   ///< metres
    Vec3 intensity{0};  ///< W·sr⁻¹ along the normal
    Vec3 normal{0};
    Vec2 cone{0};      ///< of a spot: cos outer, 1 / (cos inner - cos outer); else 0
    float area = 0;    ///< m², of the emitters it stands for
    float radius = 0;  ///< metres about it that belong to these emitters and cast no shadow

    /// Part of the intensity towards a direction (unit, from the light).
    float factor(const Vec3& direction) const {
        if (normal == Vec3(0)) return 1;
        const float cosine = glm::dot(normal, direction);
        if (cone.y <= 0) return std::max(cosine, 0.0f);
        const float linear = std::clamp((cosine - cone.x) * cone.y, 0.0f, 1.0f);
        return linear * linear;
    }
};

struct PointLighting {
    std::vector<PointLight> lights;  ///< the most powerful first
    Vec3 ambient{0};                 ///< irradiance, W·m⁻²
};

/// At most `maxLights` (>= 1) lights, of the power of all emitters and punctual lights, and one
/// more for the bright part of the environment; light from infinity comes from 200 radii of the
/// room away. Punctual lights are themselves unless there are as many as `maxLights`. Of the others
/// near ones of like directions are one, those wider than a fifth of the room's radius are several
/// while there are lights to spare. The ambient term is the mean over the room of its indirect
/// irradiance: of what `atlas` has beyond the direct light, which is sampled at about a thousand
/// texels.
PointLighting estimatePointLights(const Scene& scene, const RayScene& rays, const RoomTexels& room,
                                  const IrradianceAtlas& atlas, int maxLights = 8);

/// Irradiance at the vertices of an object in this pose, `irradiance` having
/// mesh.sidedVertexCount() entries:
///
///     E = ambient + Σ I cosθ_light⁺ cosθ⁺ V / (r² + a/π),
///
/// V being 0 in the shadow of the room, `rays`. An emitter's area a makes the light of a disc right
/// along its axis at any distance.
void shadeByLights(const PointLighting& lighting, const ObjectMesh& mesh, const Pose& pose,
                   const RayScene& rays, std::span<Vec3> irradiance);

}  // namespace vlf
