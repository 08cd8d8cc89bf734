// A furnished room of a few thousand triangles: window, ceiling panels, desk lamp, textures and a
// mirror.

#include "vlf/math/random.h"
#include "vlf/scene/generate/fixtures.h"
#include "vlf/scene/generate/procedural_texture.h"
#include "vlf/scene/generate/recipes.h"

namespace vlf {

namespace {

constexpr float kWidth = 5, kHeight = 2.8f, kDepth = 4;
constexpr float kDeskHeight = 0.74f;

/// Materials that several pieces of furniture share.
struct Palette {
    MaterialId wood, lightWood, steel, black;
};

Palette makePalette(SceneBuilder& builder) {
    return {builder.addMaterial(
                "walnut", woodTexture("walnut", {0.30f, 0.18f, 0.11f}, {0.56f, 0.37f, 0.24f}, 1)),
            builder.addMaterial("birch", {0.70f, 0.56f, 0.38f}),
            builder.addMaterial("steel", {0.38f, 0.39f, 0.40f}),
            builder.addMaterial("black", {0.05f, 0.05f, 0.055f})};
}

void addShell(SceneBuilder& builder) {
    const MaterialId white = builder.addMaterial("white", {0.80f, 0.79f, 0.76f});
    const MaterialId sage = builder.addMaterial("sage", {0.40f, 0.53f, 0.43f});
    const MaterialId parquet = builder.addMaterial(
        "parquet", woodTexture("parquet", {0.52f, 0.36f, 0.22f}, {0.82f, 0.64f, 0.44f}, 10));
    builder.setTextureSize(1.6f);
    builder.beginMesh("room");
    builder.addRoom({0, 0, 0}, {kWidth, kHeight, kDepth},
                    {white, white, parquet, white, sage, white});
    builder.setTextureSize(1);
}

void addLights(SceneBuilder& builder, const Palette& palette) {
    const MaterialId panel = builder.addEmitter("ceiling-light", {7, 6.7f, 6});
    for (int i = 0; i < 2; ++i) {
        builder.place({1.6f + 1.8f * static_cast<float>(i), kHeight, 2.1f});
        addCeilingLight(builder, "ceiling-light-" + std::to_string(i + 1), 0.3f, 1.2f, panel,
                        palette.steel);
    }
    const MaterialId sky = builder.addEmitter("window", {11, 11.5f, 12}, skyTexture());
    const MaterialId frame = builder.addMaterial("window-frame", Vec3(0.75f));
    builder.place({kWidth, 1.55f, 1.9f}, -90);
    addFramedPanel(builder, "window", 2.0f, 1.3f, 0.07f, 0.08f, sky, frame);
    builder.beginMesh("window-bar");
    builder.addBox({-0.03f, -0.65f, 0.045f}, {0.03f, 0.65f, 0.07f}, frame, kTop | kBottom);
}

void addDesk(SceneBuilder& builder, const Palette& palette) {
    constexpr float kHalfWidth = 0.85f, kHalfDepth = 0.38f, kTopThickness = 0.035f, kLeg = 0.05f;
    builder.place({3.1f, 0, 0.5f});
    builder.beginMesh("desk-top");
    builder.addBox({-kHalfWidth, kDeskHeight - kTopThickness, -kHalfDepth},
                   {kHalfWidth, kDeskHeight, kHalfDepth}, palette.wood);
    builder.beginMesh("desk-legs");
    for (const float x : {-kHalfWidth + 0.03f, kHalfWidth - 0.03f - kLeg})
        for (const float z : {-kHalfDepth + 0.03f, kHalfDepth - 0.03f - kLeg})
            builder.addBox({x, 0, z}, {x + kLeg, kDeskHeight - 0.02f, z + kLeg}, palette.steel,
                           kBottom);
}

void addMonitor(SceneBuilder& builder, const Palette& palette) {
    const MaterialId screen = builder.addMaterial("screen", wavePainting());
    builder.place({3.2f, kDeskHeight, 0.36f}, -6);
    builder.beginMesh("monitor");
    builder.addBox({-0.28f, 0.12f, -0.015f}, {0.28f, 0.47f, 0.015f}, palette.black);
    builder.addBox({-0.03f, 0, -0.03f}, {0.03f, 0.2f, -0.014f}, palette.black, kBottom);
    builder.beginMesh("monitor-screen");
    builder.addQuad({-0.265f, 0.135f, 0.016f}, {0.265f, 0.135f, 0.016f}, {0.265f, 0.455f, 0.016f},
                    {-0.265f, 0.455f, 0.016f}, screen);
    builder.place({3.2f, kDeskHeight, 0.68f}, -6);
    builder.beginMesh("keyboard");
    builder.addBox({-0.2f, 0, -0.06f}, {0.2f, 0.018f, 0.06f}, palette.steel, kBottom);
}

/// A lamp whose shade is a cone with a wall of its own, over a small emitting disk.
void addDeskLamp(SceneBuilder& builder) {
    const MaterialId red = builder.addMaterial("lamp-red", {0.66f, 0.10f, 0.07f});
    const MaterialId bulb = builder.addEmitter("bulb", {260, 215, 150});
    builder.place({2.5f, kDeskHeight, 0.36f}, 35);
    builder.beginMesh("lamp-stand");
    const std::array<Vec2, 5> stand{Vec2(0.08f, 0), Vec2(0.08f, 0.02f), Vec2(0.01f, 0.03f),
                                    Vec2(0.01f, 0.43f), Vec2(0, 0.43f)};
    builder.addLathe(stand, 20, red);
    builder.addCylinder({0, 0.41f, 0}, {0, 0.466f, 0.16f}, 0.008f, 12, red);
    builder.place(builder.placement() * axisFrame({0, 0.46f, 0.16f}, {0, 0.53f, 0.14f}));
    builder.beginMesh("lamp-shade");
    const std::array<Vec2, 2> disk{Vec2(0, -0.01f), Vec2(0.035f, -0.01f)};
    const std::array<Vec2, 5> shade{Vec2(0.035f, -0.01f), Vec2(0.09f, -0.11f), Vec2(0.095f, -0.11f),
                                    Vec2(0.04f, 0.02f), Vec2(0, 0.03f)};
    builder.addLathe(disk, 16, bulb);
    builder.addLathe(shade, 16, red);
}

void addMug(SceneBuilder& builder) {
    const MaterialId mug = builder.addMaterial("mug", {0.18f, 0.36f, 0.60f});
    const std::array<Vec2, 5> profile{Vec2(0.04f, 0), Vec2(0.04f, 0.1f), Vec2(0.035f, 0.1f),
                                      Vec2(0.035f, 0.01f), Vec2(0, 0.01f)};
    builder.place({3.68f, kDeskHeight, 0.62f});
    builder.beginMesh("mug");
    builder.addLathe(profile, 20, mug);
}

void addChair(SceneBuilder& builder, const Palette& palette) {
    constexpr float kHalf = 0.22f, kSeat = 0.45f, kLeg = 0.035f;
    const MaterialId cushion = builder.addMaterial("cushion", {0.72f, 0.42f, 0.12f});
    builder.place({3.0f, 0, 1.35f}, 158);
    builder.beginMesh("chair-legs");
    for (const float x : {-kHalf, kHalf - kLeg}) {
        builder.addBox({x, 0, kHalf - kLeg}, {x + kLeg, kSeat - 0.02f, kHalf}, palette.lightWood,
                       kBottom);
        builder.addBox({x, 0, -kHalf}, {x + kLeg, 0.92f, -kHalf + kLeg}, palette.lightWood,
                       kBottom);
    }
    builder.beginMesh("chair-seat");
    builder.addBox({-kHalf + 0.003f, kSeat - 0.05f, -kHalf + 0.01f},
                   {kHalf + 0.01f, kSeat, kHalf + 0.02f}, cushion);
    builder.beginMesh("chair-back");
    builder.addBox({-kHalf + 0.01f, 0.62f, -kHalf + 0.008f},
                   {kHalf - 0.01f, 0.88f, -kHalf + kLeg - 0.008f}, cushion);
}

/// Books from left to right on a board, with gaps of 2 mm, until `width` is full.
void addBooks(SceneBuilder& builder, float width, float board, int row,
              const std::array<MaterialId, 5>& covers) {
    RandomStream random(2007, static_cast<std::uint64_t>(row));
    const float end = width * (0.6f + 0.35f * random.next());
    float x = 0.01f;
    while (true) {
        const float thickness = 0.018f + 0.035f * random.next();
        const float height = 0.19f + 0.09f * random.next(), depth = 0.15f + 0.06f * random.next();
        const auto cover = static_cast<std::size_t>(5 * random.next());
        if (x + thickness > end) return;
        builder.addBox({x, board, 0.02f}, {x + thickness, board + height, 0.02f + depth},
                       covers[cover], kBottom);
        x += thickness + 0.002f;
    }
}

void addShelf(SceneBuilder& builder, const Palette& palette) {
    constexpr float kShelfWidth = 1.3f, kShelfDepth = 0.3f, kBoard = 0.025f, kStep = 0.36f;
    constexpr int kLevels = 5;
    const std::array<MaterialId, 5> covers{builder.addMaterial("book-red", {0.55f, 0.10f, 0.09f}),
                                           builder.addMaterial("book-blue", {0.10f, 0.19f, 0.42f}),
                                           builder.addMaterial("book-green", {0.14f, 0.34f, 0.18f}),
                                           builder.addMaterial("book-cream", {0.75f, 0.69f, 0.54f}),
                                           builder.addMaterial("book-plum", {0.30f, 0.10f, 0.26f})};
    CellGrid grid{{0, kBoard, kShelfWidth - kBoard, kShelfWidth}, {0}, {0, kShelfDepth}};
    for (int level = 0; level <= kLevels; ++level) {
        const float bottom = 0.06f + kStep * static_cast<float>(level);
        grid.y.insert(grid.y.end(), {bottom, bottom + kBoard});
    }
    builder.place({0.35f, 0, 0});
    builder.beginMesh("shelf");
    builder.addCells(
        grid, [](int i, int j, int) { return i != 1 || j % 2 == 1; },
        [&](const Vec3& p, const Vec3& normal) {
            return normal.z < 0 || p.y == 0 ? kLeaveOut : palette.lightWood;
        });
    builder.place({0.35f + kBoard, 0, 0});
    for (int level = 0; level < kLevels; ++level) {
        builder.beginMesh("books-" + std::to_string(level + 1));
        addBooks(builder, kShelfWidth - 2 * kBoard, grid.y[2 * level + 2], level, covers);
    }
}

void addCabinet(SceneBuilder& builder, const Palette& palette) {
    constexpr float kHalf = 0.7f, kTopHeight = 0.82f, kFrontPlane = 0.44f;
    builder.place({0, 0, 2.0f}, 90);
    builder.beginMesh("cabinet");
    builder.addBox({-kHalf, 0, 0}, {kHalf, kTopHeight, kFrontPlane}, palette.wood, kBottom | kBack);
    builder.beginMesh("cabinet-doors");
    for (const float x : {-kHalf + 0.02f, 0.01f})
        builder.addBox({x, 0.05f, kFrontPlane},
                       {x + kHalf - 0.03f, kTopHeight - 0.03f, kFrontPlane + 0.02f},
                       palette.lightWood, kBack);
    builder.beginMesh("cabinet-handles");
    for (const float x : {-0.08f, 0.06f})
        builder.addBox({x, 0.42f, kFrontPlane + 0.02f}, {x + 0.02f, 0.56f, kFrontPlane + 0.04f},
                       palette.steel, kBack);
    const MaterialId vase = builder.addMaterial("vase", {0.16f, 0.42f, 0.46f});
    const std::array<Vec2, 8> profile{Vec2(0.06f, 0),      Vec2(0.10f, 0.08f), Vec2(0.11f, 0.16f),
                                      Vec2(0.07f, 0.26f),  Vec2(0.05f, 0.32f), Vec2(0.065f, 0.36f),
                                      Vec2(0.055f, 0.36f), Vec2(0, 0.10f)};
    builder.place({0.22f, kTopHeight, 2.5f});
    builder.beginMesh("vase");
    builder.addLathe(profile, 24, vase);
}

void addWallPieces(SceneBuilder& builder, const Palette& palette) {
    const MaterialId mirror = builder.addMaterial("mirror", Vec3(0.01f), Vec3(0.87f));
    const MaterialId painting = builder.addMaterial("painting", mountainPainting());
    builder.place({0, 1.65f, 2.0f}, 90);
    addFramedPanel(builder, "mirror", 1.2f, 0.95f, 0.05f, 0.04f, mirror, palette.lightWood);
    builder.place({3.1f, 1.72f, 0});
    addFramedPanel(builder, "painting", 1.1f, 0.75f, 0.04f, 0.03f, painting, palette.black);
}

void addFloorPieces(SceneBuilder& builder) {
    const MaterialId rug = builder.addMaterial(
        "rug",
        tileTexture("rug", {0.45f, 0.16f, 0.15f}, {0.70f, 0.58f, 0.42f}, {0.22f, 0.12f, 0.14f}, 4));
    builder.place({2.6f, 0, 2.5f});
    builder.beginMesh("rug");
    builder.addBox({-1.1f, 0, -0.75f}, {1.1f, 0.012f, 0.75f}, rug, kBottom);

    const MaterialId bin = builder.addMaterial("bin", {0.30f, 0.32f, 0.34f});
    const std::array<Vec2, 5> binProfile{Vec2(0.12f, 0), Vec2(0.15f, 0.32f), Vec2(0.14f, 0.32f),
                                         Vec2(0.11f, 0.01f), Vec2(0, 0.01f)};
    builder.place({4.25f, 0, 0.4f});
    builder.beginMesh("bin");
    builder.addLathe(binProfile, 24, bin);
}

/// A clipped bush in a pot.
void addBush(SceneBuilder& builder, const Palette& palette) {
    const MaterialId clay = builder.addMaterial("clay", {0.56f, 0.27f, 0.16f});
    const MaterialId leaves = builder.addMaterial("leaves", {0.11f, 0.30f, 0.08f});
    const std::array<Vec2, 5> pot{Vec2(0.13f, 0), Vec2(0.18f, 0.3f), Vec2(0.16f, 0.3f),
                                  Vec2(0.15f, 0.26f), Vec2(0, 0.26f)};
    builder.place({4.55f, 0, 3.4f});
    builder.beginMesh("pot");
    builder.addLathe(pot, 20, clay);
    builder.beginMesh("trunk");
    const std::array<Vec2, 3> trunk{Vec2(0.02f, 0.26f), Vec2(0.02f, 0.75f), Vec2(0, 0.75f)};
    builder.addLathe(trunk, 10, palette.wood);
    constexpr int kRings = 10;
    std::array<Vec2, kRings + 1> ball;
    for (int i = 0; i <= kRings; ++i) {
        const float angle = kPi * static_cast<float>(i) / kRings;
        const float radius = i == 0 || i == kRings ? 0 : 0.28f * std::sin(angle);
        ball[i] = {radius, 0.95f - 0.28f * std::cos(angle)};
    }
    builder.beginMesh("bush");
    builder.addLathe(ball, 20, leaves);
}

}  // namespace

Scene makeOffice() {
    SceneBuilder builder;
    const Palette palette = makePalette(builder);
    addShell(builder);
    addLights(builder, palette);
    addDesk(builder, palette);
    addMonitor(builder, palette);
    addDeskLamp(builder);
    addMug(builder);
    addChair(builder, palette);
    addShelf(builder, palette);
    addCabinet(builder, palette);
    addWallPieces(builder, palette);
    addFloorPieces(builder);
    addBush(builder, palette);

    builder.addCamera("overview", {0.9f, 1.65f, 3.8f}, {2.8f, 1.0f, 0.5f}, 62);
    builder.addCamera("desk", {3.9f, 1.40f, 1.9f}, {2.85f, 0.88f, 0.3f}, 50);
    builder.addCamera("mirror", {3.6f, 1.6f, 3.2f}, {0, 1.3f, 1.9f}, 55);
    builder.addCamera("window", {0.5f, 1.5f, 0.9f}, {5, 1.2f, 2.2f}, 62);
    return builder.finish();
}

}  // namespace vlf
