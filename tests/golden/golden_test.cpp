// Small stills of the example scenes in every mode, held against pictures that are kept.
// VLF_UPDATE_GOLDEN=1 in the environment writes the kept pictures anew instead of testing.

#include "golden/golden_pictures.h"

#include "vlf/image/flip.h"
#include "vlf/image/heat_map.h"
#include "vlf/image/image_io.h"
#include "vlf/propagate/bundle_sweep.h"

#include <cstdlib>
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

namespace fs = std::filesystem;

const fs::path kKept = VLF_GOLDEN_PICTURES;  // in the source tree
const fs::path kFailed = VLF_GOLDEN_FAILED;  // in the build folder

bool updating() {
    const char* value = std::getenv("VLF_UPDATE_GOLDEN");
    return value && std::string(value) == "1";
}

fs::path keptFile(const GoldenPicture& picture) {
    return kKept / (picture.name() + ".png");
}

std::set<std::string> scenes() {
    std::set<std::string> names;
    for (const GoldenPicture& picture : goldenPictures()) names.insert(picture.scene);
    return names;
}

/// As it is after having been a PNG.
Image throughFile(const fs::path& file, const Image& picture) {
    writePng(file.string(), picture);
    return readImage(file.string());
}

void writeHeatMap(const fs::path& file, const Image& picture, const Image& golden) {
    writePng(file.string(), heatMap(flip(picture, golden).error, golden.width, golden.height));
}

void holdAgainstKept(const Image& rendered, const GoldenPicture& golden, const std::string& name) {
    ASSERT_TRUE(fs::exists(keptFile(golden)))
        << "there is no " << keptFile(golden) << "; CONTRIBUTING.md says how to make it";
    const fs::path made = kFailed / (name + ".png"), expected = kFailed / (name + "-expected.png"),
                   difference = kFailed / (name + "-difference.png");
    for (const fs::path& old : {made, expected, difference}) fs::remove(old);
    fs::create_directories(kFailed);
    const Image kept = readImage(keptFile(golden).string());
    const Image picture = throughFile(made, rendered);
    const PictureDifference d = test::difference(picture, kept);
    if (within(d, golden.limits)) {
        fs::remove(made);
        return;
    }
    fs::copy_file(keptFile(golden), expected);
    writeHeatMap(difference, picture, kept);
    ADD_FAILURE() << name << ": " << describe(d, golden.limits) << "\n  picture    " << made
                  << "\n  expected   " << expected << "\n  difference " << difference;
}

void holdAllAgainstKept(const std::string& scene, const std::string& suffix = "") {
    const BakedExample baked(scene);
    for (const GoldenPicture& golden : goldenPictures())
        if (golden.scene == scene)
            holdAgainstKept(renderGolden(baked, golden), golden, golden.name() + suffix);
}

void keepAll(const std::string& scene) {
    const BakedExample baked(scene);
    for (const GoldenPicture& golden : goldenPictures())
        if (golden.scene == scene) writePng(keptFile(golden).string(), renderGolden(baked, golden));
}

class GoldenPictures : public ::testing::TestWithParam<std::string> {};

}  // namespace

TEST_P(GoldenPictures, AreAsKept) {
    if (updating())
        keepAll(GetParam());
    else
        holdAllAgainstKept(GetParam());
}

INSTANTIATE_TEST_SUITE_P(OfScene, GoldenPictures, ::testing::ValuesIn(scenes()),
                         [](const auto& scene) {
                             std::string name = scene.param;
                             std::erase(name, '-');
                             return name;
                         });

TEST(GoldenPictureSet, IsTheSameOnEveryInstructionSet) {
    const std::string best = currentInstructionSet();
    for (const std::string& set : availableInstructionSets()) {
        useInstructionSet(set);
        for (const char* scene : {"cornell", "mirror-room"}) holdAllAgainstKept(scene, "-" + set);
    }
    useInstructionSet(best);
}

TEST(GoldenPictureSet, OfOpenGlIsNearThatOfTheCpu) {
    for (const GoldenPicture& golden : goldenPictures()) {
        const fs::path byCpu = kKept / (golden.nameByCpu() + ".png");
        if (!golden.openGl || !fs::exists(byCpu)) continue;
        const PictureDifference d =
            difference(readImage(keptFile(golden).string()), readImage(byCpu.string()));
        EXPECT_LT(d.flip, 0.02) << golden.name();
    }
}

TEST(GoldenPictureSet, HoldsNothingThatIsNotTested) {
    std::set<fs::path> tested, kept;
    for (const GoldenPicture& golden : goldenPictures()) tested.insert(keptFile(golden));
    for (const auto& entry : fs::directory_iterator(kKept)) kept.insert(entry.path());
    EXPECT_EQ(kept, tested);
}

}  // namespace vlf::test
