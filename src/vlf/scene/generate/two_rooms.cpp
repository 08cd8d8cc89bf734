// Light that reaches one room only through the door of another.

#include "vlf/scene/generate/fixtures.h"
#include "vlf/scene/generate/recipes.h"

namespace vlf {

namespace {

constexpr float kRoom = 4, kHeight = 2.8f, kWall = 0.15f;
constexpr float kFar = 2 * kRoom + kWall;
constexpr float kDoorStart = 1.9f, kDoorEnd = 2.8f, kDoorHeight = 2;

/// Both rooms and the passage between them, cut into cells at the planes of the door.
void addRooms(SceneBuilder& builder) {
    const MaterialId white = builder.addMaterial("white", {0.78f, 0.77f, 0.74f});
    const MaterialId ochre = builder.addMaterial("ochre", {0.68f, 0.46f, 0.16f});
    const MaterialId teal = builder.addMaterial("teal", {0.12f, 0.42f, 0.42f});
    const MaterialId reveal = builder.addMaterial("reveal", {0.55f, 0.54f, 0.52f});
    const MaterialId floor = builder.addMaterial("floor", {0.46f, 0.38f, 0.30f});
    const auto air = [](int i, int j, int k) { return i != 1 || (j == 0 && k == 1); };
    const auto material = [=](const Vec3& p, const Vec3& normal) {
        const bool passage = p.x > kRoom && p.x < kRoom + kWall;
        if (normal.y < 0) return floor;
        if (passage) return reveal;
        if (p.x > kFar - 0.01f) return ochre;
        return normal.z < 0 && p.x < kRoom ? teal : white;
    };
    builder.beginMesh("rooms");
    builder.addCellRoom({{0, kRoom, kRoom + kWall, kFar},
                         {0, kDoorHeight, kHeight},
                         {0, kDoorStart, kDoorEnd, kRoom}},
                        air, material);
}

void addFurniture(SceneBuilder& builder) {
    const MaterialId wood = builder.addMaterial("wood", {0.50f, 0.30f, 0.15f});
    const MaterialId red = builder.addMaterial("red", {0.62f, 0.12f, 0.10f});
    const MaterialId grey = builder.addMaterial("grey", {0.40f, 0.42f, 0.45f});
    builder.beginMesh("chest");
    builder.place({1.5f, 0, 0.45f});
    builder.addBox({-0.6f, 0, -0.35f}, {0.6f, 0.75f, 0.35f}, wood, kBottom);
    builder.beginMesh("cube");
    builder.place({6.4f, 0, 1.2f}, 30);
    builder.addBox({-0.4f, 0, -0.4f}, {0.4f, 0.8f, 0.4f}, red, kBottom);
    builder.beginMesh("column");
    builder.place({7.3f, 0, 3.1f});
    const std::array<Vec2, 3> profile{Vec2(0.25f, 0), Vec2(0.25f, 1.5f), Vec2(0, 1.5f)};
    builder.addLathe(profile, 32, grey);
}

}  // namespace

Scene makeTwoRooms() {
    SceneBuilder builder;
    addRooms(builder);
    addFurniture(builder);
    const MaterialId light = builder.addEmitter("light", {22, 19, 15});
    const MaterialId casing = builder.addMaterial("casing", {0.6f, 0.6f, 0.6f});
    builder.place({0.6f, kHeight, 3.4f});
    addCeilingLight(builder, "light", 0.8f, 0.8f, light, casing);

    builder.addCamera("overview", {0.35f, 1.9f, 2.9f}, {4.2f, 1.1f, 1.9f}, 65);
    builder.addCamera("lit", {3.7f, 1.7f, 0.4f}, {0.8f, 1.2f, 3.0f}, 65);
    builder.addCamera("door", {2.2f, 1.5f, 2.0f}, {6.5f, 1.0f, 2.4f}, 55);
    builder.addCamera("dark", {7.8f, 1.7f, 0.5f}, {4.6f, 1.0f, 3.0f}, 65);
    return builder.finish();
}

}  // namespace vlf
