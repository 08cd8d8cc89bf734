#include "vlf/io/radiance_codec.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

/// One tile of 2 x 2 cells, of which the third is not filled, and its bytes worked out by hand
/// from docs/file-format.md.
class OneTile : public testing::Test {
  protected:
    void SetUp() override {
        field.lines = 3;
        field.cells = 2;
        field.tileSize = 2;
        field.maxDistance = 1;
        field.firstRow = {0, 1, 1, 1, 1, 1, 1};
        TileRow row;
        row.chart = 0;
        row.tilesWide = 1;
        field.rows = {row};
        const std::uint32_t one = packRgb9e5(Vec3(1)), two = packRgb9e5(Vec3(2));
        field.elements = {{one, 1600}, {one, 1632}, {}, {two, 1616}};
    }
    RadianceField field;
    const std::vector<std::uint8_t> bytes = {
        0b1011,                                             // mask
        0,      0, 0, 0x7f, 0, 1, 0xff, 0, 0, 0xff, 0, 0,   // high bytes
        200,    4, 1, 0,    0, 0, 0xff, 0, 0, 0xff, 0, 0};  // low bytes
};

TEST_F(OneTile, IsEncodedAsDocumented) {
    EXPECT_EQ(TileGroups(field).encode(0), bytes);
}

TEST_F(OneTile, IsDecodedAsDocumented) {
    std::vector<RadianceElement> elements(4);
    ASSERT_TRUE(TileGroups(field).decode(0, bytes, elements));
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(elements[i].rgb9e5(), field.elements[i].rgb9e5()) << i;
        EXPECT_EQ(elements[i].distance, field.elements[i].distance) << i;
    }
}

TEST_F(OneTile, BytesOfAnotherLengthAreRefused) {
    std::vector<RadianceElement> elements(4);
    for (const std::size_t length : {0, 1, 24}) {
        const std::span part = std::span(bytes).first(length);
        EXPECT_FALSE(TileGroups(field).decode(0, part, elements)) << length;
    }
}

}  // namespace
}  // namespace vlf
