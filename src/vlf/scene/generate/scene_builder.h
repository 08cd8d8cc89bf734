#pragma once
// Assembles a Scene from simple shapes. Every shape is wound outward (rooms: inward), in metres,
// in a local frame that place() puts into the world.

#include "vlf/scene/scene.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace vlf {

using MaterialId = std::uint32_t;

/// In place of a material: the face is left out.
inline constexpr MaterialId kLeaveOut = 0xffffffffu;

/// Faces of an axis-aligned box, as bits of a set: -x, +x, -y, +y, -z, +z.
enum BoxFace : unsigned { kLeft = 1, kRight = 2, kBottom = 4, kTop = 8, kBack = 16, kFront = 32 };

/// One material for each face of a box: left, right, bottom, top, back, front.
using BoxMaterials = std::array<MaterialId, 6>;

/// Planes that cut space into cells: cell (i, j, k) lies between x[i] and x[i + 1], and so on.
struct CellGrid {
    std::vector<float> x, y, z;
};

/// Whether cell (i, j, k) belongs to the solid or the room.
using CellTest = std::function<bool(int i, int j, int k)>;

/// Material of a cell's face with this centre and outward unit normal.
using FaceMaterial = std::function<MaterialId(const Vec3& centre, const Vec3& normal)>;

/// Rigid map of the y axis to the line from `from` (the image of the origin) to `to`.
Mat4 axisFrame(const Vec3& from, const Vec3& to);

class SceneBuilder {
  public:
    MaterialId addMaterial(const std::string& name, const Vec3& diffuse,
                           const Vec3& mirror = Vec3(0));
    /// `roughness`: α of GGX.
    MaterialId addRoughMirror(const std::string& name, const Vec3& diffuse, const Vec3& mirror,
                              float roughness);
    /// Glass; see Material.
    MaterialId addGlass(const std::string& name, const Vec3& transmission, float ior, bool thin);
    /// A textured diffuse surface.
    MaterialId addMaterial(const std::string& name, Texture diffuse);
    /// A surface that emits `radiance` (W/m2/sr) on its front and reflects nothing.
    MaterialId addEmitter(const std::string& name, const Vec3& radiance);
    /// `texture` scales the radiance.
    MaterialId addEmitter(const std::string& name, const Vec3& radiance, Texture texture);

    void addCamera(const std::string& name, const Vec3& eye, const Vec3& look,
                   float verticalFov = 50);

    /// The triangles that follow belong to a mesh of this name.
    void beginMesh(const std::string& name);

    /// Puts the local origin of what follows at `origin`, turned counter-clockwise about +y.
    void place(const Vec3& origin, float degreesAboutY = 0);
    /// `worldFromLocal` must be rigid.
    void place(const Mat4& worldFromLocal) { worldFromLocal_ = worldFromLocal; }
    const Mat4& placement() const { return worldFromLocal_; }

    /// Metres that one repeat of a texture covers on boxes, rooms and cells.
    void setTextureSize(float metres) { textureSize_ = metres; }

    /// Convex polygon, counter-clockwise seen from its front. The first corner must not lie on
    /// the line through two others that are adjacent.
    void addPolygon(std::span<const Vec3> corners, MaterialId material,
                    std::span<const Vec2> uvs = {});

    /// Parallelogram or other planar quad; the texture fills it, a being its lower left corner.
    void addQuad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, MaterialId material);

    /// `omit`: a set of BoxFace.
    void addBox(const Vec3& lower, const Vec3& upper, MaterialId material, unsigned omit = 0);
    void addBox(const Vec3& lower, const Vec3& upper, const BoxMaterials& materials);

    /// The inside of a box.
    void addRoom(const Vec3& lower, const Vec3& upper, const BoxMaterials& materials);

    /// Surface of the union of the cells that are `inside`, without T-junctions.
    void addCells(const CellGrid& grid, const CellTest& inside, const FaceMaterial& material);
    void addCells(const CellGrid& grid, const CellTest& inside, MaterialId material);
    /// The same wound inward.
    void addCellRoom(const CellGrid& grid, const CellTest& inside, const FaceMaterial& material);

    /// Surface of revolution about the local +y axis through a profile of (radius, height), which
    /// has the solid on its left. Round about the axis, creased between the profile's segments.
    void addLathe(std::span<const Vec2> profile, int segments, MaterialId material);

    /// Closed ball with smooth normals.
    void addBall(const Vec3& centre, float radius, int rings, MaterialId material);

    /// Closed cylinder between the centres of its ends.
    void addCylinder(const Vec3& from, const Vec3& to, float radius, int segments,
                     MaterialId material);

    /// A surface that closes in both parameters, of 2 * nu * nv smooth triangles;
    /// position(u, v) has period 1 in both, and d/du x d/dv points outward.
    void addTorus(int nu, int nv, const std::function<Vec3(float u, float v)>& position,
                  MaterialId material);

    /// The scene so far. The builder is not used afterwards.
    Scene finish();

  private:
    std::uint32_t addVertex(const Vec3& position, const Vec3& normal, const Vec2& uv);
    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, MaterialId material);
    void addBoxFace(const Vec3& lower, const Vec3& upper, int face, MaterialId material,
                    bool inward);
    void addCellFaces(const CellGrid& grid, const CellTest& inside, const FaceMaterial& material,
                      bool inward);
    void addLatheBand(const Vec2& from, const Vec2& to, int segments, MaterialId material);
    int addTexture(Texture texture);
    void endMesh();

    Scene scene_;
    Mat4 worldFromLocal_{1.0f};
    float textureSize_ = 1;
};

}  // namespace vlf
