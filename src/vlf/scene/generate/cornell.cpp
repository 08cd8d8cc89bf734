// The Cornell box after the data published by the Cornell University Program of Computer Graphics
// ("Cornell Box Data", 2005): a unit there is a centimetre here. The outline is the rectangle of
// the published numbers; spectra are the widely used RGB values.

#include "vlf/scene/generate/recipes.h"
#include "vlf/scene/generate/scene_builder.h"

namespace vlf {

namespace {

constexpr float kWidth = 5.528f, kHeight = 5.488f, kDepth = 5.592f;

/// A block without a bottom; `base` counter-clockwise seen from above, as (x, z).
void addBlock(SceneBuilder& builder, const std::array<Vec2, 4>& base, float height,
              MaterialId material) {
    const auto at = [&](int i, float y) { return Vec3(base[i % 4].x, y, base[i % 4].y); };
    for (int i = 0; i < 4; ++i)
        builder.addQuad(at(i, 0), at(i + 1, 0), at(i + 1, height), at(i, height), material);
    builder.addQuad(at(0, height), at(1, height), at(2, height), at(3, height), material);
}

}  // namespace

Scene makeCornell() {
    SceneBuilder builder;
    const MaterialId white = builder.addMaterial("white", {0.725f, 0.71f, 0.68f});
    const MaterialId red = builder.addMaterial("red", {0.63f, 0.065f, 0.05f});
    const MaterialId green = builder.addMaterial("green", {0.14f, 0.45f, 0.091f});
    const MaterialId light = builder.addEmitter("light", {17, 12, 4});

    builder.beginMesh("room");
    builder.addRoom({0, 0, 0}, {kWidth, kHeight, kDepth},
                    {green, red, white, white, kLeaveOut, white});

    builder.beginMesh("light");
    constexpr float kLightHeight = kHeight - 0.001f;
    builder.addQuad({3.43f, kLightHeight, 2.27f}, {3.43f, kLightHeight, 3.32f},
                    {2.13f, kLightHeight, 3.32f}, {2.13f, kLightHeight, 2.27f}, light);

    builder.beginMesh("short-block");
    addBlock(builder, {Vec2(1.30f, 0.65f), {0.82f, 2.25f}, {2.40f, 2.72f}, {2.90f, 1.14f}}, 1.65f,
             white);
    builder.beginMesh("tall-block");
    addBlock(builder, {Vec2(4.23f, 2.47f), {2.65f, 2.96f}, {3.14f, 4.56f}, {4.72f, 4.06f}}, 3.30f,
             white);

    // The published camera: a 25 mm square film behind a 35 mm lens.
    builder.addCamera("front", {2.78f, 2.73f, -8.00f}, {2.78f, 2.73f, 0}, 39.3f);
    builder.addCamera("inside", {2.76f, 4.70f, 0.15f}, {2.76f, 1.60f, 3.60f}, 72);
    builder.addCamera("corner", {5.20f, 3.90f, 0.20f}, {1.60f, 1.10f, 4.40f}, 60);
    return builder.finish();
}

}  // namespace vlf
