// Light through holes that alpha masks cut.

#include "solved_scene.h"

#include "support/analytic_scenes.h"
#include "vlf/scene/import/cut_masks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vlf::test {

namespace {

/// A lamp above a black sheet of 1 m, which leaves a square hole `hole` wide in its middle, above a
/// floor. The sheet is the last mesh.
Scene holedSheet(float hole) {
    SceneBuilder b;
    const std::uint32_t black = b.material("black", Vec3(0)), floor = b.material("floor", Vec3(0));
    const std::uint32_t lamp = b.material("lamp", Vec3(0), Vec3(10));
    b.quad({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}, floor);
    b.quad({-0.2f, 1, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f}, lamp);
    const float h = 0.5f * hole, e = 0.5f;
    if (hole <= 0) {
        b.quad({-e, 0, -e}, {0, 0, 2 * e}, {2 * e, 0, 0}, black);
        return b.scene();
    }
    b.quad({-e, 0, -e}, {0, 0, 2 * e}, {e - h, 0, 0}, black);
    b.quad({h, 0, -e}, {0, 0, 2 * e}, {e - h, 0, 0}, black);
    b.quad({-h, 0, -e}, {0, 0, e - h}, {2 * h, 0, 0}, black);
    b.quad({-h, 0, h}, {0, 0, e - h}, {2 * h, 0, 0}, black);
    return b.scene();
}

/// The same cut by a mask of 128 texels, transparent over the middle half: between the centres of
/// the texels on either side.
Scene maskedSheet() {
    Scene scene = holedSheet(0);
    DecodedImage image{128, 128, {}, {}, true};
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) {
            const bool open = x >= 32 && x < 96 && y >= 32 && y < 96;
            image.srgb8.insert(image.srgb8.end(), {255, 255, 255, std::uint8_t(open ? 0 : 255)});
        }
    MaskedMaterials masked;
    masked.images.emplace_back(image, AlphaSource::alpha, Wrap::clamp, Wrap::clamp);
    masked.masks[0] = {0, 0.5f};
    ImportReport report;
    cutMasks(scene, masked, "sheet", report);
    return scene;
}

}  // namespace

TEST(Cutout, LetsThroughTheLightOfTheSameHole) {
    const auto floorOf = [](const Scene& scene) {
        BakeParams p = quickParams(4000);
        p.directSamples = 32;
        return SolvedScene(scene, p).meanIrradianceOfChart(0);
    };
    const double open = floorOf(holedSheet(0.5f)), cut = floorOf(maskedSheet());
    const double closed = floorOf(holedSheet(0));
    EXPECT_GT(open, 1.3 * closed);
    EXPECT_NEAR(cut / open, 1, 0.01)
        << open << " through the hole, " << closed << " past the sheet";
}

}  // namespace vlf::test
