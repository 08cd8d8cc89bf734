// A cave of 318 triangles with a pool, lit by a hole in its roof, a lava crater and a crystal.

#include "vlf/math/random.h"
#include "vlf/scene/generate/fixtures.h"
#include "vlf/scene/generate/procedural_texture.h"
#include "vlf/scene/generate/recipes.h"

namespace vlf {

namespace {

using Ring = std::vector<Vec3>;

constexpr float kLength = 1.15f, kBreadth = 0.9f;  ///< stretch of the cave along x and z

/// A horizontal ring about the y axis, counter-clockwise seen from above, that departs from a
/// circle by up to `roughness` times its radius and, in height, up to `bumps` metres.
Ring makeRing(int corners, float radius, float height, float roughness, float bumps,
              std::uint64_t seed) {
    Ring ring;
    RandomStream random(1996, seed);
    for (int i = 0; i < corners; ++i) {
        const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(corners);
        const float r = radius * (1 + roughness * (2 * random.next() - 1));
        const float y = height + bumps * (2 * random.next() - 1);
        ring.emplace_back(r * std::sin(angle), y, r * std::cos(angle));
    }
    return ring;
}

void addTriangle(SceneBuilder& builder, const Vec3& a, const Vec3& b, const Vec3& c,
                 MaterialId material) {
    builder.addPolygon(std::array<Vec3, 3>{a, b, c}, material);
}

/// Flat triangles between two rings of as many corners; they face outward when `to` is above.
void addBand(SceneBuilder& builder, const Ring& from, const Ring& to, MaterialId material) {
    for (std::size_t i = 0; i < from.size(); ++i) {
        const std::size_t next = (i + 1) % from.size();
        addTriangle(builder, from[i], from[next], to[i], material);
        addTriangle(builder, from[next], to[next], to[i], material);
    }
}

/// Flat triangles from a ring to a point, which face outward when the point is above.
void addTip(SceneBuilder& builder, const Ring& from, const Vec3& tip, MaterialId material) {
    for (std::size_t i = 0; i < from.size(); ++i)
        addTriangle(builder, from[i], from[(i + 1) % from.size()], tip, material);
}

/// A horizontal polygon with a texture over its bounds; the ring's order gives the side.
void addSheet(SceneBuilder& builder, const Ring& ring, MaterialId material) {
    Bounds bounds;
    for (const Vec3& p : ring) bounds.add(p);
    std::vector<Vec2> uvs;
    for (const Vec3& p : ring) {
        const Vec3 relative = (p - bounds.lower) / glm::max(bounds.size(), Vec3(1e-6f));
        uvs.emplace_back(relative.x, relative.z);
    }
    builder.addPolygon(ring, material, uvs);
}

/// The cave from its roof, where the sky looks in, down to the lowest point below the pool.
void addCave(SceneBuilder& builder) {
    const MaterialId rock = builder.addMaterial("rock", {0.36f, 0.29f, 0.23f});
    const MaterialId sky = builder.addEmitter("sky", {20, 22, 26}, canopyTexture());
    constexpr int kCorners = 16;
    static const std::array<Vec3, 6> kRadiusHeightBumps{
        Vec3(2.1f, 3.10f, 0.20f), Vec3(3.1f, 2.35f, 0.25f), Vec3(3.5f, 1.40f, 0.25f),
        Vec3(3.4f, 0.60f, 0.15f), Vec3(2.8f, 0.16f, 0.08f), Vec3(1.5f, -0.22f, 0.04f)};
    const auto stretch = [](Ring ring) {
        for (Vec3& p : ring) p *= Vec3(kLength, 1, kBreadth);
        return ring;
    };
    Ring above = stretch(makeRing(kCorners, 1, 3.6f, 0.03f, 0, 100));
    builder.beginMesh("cave");
    addSheet(builder, Ring(above.rbegin(), above.rend()), sky);
    for (std::size_t i = 0; i < kRadiusHeightBumps.size(); ++i) {
        const Vec3& r = kRadiusHeightBumps[i];
        const Ring below = stretch(makeRing(kCorners, r.x, r.y, 0.13f, r.z, 101 + i));
        addBand(builder, above, below, rock);
        above = below;
    }
    addTip(builder, above, {0, -0.4f, 0}, rock);
}

/// The water reaches under the rock all round.
void addPool(SceneBuilder& builder) {
    const MaterialId water = builder.addMaterial("water", {0.01f, 0.03f, 0.035f}, Vec3(0.75f));
    constexpr int kCorners = 13;
    Ring shore = makeRing(kCorners, 2.35f, -0.08f, 0.02f, 0, 7);
    for (Vec3& p : shore) p *= Vec3(kLength, 1, kBreadth);
    builder.beginMesh("pool");
    addSheet(builder, shore, water);
}

void addStalagmites(SceneBuilder& builder) {
    constexpr int kCorners = 5;
    struct Stone {
        Vec3 foot;
        float radius, height;
    };
    static const std::array<Stone, 3> kStones{{{{2.5f, -0.2f, -1.2f}, 0.42f, 1.7f},
                                               {{3.0f, -0.2f, -0.4f}, 0.34f, 1.0f},
                                               {{-0.5f, -0.2f, -2.3f}, 0.40f, 1.4f}}};
    const MaterialId limestone = builder.addMaterial("limestone", {0.62f, 0.56f, 0.46f});
    for (std::size_t i = 0; i < kStones.size(); ++i) {
        const auto& [foot, radius, height] = kStones[i];
        builder.place(foot, 40 * static_cast<float>(i));
        builder.beginMesh("stalagmite-" + std::to_string(i + 1));
        const Ring base = makeRing(kCorners, radius, 0, 0.15f, 0, 200 + i);
        const Ring middle = makeRing(kCorners, 0.5f * radius, 0.45f * height, 0.2f, 0.1f, 300 + i);
        addBand(builder, base, middle, limestone);
        addTip(builder, middle, {0.06f, height, 0.03f}, limestone);
    }
    builder.place(Vec3(0));
}

void addCrater(SceneBuilder& builder) {
    constexpr int kCorners = 6;
    const MaterialId basalt = builder.addMaterial("basalt", {0.16f, 0.14f, 0.14f});
    const MaterialId lava = builder.addEmitter("lava", {70, 36, 14}, lavaTexture());
    const Ring foot = makeRing(kCorners, 1.0f, 0, 0.08f, 0, 400);
    const Ring rim = makeRing(kCorners, 0.66f, 0.50f, 0.06f, 0.04f, 401);
    const Ring shore = makeRing(kCorners, 0.56f, 0.42f, 0, 0, 402);
    builder.place({-2.35f, -0.2f, -0.9f});
    builder.beginMesh("crater");
    addBand(builder, foot, rim, basalt);
    addBand(builder, rim, shore, basalt);
    addSheet(builder, shore, lava);
    builder.place(Vec3(0));
}

void addCrystal(SceneBuilder& builder) {
    constexpr int kCorners = 6;
    const MaterialId crystal = builder.addEmitter("crystal", {0.4f, 1.7f, 2.0f});
    const Ring girdle = makeRing(kCorners, 0.26f, 0.5f, 0.1f, 0.04f, 500);
    builder.place({1.35f, 0.02f, -1.85f}, 15);
    builder.beginMesh("crystal");
    addTip(builder, girdle, {0.07f, 1.5f, -0.05f}, crystal);
    addTip(builder, Ring(girdle.rbegin(), girdle.rend()), Vec3(0), crystal);
    builder.place(Vec3(0));
}

}  // namespace

Scene makeGrotto() {
    SceneBuilder builder;
    addCave(builder);
    addPool(builder);
    addStalagmites(builder);
    addCrater(builder);
    addCrystal(builder);
    builder.addCamera("overview", {1.5f, 1.7f, 2.0f}, {-0.45f, 0.6f, -1.2f}, 72);
    builder.addCamera("pool", {-0.6f, 0.75f, 2.3f}, {0.6f, 0.25f, -1.0f}, 65);
    builder.addCamera("roof", {2.9f, 0.8f, 0.6f}, {-0.6f, 2.2f, -0.4f}, 75);
    return builder.finish();
}

}  // namespace vlf
