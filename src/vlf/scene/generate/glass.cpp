// A room of glass: a tinted pane on a plinth, a ball on a post, a block on the floor, and coloured
// posts behind them.

#include "vlf/scene/generate/fixtures.h"
#include "vlf/scene/generate/recipes.h"

#include <string>

namespace vlf {

namespace {

constexpr float kWidth = 4, kHeight = 2.8f, kDepth = 4;
constexpr float kIor = 1.5f;

/// A screen that stands free, so that it has an edge and no thickness.
void addPane(SceneBuilder& builder, MaterialId plinth) {
    const MaterialId pane = builder.addGlass("pane", {0.55f, 0.85f, 0.70f}, kIor, true);
    builder.place({1.0f, 0, 1.9f}, 25);
    builder.beginMesh("plinth");
    builder.addBox({-0.65f, 0, -0.08f}, {0.65f, 0.12f, 0.08f}, plinth, kBottom);
    builder.beginMesh("pane");
    builder.addQuad({-0.6f, 0.13f, 0}, {0.6f, 0.13f, 0}, {0.6f, 1.7f, 0}, {-0.6f, 1.7f, 0}, pane);
}

void addBodies(SceneBuilder& builder, MaterialId post) {
    const MaterialId clear = builder.addGlass("clear", Vec3(1), kIor, false);
    const MaterialId amber = builder.addGlass("amber", {0.98f, 0.85f, 0.55f}, kIor, false);
    builder.place({2.9f, 0, 1.9f});
    builder.beginMesh("post");
    builder.addBox({-0.2f, 0, -0.2f}, {0.2f, 0.6f, 0.2f}, post, kBottom);
    builder.beginMesh("ball");
    builder.addBall({0, 0.99f, 0}, 0.38f, 32, clear);
    builder.place({2.05f, 0, 2.6f}, 20);
    builder.beginMesh("block");
    builder.addBox({-0.25f, 0.01f, -0.15f}, {0.25f, 0.5f, 0.15f}, amber);
}

void addBars(SceneBuilder& builder) {
    const Vec3 colours[] = {{0.7f, 0.15f, 0.1f}, {0.75f, 0.6f, 0.15f}, {0.15f, 0.25f, 0.65f}};
    for (int i = 0; i < 6; ++i) {
        const std::string name = "bar-" + std::to_string(i + 1);
        const MaterialId paint = builder.addMaterial(name, colours[i % 3]);
        builder.place({0.5f + 0.6f * static_cast<float>(i), 0, 0.35f});
        builder.beginMesh(name);
        builder.addBox({-0.1f, 0, -0.1f}, {0.1f, 1.9f, 0.1f}, paint, kBottom);
    }
}

}  // namespace

Scene makeGlass() {
    SceneBuilder builder;
    const MaterialId white = builder.addMaterial("white", {0.72f, 0.72f, 0.70f});
    const MaterialId blue = builder.addMaterial("blue", {0.35f, 0.45f, 0.60f});
    const MaterialId floor = builder.addMaterial("floor", {0.45f, 0.40f, 0.35f});
    const MaterialId light = builder.addEmitter("light", {15, 14, 12});
    builder.beginMesh("room");
    builder.addRoom({0, 0, 0}, {kWidth, kHeight, kDepth},
                    {white, blue, floor, white, white, white});
    addBars(builder);
    addPane(builder, white);
    addBodies(builder, white);
    builder.place({2.0f, kHeight, 1.6f});
    addCeilingLight(builder, "light", 1.2f, 0.8f, light, white);

    builder.addCamera("front", {2.0f, 1.45f, 3.8f}, {2.0f, 0.95f, 1.5f}, 62);
    builder.addCamera("ball", {2.3f, 1.3f, 3.2f}, {2.85f, 1.0f, 1.9f}, 42);
    builder.addCamera("pane", {0.45f, 1.3f, 3.4f}, {1.1f, 0.95f, 1.6f}, 50);
    return builder.finish();
}

}  // namespace vlf
