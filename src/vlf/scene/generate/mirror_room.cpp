// The hardest room of Mortensen et al., "Real-time global illumination in the CAVE", VRST 2007, in
// our own shapes: a large mirror that shows a finely tessellated statue.

#include "vlf/scene/generate/fixtures.h"
#include "vlf/scene/generate/recipes.h"

namespace vlf {

namespace {

constexpr float kSize = 5.5f;

void addStatueOnPlinth(SceneBuilder& builder, int triangles) {
    const MaterialId plinth = builder.addMaterial("plinth", {0.42f, 0.40f, 0.38f});
    const MaterialId gold = builder.addMaterial("statue", {0.66f, 0.38f, 0.10f});
    const MaterialId iron = builder.addMaterial("pin", {0.12f, 0.12f, 0.13f});
    constexpr float kHeight = 0.9f;
    builder.place({1.9f, 0, 2.3f}, 20);
    builder.beginMesh("plinth");
    builder.addBox({-0.4f, 0, -0.4f}, {0.4f, kHeight, 0.4f}, plinth, kBottom);
    builder.place({1.9f, kHeight, 2.3f}, 20);
    addStatue(builder, triangles, gold, iron);
}

void addMirror(SceneBuilder& builder) {
    const MaterialId mirror = builder.addMaterial("mirror", {0.02f, 0.03f, 0.08f}, Vec3(0.88f));
    const MaterialId frame = builder.addMaterial("frame", {0.24f, 0.13f, 0.07f});
    builder.place({0.5f * kSize, 2.6f, 0});
    addFramedPanel(builder, "mirror", 4.4f, 4.0f, 0.12f, 0.06f, mirror, frame);
}

}  // namespace

Scene makeMirrorRoom(int statueTriangles) {
    SceneBuilder builder;
    const MaterialId white = builder.addMaterial("white", {0.74f, 0.73f, 0.70f});
    const MaterialId left = builder.addMaterial("left-wall", {0.60f, 0.14f, 0.10f});
    const MaterialId right = builder.addMaterial("right-wall", {0.12f, 0.28f, 0.52f});
    const MaterialId floor = builder.addMaterial("floor", {0.52f, 0.50f, 0.46f});
    const MaterialId block = builder.addMaterial("block", {0.70f, 0.70f, 0.66f});
    const MaterialId light = builder.addEmitter("light", {16, 14.5f, 12});

    builder.beginMesh("room");
    builder.addRoom({0, 0, 0}, Vec3(kSize), {left, right, floor, white, white, white});
    addMirror(builder);
    builder.place({4.45f, 0, 1.5f}, -25);
    builder.beginMesh("block");
    builder.addBox({-0.45f, 0, -0.45f}, {0.45f, 2.5f, 0.45f}, block, kBottom);
    addStatueOnPlinth(builder, statueTriangles);
    builder.place({0.5f * kSize, kSize, 3.1f});
    addCeilingLight(builder, "light", 1.3f, 1.3f, light, white);

    builder.addCamera("front", {3.1f, 2.1f, 5.3f}, {2.75f, 1.85f, 0}, 60);
    builder.addCamera("statue", {3.0f, 1.9f, 4.3f}, {2.0f, 1.5f, 2.2f}, 50);
    builder.addCamera("mirror", {0.5f, 1.7f, 3.6f}, {3.3f, 2.0f, 0}, 60);
    builder.addCamera("overview", {0.4f, 3.4f, 5.2f}, {2.9f, 1.5f, 0.6f}, 62);
    return builder.finish();
}

}  // namespace vlf
