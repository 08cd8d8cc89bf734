// The records of hit surfaces, read as shaders/hit_surface.glsl reads them.

#include "vlf/render/gl/hit_surfaces.h"

#include "small_rooms.h"
#include "vlf/base/error.h"
#include "vlf/render/gl/shaders/shared.h"

#include <bit>

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

using Texel = HitSurfaces::Texel;

/// The side of a triangle as the records have it.
class Reader {
  public:
    Reader(const HitSurfaces& surfaces, std::uint32_t triangle, bool front)
        : surfaces_(surfaces), side_(surfaces.records[2 * triangle + (front ? 0 : 1)]) {}

    bool black() const { return side_[3] == HitSurfaces::kNoRecord; }
    Vec3 position(std::size_t corner) const { return vector(side_[corner]); }
    Vec3 normal(std::size_t corner) const {
        const Texel& more = record(side_[corner] + 1);
        return {real(record(side_[corner])[3]), real(more[0]), real(more[1])};
    }
    Vec2 uv(std::size_t corner) const {
        const Texel& more = record(side_[corner] + 1);
        return {real(more[2]), real(more[3])};
    }
    Vec2 atlasPosition(const Vec3& p) const {
        return {glm::dot(vector(side_[3]), p) + real(record(side_[3])[3]),
                glm::dot(vector(side_[3] + 1), p) + real(record(side_[3] + 1)[3])};
    }
    const Texel& chart() const { return record(side_[3] + 2); }
    Vec3 color(std::uint32_t which) const { return vector(chart()[2] + which); }
    std::uint32_t texture(std::uint32_t which) const { return record(chart()[2] + which)[3]; }

  private:
    const Texel& record(std::uint32_t texel) const { return surfaces_.records[texel]; }
    static float real(std::uint32_t bits) { return std::bit_cast<float>(bits); }
    Vec3 vector(std::uint32_t texel) const {
        const Texel& r = record(texel);
        return {real(r[0]), real(r[1]), real(r[2])};
    }

    const HitSurfaces& surfaces_;
    Texel side_;
};

/// A room with textures, made once.
const BakedExample& office() {
    static const BakedExample room = smallRoom("office");
    return room;
}

HitSurfaces surfacesOf(const BakedExample& room) {
    return makeHitSurfaces(room.scene, room.field.charts, room.field.triangleCharts);
}

void expectTexture(const HitSurfaces& surfaces, std::uint32_t record, const Texture& texture) {
    ASSERT_LT(record, surfaces.records.size());
    const Texel& t = surfaces.records[record];
    ASSERT_EQ(t[1], static_cast<std::uint32_t>(texture.width | texture.height << 16));
    EXPECT_EQ(t[2], static_cast<std::uint32_t>(texture.wrapU));
    EXPECT_EQ(t[3], static_cast<std::uint32_t>(texture.wrapV));
    for (int y = 0; y < texture.height; y += 3)
        for (int x = 0; x < texture.width; x += 5) {
            const Vec3 pixel = texture.pixel(x, y);
            const Vec3 held = unpackRgb9e5(
                surfaces.texels[t[0] + static_cast<std::uint32_t>(y * texture.width + x)]);
            ASSERT_LE(maxComponent(glm::abs(held - pixel)), maxComponent(pixel) / 500);
        }
}

}  // namespace

TEST(HitSurfaces, HoldEachSideOfATriangle) {
    const BakedExample& room = office();
    const Scene& scene = room.scene;
    const HitSurfaces surfaces = surfacesOf(room);
    int sides = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        for (const bool front : {true, false}) {
            const TriangleCharts& charts = room.field.triangleCharts[t];
            const std::uint32_t chartIndex = front ? charts.front : charts.back;
            const Reader side(surfaces, t, front);
            ASSERT_EQ(side.black(), chartIndex == kNoChart);
            if (side.black()) continue;
            ++sides;
            const Chart& chart = room.field.charts[chartIndex];
            const Material& material = scene.material(t);
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t vertex = scene.triangles[t].vertex[i];
                ASSERT_EQ(side.position(i), scene.positions[vertex]);
                ASSERT_EQ(side.normal(i), scene.normals[vertex]);
                ASSERT_EQ(side.uv(i), scene.uvs[vertex]);
            }
            const Vec3 p = side.position(0);
            const Vec2 expected = Vec2(chart.x, chart.y) + chart.texelCoordinates(p);
            ASSERT_NEAR(glm::distance(side.atlasPosition(p), expected), 0, 1e-3f);
            ASSERT_EQ(side.chart()[0], chart.x | (chart.x + chart.width) << 16);
            ASSERT_EQ(side.chart()[1], chart.y | (chart.y + chart.height) << 16);
            ASSERT_EQ((side.chart()[3] & shared::kPlanarChart) != 0, chart.planar);
            ASSERT_EQ((side.chart()[3] & shared::kEmitsBothSides) != 0, material.emitsBothSides);
            ASSERT_EQ(side.color(0), material.diffuse);
            ASSERT_EQ(side.color(1), material.mirror);
            ASSERT_EQ(side.color(2), material.emission);
            ASSERT_EQ(side.color(3), material.transmission);
        }
    EXPECT_GT(sides, 100);
}

TEST(HitSurfaces, HoldTheTexturesInUse) {
    const BakedExample& room = office();
    const HitSurfaces surfaces = surfacesOf(room);
    int textured = 0;
    for (std::uint32_t t = 0; t < room.scene.triangles.size(); ++t) {
        const Reader side(surfaces, t, true);
        if (side.black()) continue;
        const Material& m = room.scene.material(t);
        const int textures[] = {m.diffuseTexture, m.mirrorTexture, m.emissionTexture};
        for (std::uint32_t i = 0; i < 3; ++i) {
            ASSERT_EQ(side.texture(i) == HitSurfaces::kNoRecord, textures[i] < 0);
            if (textures[i] < 0 || ++textured > 20) continue;
            expectTexture(surfaces, side.texture(i),
                          room.scene.textures[static_cast<std::size_t>(textures[i])]);
        }
    }
    EXPECT_GT(textured, 0);
}

TEST(HitSurfaces, LeaveOutTexturesOfNoMaterial) {
    Scene scene = generateScene("cornell");
    scene.textures.push_back({"unused", 64, 64, std::vector<std::uint8_t>(4 * 64 * 64), {}});
    const std::vector<TriangleCharts> none(scene.triangles.size());
    EXPECT_TRUE(makeHitSurfaces(scene, {}, none).texels.empty());
}

TEST(HitSurfaces, RefuseWhatTheirNumbersCannotHold) {
    Scene scene = generateScene("cornell");
    const std::vector<TriangleCharts> none(scene.triangles.size());
    Chart far;
    far.x = 65000;
    far.width = 1000;
    EXPECT_THROW(makeHitSurfaces(scene, {far}, none), InputError);
    scene.textures.push_back({"long", 70000, 1, std::vector<std::uint8_t>(4 * 70000), {}});
    scene.materials[0].diffuseTexture = 0;
    EXPECT_THROW(makeHitSurfaces(scene, {}, none), InputError);
}

}  // namespace vlf::test
