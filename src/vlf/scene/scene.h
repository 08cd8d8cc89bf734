#pragma once
// The scene as imported: one indexed triangle mesh in world space (metres, right-handed, +Y up),
// its materials, textures and cameras. Plain data.

#include "vlf/math/bounds.h"
#include "vlf/math/glass.h"
#include "vlf/math/vector.h"
#include "vlf/scene/environment.h"
#include "vlf/scene/punctual_light.h"
#include "vlf/scene/texture.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace vlf {

enum class MirrorKind { perfect, rough };

/// Largest index of refraction of glass.
inline constexpr float kMostIor = 4;

/// A surface that reflects diffusely and as a mirror, perfect or rough, and may emit; or smooth
/// glass (math/glass.h), which reflects and transmits by its index of refraction alone.
/// Reflectances lie in [0, 1] and diffuse + mirror <= 1 per channel (the importers scale what
/// exceeds it); those of glass, and what it emits, are 0. Surfaces reflect on both sides; emission
/// leaves the side of the winding normal only, unless emitsBothSides.
struct Material {
    std::string name;
    Vec3 diffuse{0.8f};       ///< Lambertian reflectance, multiplied by diffuseTexture
    Vec3 mirror{0.0f};        ///< specular reflectance, multiplied by mirrorTexture
    Vec3 emission{0.0f};      ///< emitted radiance, W·m⁻²·sr⁻¹, multiplied by emissionTexture
    float roughness = 0;      ///< of the mirror: α of GGX (math/microfacet.h), [0, 1]; 0: perfect
    int diffuseTexture = -1;  ///< index into Scene::textures; -1: none
    int mirrorTexture = -1;
    int emissionTexture = -1;
    bool emitsBothSides = false;
    /// Not black: glass. The share of the light that is not reflected which passes a pane, or one
    /// surface of a solid, [0, 1].
    Vec3 transmission{0};
    float ior = 1.5f;  ///< index of refraction of glass by that of what is before it, [1, 4]
    bool thin = true;  ///< glass is a pane that rays pass straight; else a solid behind its front

    bool isGlass() const { return maxComponent(transmission) > 0; }
    bool isPane() const { return isGlass() && thin; }
    bool isSolidGlass() const { return isGlass() && !thin; }
    GlassMedium medium() const { return {ior, thin}; }

    bool isEmitter() const { return maxComponent(emission) > 0; }
    bool isMirror() const { return maxComponent(mirror) > 0; }
    bool isMirror(MirrorKind kind) const {
        return isMirror() && (roughness > 0) == (kind == MirrorKind::rough);
    }
    bool isGlossy() const { return isMirror(MirrorKind::rough); }
    bool isPureMirror() const { return isMirror() && maxComponent(diffuse) <= 0; }

    /// Whether what is seen in it depends on the direction, without a lobe (perfect) or with one.
    bool isSpecular(MirrorKind kind) const {
        return isMirror(kind) || (kind == MirrorKind::perfect && isGlass());
    }
    bool isSpecular() const { return isMirror() || isGlass(); }
};

/// One triangle: counter-clockwise vertices seen from its front, and its material.
struct Triangle {
    std::array<std::uint32_t, 3> vertex{};
    std::uint32_t material = 0;
};

/// A place on one side of a triangle. `barycentric` are the weights of its second and third vertex.
struct SidePoint {
    std::uint32_t triangle = 0;
    Vec2 barycentric{0};
    bool front = true;  ///< the side of the winding normal
};

/// A named part of the scene: a contiguous range of triangles.
struct Mesh {
    std::string name;
    std::uint32_t firstTriangle = 0, triangleCount = 0;
};

/// A pinhole camera. `verticalFov` in degrees, in (0, 180).
struct Camera {
    std::string name;
    Vec3 eye{0, 0, 0}, look{0, 0, -1}, up{0, 1, 0};
    float verticalFov = 50;
    /// Where the picture's centre lies on the plane one metre before the eye: metres to the right
    /// of and above the line of sight. Of one eye of a pair; scene files do not hold it.
    Vec2 shift{0};
};

struct Scene {
    std::vector<Vec3> positions;  ///< metres
    std::vector<Vec3> normals;    ///< unit shading normals, one per position
    std::vector<Vec2> uvs;        ///< texture coordinates, one per position
    std::vector<Triangle> triangles;
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Camera> cameras;
    std::vector<PunctualLight> lights;  ///< besides emitting triangles
    Environment environment;            ///< what is seen where there is nothing

    const Vec3& position(std::uint32_t triangle, int corner) const {
        return positions[triangles[triangle].vertex[corner]];
    }
    const Material& material(std::uint32_t triangle) const {
        return materials[triangles[triangle].material];
    }
};

/// Twice-area vector of a triangle: its length is twice the area, its direction the winding normal.
Vec3 areaVector(const Scene& scene, std::uint32_t triangle);

/// Unit winding normal. Precondition: the triangle is not degenerate.
Vec3 geometricNormal(const Scene& scene, std::uint32_t triangle);

/// Area in m².
float area(const Scene& scene, std::uint32_t triangle);

/// Interpolation weights of the three vertices at barycentric (u, v) of the second and third.
Vec3 positionAt(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric);
Vec2 uvAt(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric);

/// Interpolated unit shading normal; the geometric normal where the interpolation vanishes.
Vec3 shadingNormalAt(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric);

/// Diffuse and mirror reflectance and emitted radiance (of the emitting side) with textures.
Vec3 diffuseReflectance(const Scene& scene, const Material& material, const Vec2& uv);
Vec3 mirrorReflectance(const Scene& scene, const Material& material, const Vec2& uv);
Vec3 emittedRadiance(const Scene& scene, const Material& material, const Vec2& uv);

/// Whether any triangle's material emits, or mirrors.
bool hasEmitter(const Scene& scene);

/// Whether there is any light: emitters, punctual lights or an environment.
bool hasLight(const Scene& scene);

bool hasMirror(const Scene& scene);
bool hasMirror(const Scene& scene, MirrorKind kind);

/// Whether any triangle's material is specular of this kind, or is glass, or a pane.
bool hasSpecular(const Scene& scene, MirrorKind kind);
bool hasGlass(const Scene& scene);
bool hasPane(const Scene& scene);

Bounds boundsOf(const Scene& scene);

/// Smallest sphere around the bounds' centre that holds every vertex.
struct Sphere {
    Vec3 centre{0};
    float radius = 0;
};
Sphere boundingSphere(const Scene& scene);

/// Makes rough mirrors reflect diffusely what they reflect, as far as diffuse textures allow.
/// Returns whether there were any.
bool makeGlossDiffuse(Scene& scene);

/// Leaves out triangles of glass. Returns whether there were any.
bool dropGlass(Scene& scene);

/// Appends `other` to `scene`: materials, textures and indices are renumbered. The environment
/// stays that of `scene`.
void append(Scene& scene, const Scene& other);

/// A camera that sees the whole scene from outside or, for closed rooms, from a corner inside:
/// used when a file names none.
Camera defaultCamera(const Scene& scene);

}  // namespace vlf
