#include "vlf/io/byte_stream.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

TEST(ByteStream, StoresLittleEndianWithoutPadding) {
    ByteWriter writer;
    writer(std::uint16_t{0x0102}, std::string("ab"), true, std::uint32_t{0x0a0b0c0d});
    const std::vector<std::uint8_t> expected = {2,   1, 2,    0,    0,    0,   'a',
                                                'b', 1, 0x0d, 0x0c, 0x0b, 0x0a};
    EXPECT_EQ(writer.take(), expected);
}

TEST(ByteStream, ReadsWhatWasWritten) {
    const std::vector<std::string> names = {"", "one", "zwei ä"};
    ByteWriter writer;
    writer(names, Vec3(1, -2, 3.5f), -7, 1e300);
    const std::vector<std::uint8_t> bytes = writer.take();
    ByteReader reader(bytes, {});
    std::vector<std::string> readNames;
    Vec3 v;
    int i = 0;
    double d = 0;
    reader(readNames, v, i, d);
    EXPECT_NO_THROW(reader.expectEnd());
    EXPECT_EQ(readNames, names);
    EXPECT_EQ(v, Vec3(1, -2, 3.5f));
    EXPECT_EQ(i, -7);
    EXPECT_EQ(d, 1e300);
}

TEST(ByteStream, LyingLengthsAreInputErrors) {
    const std::vector<std::uint8_t> bytes = {0xff, 0xff, 0xff, 0xff, 1, 2, 3};
    std::string text;
    EXPECT_THROW(ByteReader(bytes, {})(text), InputError);
    std::vector<std::uint32_t> numbers;
    EXPECT_THROW(ByteReader(bytes, {})(numbers), InputError);
}

TEST(ByteStream, LeftOverBytesAreAnInputErrorAtThePlace) {
    const std::vector<std::uint8_t> bytes = {1, 2};
    ByteReader reader(bytes, {"a.vlf", 0, "chunk x"});
    std::uint8_t byte = 0;
    reader(byte);
    try {
        reader.expectEnd();
        FAIL();
    } catch (const InputError& e) {
        EXPECT_EQ(std::string(e.what()).rfind("a.vlf: chunk x: ", 0), 0u) << e.what();
    }
}

}  // namespace
}  // namespace vlf
