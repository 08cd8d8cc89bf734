// A white hall with pictures and a statue of any number of triangles.

#include "vlf/scene/generate/fixtures.h"
#include "vlf/scene/generate/procedural_texture.h"
#include "vlf/scene/generate/recipes.h"

namespace vlf {

namespace {

constexpr float kWidth = 10, kHeight = 4, kDepth = 7;

void addHall(SceneBuilder& builder) {
    const MaterialId white = builder.addMaterial("white", {0.80f, 0.79f, 0.77f});
    const MaterialId oak = builder.addMaterial(
        "oak", woodTexture("oak", {0.50f, 0.34f, 0.20f}, {0.80f, 0.62f, 0.42f}, 12));
    builder.setTextureSize(2);
    builder.beginMesh("hall");
    builder.addRoom({0, 0, 0}, {kWidth, kHeight, kDepth}, {white, white, oak, white, white, white});

    const MaterialId light = builder.addEmitter("light", {11, 10.4f, 9.4f});
    const MaterialId casing = builder.addMaterial("casing", {0.45f, 0.45f, 0.46f});
    for (int i = 0; i < 4; ++i) {
        builder.place({2 + 2 * static_cast<float>(i), kHeight, 0.5f * kDepth});
        addCeilingLight(builder, "light-" + std::to_string(i + 1), 0.3f, 4.4f, light, casing);
    }
}

void addPicture(SceneBuilder& builder, Texture texture, const Vec2& size, MaterialId frame) {
    const std::string name = texture.name;
    const MaterialId picture = builder.addMaterial(name, std::move(texture));
    addFramedPanel(builder, name, size.x, size.y, 0.06f, 0.05f, picture, frame);
}

void addPictures(SceneBuilder& builder) {
    constexpr float kEyeLevel = 1.7f;
    const MaterialId black = builder.addMaterial("black-frame", {0.05f, 0.05f, 0.05f});
    const MaterialId gold = builder.addMaterial("gold-frame", {0.62f, 0.44f, 0.16f});
    builder.place({2.2f, kEyeLevel, 0});
    addPicture(builder, blockPainting(), {1.4f, 1.4f}, black);
    builder.place({5, kEyeLevel, 0});
    addPicture(builder, mountainPainting(), {2.2f, 1.5f}, gold);
    builder.place({7.8f, kEyeLevel, 0});
    addPicture(builder, circlePainting(), {1.4f, 1.4f}, black);
    builder.place({0, kEyeLevel, 3.5f}, 90);
    addPicture(builder, seaPainting(), {2.4f, 1.6f}, gold);
    builder.place({kWidth, kEyeLevel, 3.5f}, -90);
    addPicture(builder, wavePainting(), {1.8f, 1.8f}, black);
}

void addBench(SceneBuilder& builder) {
    const MaterialId leather = builder.addMaterial("leather", {0.22f, 0.09f, 0.06f});
    const MaterialId steel = builder.addMaterial("steel", {0.25f, 0.25f, 0.26f});
    builder.place({7.6f, 0, 3.6f}, 90);
    builder.beginMesh("bench-seat");
    builder.addBox({-0.9f, 0.36f, -0.25f}, {0.9f, 0.46f, 0.25f}, leather);
    builder.beginMesh("bench-legs");
    for (const float x : {-0.7f, 0.7f})
        builder.addBox({x - 0.04f, 0, -0.2f}, {x + 0.04f, 0.37f, 0.2f}, steel, kBottom);
}

void addExhibit(SceneBuilder& builder, int triangles) {
    const MaterialId plinth = builder.addMaterial("plinth", {0.60f, 0.59f, 0.57f});
    const MaterialId bronze = builder.addMaterial("statue", {0.30f, 0.46f, 0.40f});
    const MaterialId iron = builder.addMaterial("pin", {0.12f, 0.12f, 0.13f});
    constexpr float kPlinth = 0.8f;
    builder.place({4.6f, 0, 3.6f}, 25);
    builder.beginMesh("plinth");
    builder.addBox({-0.4f, 0, -0.4f}, {0.4f, kPlinth, 0.4f}, plinth, kBottom);
    builder.place({4.6f, kPlinth, 3.6f}, 25);
    addStatue(builder, triangles, bronze, iron);
}

}  // namespace

Scene makeGallery(int statueTriangles) {
    SceneBuilder builder;
    addHall(builder);
    addPictures(builder);
    addBench(builder);
    addExhibit(builder, statueTriangles);
    builder.addCamera("overview", {0.6f, 2.1f, 6.6f}, {5.4f, 1.3f, 2.4f}, 60);
    builder.addCamera("front", {5.2f, 1.65f, 6.7f}, {4.9f, 1.5f, 0}, 58);
    builder.addCamera("statue", {5.9f, 1.6f, 5.2f}, {4.6f, 1.35f, 3.6f}, 45);
    builder.addCamera("corner", {9.6f, 2.6f, 6.6f}, {3.0f, 1.0f, 1.8f}, 60);
    return builder.finish();
}

}  // namespace vlf
