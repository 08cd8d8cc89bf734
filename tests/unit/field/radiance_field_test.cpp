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

/// One direction of 2, with rows of charts 3 and 7; chart 7 covers two rows of tiles of 4 x 4: two
/// from tile (1, 2) on and one at (2, 3). The distance of each element is its index.
RadianceField makeField() {
    RadianceField field;
    field.lines = 1, field.cells = 16, field.tileSize = 4, field.maxDistance = 1;
    field.firstRow = {0, 3, 3};
    field.rows = {{3, 0, 0, 1, 0}, {7, 1, 2, 2, 16}, {7, 2, 3, 1, 48}};
    for (std::uint16_t i = 0; i < 64; ++i) field.elements.push_back({0, i});
    return field;
}

TEST(RadianceField, FindsTheRowsOfAChartInADirection) {
    const RadianceField field = makeField();
    EXPECT_EQ(field.rowsOf(0, 3).data(), &field.rows[0]);
    EXPECT_EQ(field.rowsOf(0, 3).size(), 1u);
    EXPECT_EQ(field.rowsOf(0, 7).data(), &field.rows[1]);
    EXPECT_EQ(field.rowsOf(0, 7).size(), 2u);
    EXPECT_TRUE(field.rowsOf(0, 5).empty());
    EXPECT_TRUE(field.rowsOf(0, 9).empty());
    EXPECT_TRUE(field.rowsOf(1, 3).empty());
}

TEST(RadianceField, ElementsLieTileByTile) {
    const RadianceField field = makeField();
    const auto rows = field.rowsOf(0, 7);
    EXPECT_EQ(field.element(rows, 4, 8)->distance, 16);    // first cell of the first tile
    EXPECT_EQ(field.element(rows, 5, 8)->distance, 17);    // next in its row
    EXPECT_EQ(field.element(rows, 4, 9)->distance, 20);    // next row
    EXPECT_EQ(field.element(rows, 8, 8)->distance, 32);    // next tile
    EXPECT_EQ(field.element(rows, 11, 11)->distance, 47);  // last cell of the row of tiles
    EXPECT_EQ(field.element(rows, 8, 12)->distance, 48);   // next row of tiles
    EXPECT_EQ(field.element(rows, 11, 15)->distance, 63);  // last cell of all
}

TEST(RadianceField, HasNoElementBeyondTheRows) {
    const RadianceField field = makeField();
    const auto rows = field.rowsOf(0, 7);
    for (const auto& [x, y] : {std::pair(3, 8), {12, 8}, {4, 7}, {4, 12}, {8, 16}, {-1, -1}})
        EXPECT_EQ(field.element(rows, x, y), nullptr) << x << ' ' << y;
    EXPECT_EQ(field.element({}, 4, 8), nullptr);
}

TEST(RadianceField, ElementsKeepTheirRadianceInSixBytes) {
    const RadianceElement element(0x89abcdefu, 77);
    EXPECT_EQ(element.rgb9e5(), 0x89abcdefu);
    EXPECT_EQ(element.distance, 77);
}

}  // namespace
}  // namespace vlf
