// A room of metal: three panels of growing roughness on the wall, coloured posts and a lamp before
// them that they reflect, and a polished floor.

#include "vlf/scene/generate/fixtures.h"
#include "vlf/scene/generate/recipes.h"

#include <string>

namespace vlf {

namespace {

constexpr float kWidth = 5, kHeight = 3, kDepth = 4;

/// Perceptual roughness, as of glTF, of the panels from left to right.
constexpr float kRoughness[] = {0.1f, 0.3f, 0.6f};

MaterialId addMetal(SceneBuilder& builder, const std::string& name, const Vec3& reflectance,
                    float roughness) {
    return builder.addRoughMirror(name, Vec3(0), reflectance, roughness * roughness);
}

void addPanels(SceneBuilder& builder) {
    builder.beginMesh("panels");
    for (int i = 0; i < 3; ++i) {
        const MaterialId metal = addMetal(builder, "metal-" + std::to_string(i + 1),
                                          {0.85f, 0.82f, 0.76f}, kRoughness[i]);
        builder.place({0.95f + 1.55f * static_cast<float>(i), 0, 0});
        builder.addBox({-0.7f, 0.35f, 0}, {0.7f, 2.55f, 0.05f}, metal, kBack);
    }
}

void addPosts(SceneBuilder& builder) {
    const Vec3 colours[] = {{0.7f, 0.15f, 0.1f}, {0.2f, 0.55f, 0.2f}, {0.15f, 0.25f, 0.65f}};
    for (int i = 0; i < 3; ++i) {
        const std::string name = "post-" + std::to_string(i + 1);
        const MaterialId paint = builder.addMaterial(name, colours[i]);
        const auto shift = static_cast<float>(i);
        builder.place({0.75f + 1.6f * shift, 0, 0.9f + 0.15f * shift}, 20 * shift);
        builder.beginMesh(name);
        builder.addBox({-0.16f, 0, -0.16f}, {0.16f, 1.5f, 0.16f}, paint, kBottom);
    }
}

}  // namespace

Scene makeGloss() {
    SceneBuilder builder;
    const MaterialId white = builder.addMaterial("white", {0.72f, 0.72f, 0.70f});
    const MaterialId warm = builder.addMaterial("warm", {0.70f, 0.50f, 0.28f});
    const MaterialId floor =
        builder.addRoughMirror("floor", {0.30f, 0.28f, 0.26f}, Vec3(0.25f), 0.15f * 0.15f);
    const MaterialId light = builder.addEmitter("light", {14, 13, 11});

    builder.beginMesh("room");
    builder.addRoom({0, 0, 0}, {kWidth, kHeight, kDepth}, {warm, warm, floor, white, white, white});
    addPanels(builder);
    addPosts(builder);
    builder.place({0.5f * kWidth, kHeight, 2.2f});
    addCeilingLight(builder, "light", 1.2f, 0.5f, light, white);

    builder.addCamera("front", {2.5f, 1.6f, 3.7f}, {2.5f, 1.25f, 0}, 62);
    builder.addCamera("along", {4.6f, 1.5f, 1.9f}, {0.9f, 1.3f, 0}, 50);
    builder.addCamera("floor", {2.5f, 1.9f, 3.6f}, {2.4f, 0.2f, 1.2f}, 60);
    return builder.finish();
}

}  // namespace vlf
