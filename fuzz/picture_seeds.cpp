#include "fuzz/scratch.h"
#include "fuzz/seeds.h"

#include "vlf/base/file.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <stb_image_write.h>

#include <string>

namespace vlf::fuzz {

namespace {

constexpr int kSide = 9;

void appendBytes(void* target, void* data, int count) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    static_cast<Blob*>(target)->insert(static_cast<Blob*>(target)->end(), first, first + count);
}

/// Bytes of a picture of kSide x kSide pixels of three or four channels.
Blob pixels(int channels) {
    Blob values;
    for (int i = 0; i < channels * kSide * kSide; ++i)
        values.push_back(static_cast<std::uint8_t>(i * 37 % 251));
    return values;
}

std::vector<Blob> stbFiles() {
    std::vector<Blob> files(5);
    const Blob rgb = pixels(3), rgba = pixels(4);
    std::vector<float> radiance;
    for (const std::uint8_t value : rgb) radiance.push_back(value / 16.0f);
    stbi_write_png_to_func(appendBytes, &files[0], kSide, kSide, 4, rgba.data(), 4 * kSide);
    stbi_write_jpg_to_func(appendBytes, &files[1], kSide, kSide, 3, rgb.data(), 80);
    stbi_write_bmp_to_func(appendBytes, &files[2], kSide, kSide, 3, rgb.data());
    stbi_write_tga_to_func(appendBytes, &files[3], kSide, kSide, 4, rgba.data());
    stbi_write_hdr_to_func(appendBytes, &files[4], kSide, kSide, 3, radiance.data());
    return files;
}

void append32(Blob& to, std::size_t value) {
    for (const int shift : {24, 16, 8, 0}) to.push_back(static_cast<std::uint8_t>(value >> shift));
}

/// With a checksum that is wrong: nobody who reads these looks at it.
void appendChunk(Blob& png, const std::string& type, const Blob& data) {
    append32(png, data.size());
    png.insert(png.end(), type.begin(), type.end());
    png.insert(png.end(), data.begin(), data.end());
    append32(png, 0);
}

/// The kinds of PNG that stb does not write, of one stored block. `content` are the rows with their
/// filters.
Blob png(int width, int height, int bits, int colourType, bool interlaced, const Blob& content) {
    Blob file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}, header, data{0x78, 0x01, 1};
    append32(header, width);
    append32(header, height);
    for (const int value : {bits, colourType, 0, 0, interlaced ? 1 : 0})
        header.push_back(static_cast<std::uint8_t>(value));
    appendChunk(file, "IHDR", header);
    constexpr int kPalette = 3;
    if (colourType == kPalette) {
        appendChunk(file, "PLTE", {10, 20, 30, 200, 100, 0});
        appendChunk(file, "tRNS", {255, 0});
    }
    const std::size_t size = content.size(), complement = ~size;
    for (const std::size_t value : {size, size >> 8, complement, complement >> 8})
        data.push_back(static_cast<std::uint8_t>(value));
    data.insert(data.end(), content.begin(), content.end());
    append32(data, 0);
    appendChunk(file, "IDAT", data);
    appendChunk(file, "IEND", {});
    return file;
}

std::vector<Blob> rarePngs() {
    constexpr int kGrey = 0, kRgb = 2, kPalette = 3;
    return {png(2, 2, 16, kRgb, false, Blob(26, 1)), png(9, 2, 1, kPalette, false, Blob(6, 0)),
            png(5, 2, 2, kGrey, false, Blob(6, 2)), png(2, 2, 8, kGrey, true, Blob(8, 0))};
}

/// An EXR file of the channel names' letters.
Blob exr(const std::string& channels, Imf::Compression compression, bool tiled) {
    Imf::Header header(kSide, kSide);
    header.compression() = compression;
    std::vector<float> values(kSide * kSide);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 7) / 3;
    Imf::FrameBuffer source;
    for (const char name : channels) {
        header.channels().insert(std::string(1, name), Imf::Channel(Imf::FLOAT));
        source.insert(std::string(1, name),
                      Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                                 kSide * sizeof(float)));
    }
    const std::string path = scratchPath("seed.exr");
    if (tiled) {
        header.setTileDescription({4, 4});
        Imf::TiledOutputFile file(path.c_str(), header);
        file.setFrameBuffer(source);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
        Imf::OutputFile file(path.c_str(), header);
        file.setFrameBuffer(source);
        file.writePixels(kSide);
    }
    return readFile(path);
}

std::vector<Blob> exrFiles() {
    std::vector<Blob> files{exr("Y", Imf::NO_COMPRESSION, false),
                            exr("RGB", Imf::ZIP_COMPRESSION, true)};
    for (const Imf::Compression compression :
         {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
          Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION,
          Imf::DWAA_COMPRESSION})
        files.push_back(exr("BGR", compression, false));
    return files;
}

}  // namespace

std::vector<Blob> pictureSeeds() {
    std::vector<Blob> all = stbFiles();
    for (const auto& files : {rarePngs(), exrFiles()})
        all.insert(all.end(), files.begin(), files.end());
    return all;
}

}  // namespace vlf::fuzz
