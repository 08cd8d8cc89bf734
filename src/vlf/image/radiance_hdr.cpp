#include "vlf/image/radiance_hdr.h"

#include "vlf/base/error.h"
#include "vlf/image/image_size.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace vlf {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

class ByteReader {
  public:
    ByteReader(std::span<const std::uint8_t> bytes, const std::string& name)
        : bytes_(bytes), name_(name) {}

    std::uint8_t next() {
        if (position_ == bytes_.size()) fail("the file ends early");
        return bytes_[position_++];
    }
    Rgbe nextPixel() { return {next(), next(), next(), next()}; }
    std::string nextLine() {
        std::string line;
        for (char c; (c = static_cast<char>(next())) != '\n';) line += c;
        return line;
    }
    [[noreturn]] void fail(const std::string& why) const {
        throw InputError(name_ + ": damaged HDR image: " + why);
    }

  private:
    std::span<const std::uint8_t> bytes_;
    const std::string& name_;
    std::size_t position_ = 0;
};

/// An image of the size that the header gives.
Image readHeader(ByteReader& reader, std::size_t fileBytes, const std::string& name) {
    bool rgbe = false;
    for (std::string line; !(line = reader.nextLine()).empty();)
        rgbe = rgbe || line == "FORMAT=32-bit_rle_rgbe";
    if (!rgbe) reader.fail("the format is not 32-bit_rle_rgbe");
    int width = 0, height = 0;
    if (std::sscanf(reader.nextLine().c_str(), "-Y %9d +X %9d", &height, &width) != 2)
        reader.fail("the size is not given as -Y height +X width");
    constexpr double kPixelsPerByte = 32;  // runs of 127 in each of four components
    requireImageSize(width, height, fileBytes, name, kPixelsPerByte);
    return Image(width, height);
}

/// One component of a row: runs (128 + length, value) and literal stretches (length, values...).
void readComponent(ByteReader& reader, std::vector<Rgbe>& row, int component) {
    for (std::size_t x = 0; x < row.size();) {
        const std::size_t code = reader.next(), length = code > 128 ? code - 128 : code;
        if (length == 0 || length > row.size() - x) reader.fail("a run leaves its row");
        const std::uint8_t first = reader.next();
        for (std::size_t i = 0; i < length; ++i)
            row[x++][component] = i == 0 || code > 128 ? first : reader.next();
    }
}

void readRow(ByteReader& reader, std::vector<Rgbe>& row) {
    const auto width = static_cast<int>(row.size());
    row[0] = reader.nextPixel();
    const bool encoded = width >= 8 && width < 32768 && row[0][0] == 2 && row[0][1] == 2 &&
                         row[0][2] * 256 + row[0][3] == width;
    if (encoded)
        for (int c = 0; c < 4; ++c) readComponent(reader, row, c);
    else
        for (int x = 1; x < width; ++x) row[x] = reader.nextPixel();
}

/// Mantissas of 8 bits with a common exponent in excess of 128; 0 stands for black.
Vec3 colorOf(const Rgbe& p) {
    if (p[3] == 0) return Vec3(0);
    return std::ldexp(1.0f, p[3] - (128 + 8)) * Vec3(p[0], p[1], p[2]);
}

}  // namespace

bool isRadianceHdr(std::span<const std::uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return text.starts_with("#?RADIANCE\n") || text.starts_with("#?RGBE\n");
}

Image decodeRadianceHdr(std::span<const std::uint8_t> bytes, const std::string& name) {
    ByteReader reader(bytes, name);
    Image image = readHeader(reader, bytes.size(), name);
    std::vector<Rgbe> row(image.width);
    for (int y = 0; y < image.height; ++y) {
        readRow(reader, row);
        std::transform(row.begin(), row.end(), &image.at(0, y), colorOf);
    }
    return image;
}

}  // namespace vlf
