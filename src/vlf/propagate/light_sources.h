#pragma once
// What direct light samples: one light per emitting chart side, the scene's punctual lights, the
// bright part of its environment, and the virtual images of them in planar mirrors (light reaching
// a diffuse surface by way of mirrors: caustics).

#include "vlf/propagate/sky_light.h"
#include "vlf/scene/scene.h"
#include "vlf/unwrap/unwrap.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace vlf {

/// x -> linear * x + translation.
struct Affine {
    Mat3 linear{1.0f};
    Vec3 translation{0};

    Vec3 point(const Vec3& p) const { return linear * p + translation; }
    Vec3 vector(const Vec3& v) const { return linear * v; }
};

/// Reflection in the plane through `point` with unit `normal`.
Affine reflection(const Vec3& point, const Vec3& normal);

/// Longest chain of mirrors an image goes by. Longer ones, and those over curved mirrors, are left
/// to the bundles.
inline constexpr int kMaxImageDepth = 2;

/// A piece of an emitting triangle; textured ones are cut small so that bright parts of the
/// texture are sampled more.
struct LightPatch {
    std::uint32_t triangle = 0;
    std::array<Vec2, 3> corners;  ///< barycentric
};

enum class LightKind {
    surface,   ///< one side of the triangles of one chart, or of a curved body of many
    punctual,  ///< of Scene::lights
    sky        ///< the bright part of the environment
};

/// A light. Of one that is infinitely far, `centre` and `radius` are a sphere far away that seems
/// as wide from anywhere in the scene. Only surfaces have patches, radiance and area.
struct Light {
    LightKind kind = LightKind::surface;
    PunctualLight punctual;
    std::vector<std::uint32_t> triangles;  ///< in ascending order
    std::vector<LightPatch> patches;
    std::vector<float> cumulativePower;  ///< luminous power up to and including patch i, W
    std::vector<float> density;          ///< of sampling a point of patch i, m⁻²
    bool front = true;                   ///< the emitting side
    bool uniform = true;                 ///< no emission texture
    bool planar = true;
    Vec3 radiance{0};        ///< mean over its area, W·m⁻²·sr⁻¹
    Vec3 normal{0};          ///< mean emitting direction
    float normalCosine = 1;  ///< of the widest angle between a normal and the mean
    Vec3 centre{0};
    float radius = 0, area = 0;  ///< of the bounding sphere, m; m²
};

/// A light as seen by way of `depth` planar mirrors; depth 0 is the light itself.
struct LightImage {
    std::uint32_t light = 0;
    int depth = 0;
    std::array<std::uint32_t, kMaxImageDepth> mirror{};  ///< charts, in order from the receiver
    Affine imageFromWorld;
    Vec3 throughput{1};  ///< product of the mirrors' mean reflectances
};

struct LightSources {
    std::vector<Light> lights;
    std::vector<LightImage> images;
    std::vector<PunctualLight> punctual;     ///< the scene's
    std::vector<std::uint8_t> planarMirror;  ///< per chart: flat, a perfect mirror
    std::vector<std::uint8_t> withinGlass;   ///< per chart: the inside of a solid of glass
    std::vector<float> mirrorOffset;         ///< per chart: of a planar mirror's plane
    std::vector<std::uint32_t> mirrorChart;  ///< chart of each atlas texel of a mirror or glass
    std::shared_ptr<const SkyLight> sky;     ///< the environment; null: there is none
    float beyond = 0;       ///< metres, from anywhere in the scene to outside of it
    int imageDepth = 0;     ///< chains of up to this many planar mirrors are in `images`
    bool allApart = false;  ///< rays over mirrors are not to look for emission at all

    /// Whether emission seen over these mirrors (charts, in order) is already in the direct light,
    /// which passes panes on its way from a light, but not from an image of one.
    bool covers(int depth, bool allPlanar, bool behindPanes = false) const {
        return allApart || (allPlanar && depth <= (behindPanes ? 0 : imageDepth));
    }

    /// What a ray over `depth` mirrors sees of the environment and direct light does not have.
    Vec3 outside(const Vec3& direction, int depth, bool allPlanar, bool behindPanes) const {
        if (!sky || allApart) return Vec3(0);
        return covers(depth, allPlanar, behindPanes) ? sky->sky.smooth(direction)
                                                     : sky->sky.radiance(direction);
    }
};

/// The image of `inner`, itself one of `light` or it, in planar mirror `chart` of a scene, whose
/// plane contains `point`; nothing if none of it is seen there.
std::optional<LightImage> imageInMirror(const Scene& scene, const Unwrap& unwrap,
                                        std::uint32_t chart, const Vec3& point, const Light& light,
                                        const LightImage& inner);

/// Refers to the scene's environment.
LightSources findLightSources(const Scene& scene, const Unwrap& unwrap);

}  // namespace vlf
