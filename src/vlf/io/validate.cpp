#include "vlf/io/validate.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/io/radiance_codec.h"
#include "vlf/scene/camera_view.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace vlf {

namespace {

constexpr int kMaxImageSize = 65536;

/// Reports faults of one chunk.
class Checker {
  public:
    Checker(const std::string& path, const std::string& chunk)
        : where_{path, 0, "chunk " + chunk} {}

    void operator()(bool good, std::size_t element, const char* fault) const {
        if (!good) fail("element " + std::to_string(element) + " " + fault);
    }
    void operator()(bool good, const char* fault) const {
        if (!good) fail(fault);
    }

  private:
    [[noreturn]] void fail(const std::string& fault) const {
        throw InputError(where_, fault + "; bake the scene again");
    }
    SourceLocation where_;
};

bool isFinite(const Vec2& v) {
    return std::isfinite(v.x) && std::isfinite(v.y);
}

bool isLight(const Vec3& v) {
    return isFinite(v) && v.x >= 0 && v.y >= 0 && v.z >= 0;
}

template <class T>
void checkFinite(const std::vector<T>& values, const Checker& check) {
    for (std::size_t i = 0; i < values.size(); ++i) check(isFinite(values[i]), i, "is not finite");
}

void checkTriangles(const Scene& scene, const std::string& path) {
    const Checker check(path, "triangles");
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const Triangle& t = scene.triangles[i];
        for (const std::uint32_t v : t.vertex)
            check(v < scene.positions.size(), i, "refers to a vertex that does not exist");
        check(t.material < scene.materials.size(), i, "refers to a material that does not exist");
    }
}

void checkMeshes(const Scene& scene, const std::string& path) {
    const Checker check(path, "meshes");
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        check(std::uint64_t{mesh.firstTriangle} + mesh.triangleCount <= scene.triangles.size(), i,
              "refers to a triangle that does not exist");
    }
}

void checkMaterials(const Scene& scene, const std::string& path) {
    const Checker check(path, "materials");
    const int textures = static_cast<int>(scene.textures.size());
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        check(isLight(m.diffuse) && isLight(m.mirror) && isLight(m.emission), i,
              "is not finite or negative");
        check(isLight(m.transmission) && maxComponent(m.transmission) <= 1 && m.ior >= 1 &&
                  m.ior <= kMostIor,
              i, "is glass of a transmission or index of refraction out of range");
        check(!m.isGlass() || !(maxComponent(m.diffuse) > 0 || m.isMirror() || m.isEmitter()), i,
              "is glass and something else, too");
        check(m.roughness >= 0 && m.roughness <= 1, i, "has a roughness outside 0 to 1");
        for (const int t : {m.diffuseTexture, m.mirrorTexture, m.emissionTexture})
            check(t >= -1 && t < textures, i, "refers to a texture that does not exist");
    }
}

void checkTextures(const Scene& scene, const std::string& path) {
    const Checker check(path, "textures");
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const Texture& t = scene.textures[i];
        check(
            t.width >= 1 && t.height >= 1 && t.width <= kMaxImageSize && t.height <= kMaxImageSize,
            i, "has a size outside 1 to 65536");
        check(t.wrapU <= Wrap::mirror && t.wrapV <= Wrap::mirror, i, "has an unknown wrap mode");
        const std::size_t pixels = static_cast<std::size_t>(t.width) * t.height;
        check(t.srgb8.empty() ? t.linear.size() == pixels
                              : t.srgb8.size() == 4 * pixels && t.linear.empty(),
              i, "has not as many pixels as its size says");
        checkFinite(t.linear, Checker(path, "pixels.linear"));
    }
}

void checkCameras(const Scene& scene, const std::string& path) {
    const Checker check(path, "cameras");
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const Camera& c = scene.cameras[i];
        check(isFinite(c.eye) && isFinite(c.look) && isFinite(c.up), i, "is not finite");
        check(c.verticalFov > 0 && c.verticalFov < 180, i, "has a field of view outside (0, 180)");
        check(hasView(c), i, "has no view: eye, look and up do not span a plane");
    }
}

void checkLights(const Scene& scene, const std::string& path) {
    const Checker check(path, "lights");
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const PunctualLight& l = scene.lights[i];
        check(l.kind <= PunctualKind::directional, i, "is of an unknown kind");
        check(isFinite(l.position) && isLight(l.intensity), i, "is not finite or negative");
        check(isFinite(l.direction) && std::abs(glm::length(l.direction) - 1) < 1e-3f, i,
              "has a direction that is not of length one");
        check(l.innerCone >= 0 && l.innerCone <= l.outerCone && l.outerCone <= 1.571f, i,
              "has cones that are none");
    }
}

void checkEnvironment(const Environment& e, const std::string& path) {
    const Checker check(path, "environment"), pixels(path, "sky pixels");
    check(isLight(e.radiance) && std::isfinite(e.turn), "is not finite or negative");
    check(e.picture.width >= 0 && e.picture.height >= 0 && e.picture.width <= kMaxImageSize &&
              e.picture.height <= kMaxImageSize && (e.picture.width > 0) == (e.picture.height > 0),
          "has a size outside 0 to 65536, or of one side only");
    const std::size_t count =
        static_cast<std::size_t>(e.picture.width) * static_cast<std::size_t>(e.picture.height);
    pixels(e.picture.pixels.size() == count, "has not as many pixels as its size says");
    for (std::size_t i = 0; i < count; ++i)
        pixels(isLight(e.picture.pixels[i]), i, "is not finite or negative");
}

bool isDirectionCount(int lines) {
    for (int n = 0; n <= 8; ++n)
        if (lines == 2 * (1 << 2 * n) + 1) return true;
    return false;
}

void checkTileRow(const RadianceField& radiance, std::size_t r, std::size_t charts,
                  const Checker& check) {
    const TileRow& row = radiance.rows[r];
    const int tiles = (radiance.cells + radiance.tileSize - 1) / radiance.tileSize;
    check(row.chart < charts, r, "refers to a chart that does not exist");
    check(row.tilesWide > 0, r, "is empty");
    check(row.tileX + row.tilesWide <= tiles && row.tileY < tiles, r, "lies outside its subfield");
}

/// Whether row b may follow row a within one direction.
bool follows(const TileRow& a, const TileRow& b) {
    return a.chart < b.chart || (a.chart == b.chart && a.tileY + 1 == b.tileY);
}

}  // namespace

void checkScene(const Scene& scene, const std::string& path) {
    checkFinite(scene.positions, Checker(path, "positions"));
    checkFinite(scene.normals, Checker(path, "normals"));
    checkFinite(scene.uvs, Checker(path, "uvs"));
    Checker(path, "normals")(scene.normals.size() == scene.positions.size(), "has a wrong length");
    Checker(path, "uvs")(scene.uvs.size() == scene.positions.size(), "has a wrong length");
    checkTriangles(scene, path);
    checkMeshes(scene, path);
    checkMaterials(scene, path);
    checkTextures(scene, path);
    checkCameras(scene, path);
    checkLights(scene, path);
    checkEnvironment(scene.environment, path);
}

void checkCharts(const LightField& field, const Scene& scene, const std::string& path) {
    const Checker check(path, "charts"), checkSides(path, "triangle charts");
    for (std::size_t i = 0; i < field.charts.size(); ++i) {
        const Chart& c = field.charts[i];
        check(isFinite(c.uAxis) && isFinite(c.vAxis) && isFinite(c.normal) &&
                  std::isfinite(c.uOffset) && std::isfinite(c.vOffset),
              i, "is not finite");
        const auto inside = [](std::uint64_t first, std::uint64_t size, std::uint64_t all) {
            return size > 0 && first >= kGutter && first + size + kGutter <= all;
        };
        check(inside(c.x, c.width, field.atlas.width) && inside(c.y, c.height, field.atlas.height),
              i, "lies outside the atlas");
        check(c.material < scene.materials.size(), i, "refers to a material that does not exist");
    }
    checkSides(field.triangleCharts.size() == scene.triangles.size(), "has a wrong length");
    const auto exists = [&](std::uint32_t c) { return c == kNoChart || c < field.charts.size(); };
    for (std::size_t i = 0; i < field.triangleCharts.size(); ++i)
        checkSides(exists(field.triangleCharts[i].front) && exists(field.triangleCharts[i].back), i,
                   "refers to a chart that does not exist");
}

void checkAtlas(const IrradianceAtlas& atlas, const std::string& path) {
    const Checker check(path, "irradiance");
    check(atlas.width <= kMaxImageSize && atlas.height <= kMaxImageSize,
          "is wider or higher than 65536 texels");
    check(atlas.irradiance.size() == std::size_t{atlas.width} * atlas.height,
          "has a wrong number of texels");
    parallelFor(atlas.height, 64, [&](std::size_t y) {
        for (std::size_t i = y * atlas.width; i < (y + 1) * atlas.width; ++i)
            check(isLight(atlas.irradiance[i]), i, "is not finite or negative");
    });
}

void checkBakeRecord(const BakeRecord& record, const std::string& path) {
    const EnergyReport& e = record.energy;
    Checker(path, "bake")(std::isfinite(record.texelSize) && std::isfinite(record.residual) &&
                              std::isfinite(record.texelError) &&
                              std::isfinite(record.interpolatedError) && isFinite(e.emitted) &&
                              isFinite(e.absorbed) && isFinite(e.unshot) && isFinite(e.escaped),
                          "has a number that is not finite");
}

void checkRadianceLayout(const RadianceField& radiance, std::size_t charts,
                         const std::string& path) {
    const Checker sizes(path, "summary"), check(path, "tile rows"), order(path, "subfields");
    if (radiance.empty()) {
        check(radiance.rows.empty() && radiance.elements.empty(), "has rows but no directions");
        return;
    }
    sizes(isDirectionCount(radiance.lines), "has a number of directions that is no direction set");
    sizes(radiance.tileSize >= 1 && radiance.tileSize <= kMaxTileSize &&
              std::has_single_bit(static_cast<unsigned>(radiance.tileSize)),
          "has a tile size that is no power of two from 1 to 256");
    sizes(radiance.cells >= 1 && radiance.cells <= 65535, "has cells outside 1 to 65535");
    sizes(std::isfinite(radiance.maxDistance) && radiance.maxDistance >= 0,
          "has a longest distance that is not finite or negative");
    const auto& first = radiance.firstRow;
    order(first.size() == 2 * static_cast<std::size_t>(radiance.lines) + 1, "has a wrong length");
    order(first.front() == 0 && first.back() == radiance.rows.size() &&
              std::is_sorted(first.begin(), first.end()),
          "does not cover the rows");
    for (std::size_t r = 0; r < radiance.rows.size(); ++r) checkTileRow(radiance, r, charts, check);
    for (std::size_t d = 0; d + 1 < first.size(); ++d)
        for (std::size_t r = first[d] + 1; r < first[d + 1]; ++r)
            check(follows(radiance.rows[r - 1], radiance.rows[r]), r, "is out of order");
}

void checkRadianceElements(const RadianceField& radiance, const std::string& path) {
    const Checker check(path, "tile rows");
    for (std::size_t r = 0; r < radiance.rows.size(); ++r) {
        const TileRow& row = radiance.rows[r];
        const std::uint64_t count = radiance.tileElements() * row.tilesWide;
        check(row.firstElement <= radiance.elements.size() &&
                  count <= radiance.elements.size() - row.firstElement,
              r, "refers to elements that do not exist");
    }
}

}  // namespace vlf
