#include "vlf/field/radiance_field.h"

#include "vlf/math/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>
#include <glm/common.hpp>

namespace vlf {
namespace {

float packingError(const Vec3& rgb) {
    const Vec3 error = glm::abs(unpackRgb9e5(packRgb9e5(rgb)) - rgb);
    return maxComponent(error);
}

TEST(Rgb9e5, ErrorIsBelowA512thOfTheLargestChannel) {
    RandomStream random(1, 0);
    for (int i = 0; i < 100000; ++i) {
        const float magnitude = std::exp2(-15 + 30 * random.next());
        const Vec3 rgb = magnitude * Vec3(random.next(), random.next(), random.next());
        ASSERT_LE(packingError(rgb), std::max(maxComponent(rgb) / 512, std::exp2(-25.0f)))
            << rgb.x << ' ' << rgb.y << ' ' << rgb.z;
    }
}

TEST(Rgb9e5, KeepsZeroAndPowersOfTwoExactly) {
    EXPECT_EQ(packRgb9e5(Vec3(0)), 0u);
    EXPECT_EQ(unpackRgb9e5(0), Vec3(0));
    for (int e = -15; e <= 15; ++e) EXPECT_EQ(packingError(Vec3(std::ldexp(1.0f, e))), 0) << e;
}

TEST(Rgb9e5, RoundingUpToTheNextPowerOfTwoMovesTheExponent) {
    const Vec3 justBelowTwo(std::nextafter(2.0f, 0.0f));
    EXPECT_EQ(unpackRgb9e5(packRgb9e5(justBelowTwo)), Vec3(2));
}

TEST(Rgb9e5, ClampsWhatItCannotHold) {
    EXPECT_EQ(unpackRgb9e5(packRgb9e5(Vec3(1e9f, 0, 0))), Vec3(65408, 0, 0));
    EXPECT_EQ(unpackRgb9e5(packRgb9e5(Vec3(-3, 1, 0))), Vec3(0, 1, 0));
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(unpackRgb9e5(packRgb9e5(Vec3(infinity, 0, 0))), Vec3(65408, 0, 0));
}

TEST(Rgb9e5, TinyValuesLoseAtMostHalfOfTheSmallestStep) {
    for (const float v : {1e-30f, 1e-7f, 1e-5f, 3e-5f})
        EXPECT_LE(packingError(Vec3(v)), std::exp2(-25.0f)) << v;
}

/// One direction of 2, with blocks of charts 3 and 7; chart 7 covers 2 x 1 tiles of 4 x 4 from
/// tile (1, 2) on. The distance of each element is its index.
RadianceField makeField() {
    RadianceField field;
    field.lines = 1, field.cells = 16, field.tileSize = 4, field.maxDistance = 1;
    field.firstBlock = {0, 2, 2};
    field.blocks = {{3, 0, 0, 1, 1, 0}, {7, 1, 2, 2, 1, 16}};
    for (std::uint16_t i = 0; i < 48; ++i) field.elements.push_back({0, i});
    return field;
}

TEST(RadianceField, FindsTheBlockOfAChartInADirection) {
    const RadianceField field = makeField();
    EXPECT_EQ(field.find(0, 3), &field.blocks[0]);
    EXPECT_EQ(field.find(0, 7), &field.blocks[1]);
    EXPECT_EQ(field.find(0, 5), nullptr);
    EXPECT_EQ(field.find(0, 9), nullptr);
    EXPECT_EQ(field.find(1, 3), nullptr);
}

TEST(RadianceField, ElementsLieTileByTile) {
    const RadianceField field = makeField();
    const TileBlock& block = field.blocks[1];
    EXPECT_EQ(field.element(block, 4, 8)->distance, 16);    // first cell of the first tile
    EXPECT_EQ(field.element(block, 5, 8)->distance, 17);    // next in its row
    EXPECT_EQ(field.element(block, 4, 9)->distance, 20);    // next row
    EXPECT_EQ(field.element(block, 8, 8)->distance, 32);    // next tile
    EXPECT_EQ(field.element(block, 11, 11)->distance, 47);  // last cell of all
}

TEST(RadianceField, HasNoElementBeyondABlock) {
    const RadianceField field = makeField();
    const TileBlock& block = field.blocks[1];
    for (const auto& [x, y] : {std::pair(3, 8), {12, 8}, {4, 7}, {4, 12}, {-1, -1}})
        EXPECT_EQ(field.element(block, x, y), nullptr) << x << ' ' << y;
}

}  // namespace
}  // namespace vlf
