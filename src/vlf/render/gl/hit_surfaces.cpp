#include "vlf/render/gl/hit_surfaces.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/render/gl/shaders/shared.h"

#include <bit>
#include <limits>
#include <map>

namespace vlf {

namespace {

constexpr std::uint32_t kMostPixels = 0xffff;  // along a side

static_assert(shared::kWrapClamp == static_cast<int>(Wrap::clamp) &&
              shared::kWrapMirror == static_cast<int>(Wrap::mirror));

std::uint32_t bits(float v) {
    return std::bit_cast<std::uint32_t>(v);
}

class SurfaceMaker {
  public:
    SurfaceMaker(const Scene& scene, const std::vector<Chart>& charts,
                 const std::vector<TriangleCharts>& triangleCharts)
        : scene_(scene), charts_(charts), triangleCharts_(triangleCharts) {}

    HitSurfaces make() {
        const std::uint64_t triangles = scene_.triangles.size();
        const std::uint64_t vertices = 2 * triangles, charts = vertices + 2 * vertexCount();
        const std::uint64_t materials = charts + 3 * charts_.size();
        if (materials + 5 * scene_.materials.size() >= HitSurfaces::kNoRecord)
            throw InputError(
                "the scene is too large for traced reflections: show it in mode field");
        firstVertex_ = static_cast<std::uint32_t>(vertices);
        firstChart_ = static_cast<std::uint32_t>(charts);
        firstMaterial_ = static_cast<std::uint32_t>(materials);
        made_.records.reserve(materials + 5 * scene_.materials.size());
        addSides();
        addVertices();
        for (const Chart& chart : charts_) addChart(chart);
        addMaterials();
        return std::move(made_);
    }

  private:
    std::uint64_t vertexCount() const { return scene_.positions.size(); }

    void add(const Vec3& v, std::uint32_t last) {
        made_.records.push_back({bits(v.x), bits(v.y), bits(v.z), last});
    }

    void addSides() {
        for (std::size_t t = 0; t < scene_.triangles.size(); ++t)
            for (const std::uint32_t chart : {triangleCharts_[t].front, triangleCharts_[t].back}) {
                HitSurfaces::Texel side;
                for (std::size_t i = 0; i < 3; ++i)
                    side[i] = firstVertex_ + 2 * scene_.triangles[t].vertex[i];
                side[3] = chart == kNoChart ? HitSurfaces::kNoRecord : firstChart_ + 3 * chart;
                made_.records.push_back(side);
            }
    }

    void addVertices() {
        for (std::size_t v = 0; v < scene_.positions.size(); ++v) {
            const Vec3& n = scene_.normals[v];
            const Vec2& uv = scene_.uvs[v];
            add(scene_.positions[v], bits(n.x));
            made_.records.push_back({bits(n.y), bits(n.z), bits(uv.x), bits(uv.y)});
        }
    }

    void addChart(const Chart& chart) {
        const auto range = [](std::uint32_t first, std::uint32_t size) {
            if (first + size > kMostPixels)
                throw InputError(
                    "the irradiance atlas is too large for traced reflections: bake "
                    "it coarser");
            return first | (first + size) << 16;
        };
        std::uint32_t flags = chart.planar ? shared::kPlanarChart : 0;
        const Material& material = scene_.materials[chart.material];
        if (material.emitsBothSides) flags |= shared::kEmitsBothSides;
        if (material.isGlass()) flags |= shared::kGlassChart;
        if (material.isPane()) flags |= shared::kPaneChart;
        add(chart.uAxis, bits(chart.uOffset + static_cast<float>(chart.x)));
        add(chart.vAxis, bits(chart.vOffset + static_cast<float>(chart.y)));
        made_.records.push_back({range(chart.x, chart.width), range(chart.y, chart.height),
                                 firstMaterial_ + 4 * chart.material, flags});
    }

    void addMaterials() {
        nextTexture_ = firstMaterial_ + static_cast<std::uint32_t>(4 * scene_.materials.size());
        for (const Material& m : scene_.materials) {
            add(m.diffuse, textureRecord(m.diffuseTexture));
            add(m.mirror, textureRecord(m.mirrorTexture));
            add(m.emission, textureRecord(m.emissionTexture));
            add(m.transmission, bits(m.ior));
        }
        for (const int texture : textures_)
            addTexture(scene_.textures[static_cast<std::size_t>(texture)]);
    }

    /// Where the record of a texture will be.
    std::uint32_t textureRecord(int texture) {
        if (texture < 0) return HitSurfaces::kNoRecord;
        const auto [found, isNew] = textureRecords_.try_emplace(texture, nextTexture_);
        if (isNew) {
            textures_.push_back(texture);
            ++nextTexture_;
        }
        return found->second;
    }

    void addTexture(const Texture& texture) {
        const auto width = static_cast<std::uint32_t>(texture.width);
        const auto height = static_cast<std::uint32_t>(texture.height);
        const std::size_t first = made_.texels.size();
        const std::uint64_t count = std::uint64_t{width} * height;
        if (width > kMostPixels || height > kMostPixels ||
            first + count > std::numeric_limits<std::uint32_t>::max())
            throw InputError("texture " + texture.name +
                             " is too large for traced reflections: make it smaller");
        made_.records.push_back({static_cast<std::uint32_t>(first), width | height << 16,
                                 static_cast<std::uint32_t>(texture.wrapU),
                                 static_cast<std::uint32_t>(texture.wrapV)});
        made_.texels.resize(first + count);
        parallelFor(height, 16, [&](std::size_t y) {
            for (std::uint32_t x = 0; x < width; ++x)
                made_.texels[first + y * width + x] =
                    packRgb9e5(texture.pixel(static_cast<int>(x), static_cast<int>(y)));
        });
    }

    const Scene& scene_;
    const std::vector<Chart>& charts_;
    const std::vector<TriangleCharts>& triangleCharts_;
    std::uint32_t firstVertex_ = 0, firstChart_ = 0, firstMaterial_ = 0, nextTexture_ = 0;
    std::map<int, std::uint32_t> textureRecords_;
    std::vector<int> textures_;  ///< in the order of their records
    HitSurfaces made_;
};

}  // namespace

HitSurfaces makeHitSurfaces(const Scene& scene, const std::vector<Chart>& charts,
                            const std::vector<TriangleCharts>& triangleCharts) {
    return SurfaceMaker(scene, charts, triangleCharts).make();
}

}  // namespace vlf
