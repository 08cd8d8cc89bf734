// A trap for light leaks: floor, ceiling and long walls are single polygons that a wall of 2 cm
// parts into a lit room and one that no light can reach.

#include "vlf/scene/generate/fixtures.h"
#include "vlf/scene/generate/recipes.h"

namespace vlf {

namespace {

constexpr float kLength = 8, kHeight = 2.8f, kDepth = 4;
constexpr float kWallStart = 3.99f, kWallEnd = 4.01f;

/// One side of the dividing wall each, for the shared polygons close it all round.
void addDividingWall(SceneBuilder& builder) {
    const MaterialId blue = builder.addMaterial("dividing-wall", {0.28f, 0.40f, 0.62f});
    const Vec3 lower(kWallStart, 0, 0), upper(kWallEnd, kHeight, kDepth);
    builder.beginMesh("dividing-wall-lit");
    builder.addBox(lower, upper, blue, kRight | kBottom | kTop | kBack | kFront);
    builder.beginMesh("dividing-wall-dark");
    builder.addBox(lower, upper, blue, kLeft | kBottom | kTop | kBack | kFront);
}

void addBoxes(SceneBuilder& builder) {
    const MaterialId orange = builder.addMaterial("orange", {0.72f, 0.36f, 0.10f});
    const MaterialId green = builder.addMaterial("green", {0.22f, 0.48f, 0.20f});
    for (const float room : {0.0f, 4.0f}) {
        const std::string suffix = room == 0 ? "-lit" : "-dark";
        builder.beginMesh("cube" + suffix);
        builder.place({room + 1.3f, 0, 1.2f}, 25);
        builder.addBox({-0.4f, 0, -0.4f}, {0.4f, 0.8f, 0.4f}, orange, kBottom);
        builder.beginMesh("pillar" + suffix);
        builder.place({room + 2.7f, 0, 2.3f}, -15);
        builder.addBox({-0.3f, 0, -0.3f}, {0.3f, 1.7f, 0.3f}, green, kBottom);
    }
}

}  // namespace

Scene makeSealed() {
    SceneBuilder builder;
    const MaterialId white = builder.addMaterial("white", {0.78f, 0.77f, 0.74f});
    const MaterialId floor = builder.addMaterial("floor", {0.50f, 0.46f, 0.40f});
    const MaterialId light = builder.addEmitter("light", {13, 12, 10.5f});
    builder.beginMesh("room");
    builder.addRoom({0, 0, 0}, {kLength, kHeight, kDepth},
                    {white, white, floor, white, white, white});
    addDividingWall(builder);
    addBoxes(builder);
    builder.place({1.8f, kHeight, 2});
    addCeilingLight(builder, "light", 1, 1, light, white);

    builder.addCamera("overview", {0.25f, 1.9f, 3.7f}, {2.9f, 0.9f, 1.2f}, 70);
    builder.addCamera("lit", {3.7f, 1.8f, 0.4f}, {0.9f, 0.7f, 2.2f}, 70);
    builder.addCamera("dark", {7.7f, 1.8f, 0.4f}, {4.9f, 0.7f, 2.2f}, 70);
    return builder.finish();
}

}  // namespace vlf
