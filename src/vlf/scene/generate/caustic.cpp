// Light that mirrors throw on walls: a spotlight on a tilted mirror, a box with mirror sides, a
// lacquered block that reflects partly diffusely and partly as a mirror, and a weak fill light.

#include "vlf/scene/generate/fixtures.h"
#include "vlf/scene/generate/recipes.h"

#include <glm/gtc/matrix_transform.hpp>

namespace vlf {

namespace {

constexpr float kWidth = 4.2f, kHeight = 3, kDepth = 4;
constexpr Vec3 kSpot{1, kHeight, 1.8f};  ///< where the lamp meets the ceiling
constexpr float kMirrorHeight = 0.55f;

/// A small disk at the upper end of a can that is open below.
void addSpotlight(SceneBuilder& builder) {
    const MaterialId light = builder.addEmitter("light", {16000, 14500, 11500});
    const MaterialId can = builder.addMaterial("can", {0.20f, 0.20f, 0.21f});
    const std::array<Vec2, 2> disk{Vec2(0, -0.04f), Vec2(0.04f, -0.04f)};
    const std::array<Vec2, 5> casing{Vec2(0.04f, -0.04f), Vec2(0.12f, -0.04f), Vec2(0.12f, -0.6f),
                                     Vec2(0.14f, -0.6f), Vec2(0.14f, 0)};
    builder.place(kSpot);
    builder.beginMesh("spotlight");
    builder.addLathe(disk, 24, light);
    builder.addLathe(casing, 24, can);
}

/// A panel below the lamp, tilted so that it throws the light on the wall at +x.
void addTiltedMirror(SceneBuilder& builder) {
    constexpr float kTilt = -35, kHalf = 0.3f, kThickness = 0.03f;
    const MaterialId mirror = builder.addMaterial("mirror", Vec3(0), Vec3(0.9f));
    const MaterialId stand = builder.addMaterial("stand", {0.10f, 0.10f, 0.11f});
    const Vec3 centre(kSpot.x, kMirrorHeight, kSpot.z);
    builder.place(glm::rotate(glm::translate(Mat4(1), centre), glm::radians(kTilt), Vec3(0, 0, 1)));
    builder.beginMesh("mirror");
    builder.addBox({-kHalf, -kThickness, -kHalf}, {kHalf, 0, kHalf},
                   {stand, stand, stand, mirror, stand, stand});
    builder.place({centre.x, 0, centre.z});
    builder.beginMesh("stand");
    const std::array<Vec2, 5> profile{Vec2(0.2f, 0), Vec2(0.2f, 0.02f), Vec2(0.025f, 0.02f),
                                      Vec2(0.025f, kMirrorHeight - 0.02f),
                                      Vec2(0, kMirrorHeight - 0.02f)};
    builder.addLathe(profile, 24, stand);
}

void addBoxes(SceneBuilder& builder) {
    const MaterialId silver = builder.addMaterial("silver", Vec3(0), {0.86f, 0.86f, 0.88f});
    const MaterialId lid = builder.addMaterial("lid", {0.68f, 0.52f, 0.20f});
    const MaterialId lacquer = builder.addMaterial("lacquer", {0.34f, 0.05f, 0.04f}, Vec3(0.30f));
    builder.place({2.75f, 0, 0.95f}, 28);
    builder.beginMesh("mirror-box");
    builder.addBox({-0.4f, 0, -0.4f}, {0.4f, 0.8f, 0.4f},
                   {silver, silver, kLeaveOut, lid, silver, silver});
    builder.place({3.0f, 0, 2.9f}, -18);
    builder.beginMesh("lacquered-block");
    builder.addBox({-0.3f, 0, -0.45f}, {0.3f, 0.5f, 0.45f}, lacquer, kBottom);
}

}  // namespace

Scene makeCaustic() {
    SceneBuilder builder;
    const MaterialId white = builder.addMaterial("white", {0.78f, 0.77f, 0.74f});
    const MaterialId blue = builder.addMaterial("blue", {0.16f, 0.30f, 0.58f});
    const MaterialId floor = builder.addMaterial("floor", {0.58f, 0.52f, 0.45f});
    builder.beginMesh("room");
    builder.addRoom({0, 0, 0}, {kWidth, kHeight, kDepth},
                    {white, white, floor, white, blue, white});
    addSpotlight(builder);
    addTiltedMirror(builder);
    addBoxes(builder);
    const MaterialId fill = builder.addEmitter("fill-light", {2.2f, 2.4f, 2.8f});
    builder.place({2.9f, kHeight, 2.6f});
    addCeilingLight(builder, "fill-light", 1, 1, fill, white);

    builder.addCamera("overview", {0.25f, 1.75f, 3.8f}, {2.75f, 1.05f, 1.3f}, 68);
    builder.addCamera("front", {1.9f, 1.6f, 3.9f}, {2.3f, 1.2f, 0}, 65);
    builder.addCamera("patch", {1.9f, 1.4f, 3.3f}, {4.2f, 1.4f, 1.5f}, 55);
    return builder.finish();
}

}  // namespace vlf
