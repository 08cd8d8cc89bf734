#include "vlf/image/image_io.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"
#include "vlf/image/srgb.h"
#include "vlf/math/random.h"

#include "temporary_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>
#include <stb_image_write.h>
#include <sys/resource.h>
#include <turbojpeg.h>

namespace vlf {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Every 8-bit value once in each channel.
Image allBytes() {
    Image image(16, 16);
    for (int i = 0; i < 256; ++i)
        image.pixels[i] = {linearFromSrgb8(static_cast<std::uint8_t>(i)),
                           linearFromSrgb8(static_cast<std::uint8_t>(255 - i)),
                           linearFromSrgb8(static_cast<std::uint8_t>(i ^ 85))};
    return image;
}

Bytes pngBytes(const test::TemporaryFolder& folder) {
    writePng(folder.path("source.png"), allBytes());
    return readFile(folder.path("source.png"));
}

Bytes jpegBytes(const test::TemporaryFolder& folder) {
    stbi_write_jpg(folder.path("a.jpg").c_str(), 64, 64, 3, Bytes(3 * 64 * 64, 9).data(), 90);
    return readFile(folder.path("a.jpg"));
}

TEST(Png, RoundTripKeepsEveryEncodedValue) {
    const test::TemporaryFolder folder;
    writePng(folder.path("a.png"), allBytes());
    const Image image = readImage(folder.path("a.png"));
    ASSERT_EQ(image.width, 16);
    ASSERT_EQ(image.height, 16);
    EXPECT_EQ(image.pixels, allBytes().pixels);
}

TEST(Png, IsEncodedAsSrgb) {
    const test::TemporaryFolder folder;
    Image image(2, 1);
    image.pixels = {{0.2159f, 0, 1}, {-1, 7, std::nanf("")}};  // 0.2159 is sRGB 128
    writePng(folder.path("a.png"), image);
    const DecodedImage decoded = readTextureImage(folder.path("a.png"));
    EXPECT_EQ(decoded.srgb8, (Bytes{128, 0, 255, 255, 0, 255, 0, 255}));
    EXPECT_TRUE(decoded.linear.empty());
}

TEST(Png, KeepsAlphaOfTextures) {
    const test::TemporaryFolder folder;
    const Bytes rgba{1, 2, 3, 4, 5, 6, 7, 8};
    stbi_write_png(folder.path("a.png").c_str(), 2, 1, 4, rgba.data(), 8);
    EXPECT_EQ(decodeImage(readFile(folder.path("a.png")), "texture").srgb8, rgba);
}

TEST(Jpeg, IsReadWithinItsLoss) {
    const test::TemporaryFolder folder;
    const Bytes grey(3 * 16 * 16, 100);
    stbi_write_jpg(folder.path("a.jpg").c_str(), 16, 16, 3, grey.data(), 95);
    EXPECT_NEAR(readImage(folder.path("a.jpg")).at(8, 8).y, linearFromSrgb8(100), 0.01f);
}

/// The message of the InputError that decoding the bytes must throw.
std::string errorOf(const Bytes& bytes) {
    try {
        decodeImage(bytes, "image");
    } catch (const InputError& e) {
        return e.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

/// A file of `pixels`, encoded by the format's own library.
Bytes encodeJpeg(const Bytes& pixels, int size, int format, int sampling, int flags) {
    const std::unique_ptr<void, int (*)(void*)> encoder(tjInitCompress(), tjDestroy);
    unsigned char* data = nullptr;
    unsigned long length = 0;
    if (tjCompress2(encoder.get(), pixels.data(), size, 0, size, format, &data, &length, sampling,
                    95, flags) != 0)
        throw std::runtime_error(tjGetErrorStr2(encoder.get()));
    const Bytes file(data, data + length);
    tjFree(data);
    return file;
}

TEST(Jpeg, MayBeGreyOrProgressive) {
    const Bytes grey(32 * 32, 100);
    const Bytes file = encodeJpeg(grey, 32, TJPF_GRAY, TJSAMP_GRAY, TJFLAG_PROGRESSIVE);
    const DecodedImage image = decodeImage(file, "grey");
    ASSERT_EQ(image.width, 32);
    EXPECT_EQ(Bytes(image.srgb8.begin(), image.srgb8.begin() + 4), (Bytes{100, 100, 100, 255}));
}

TEST(Jpeg, OfInksIsMixedFromThem) {
    Bytes inverted;  // of cyan a half, of black a fifth
    for (int i = 0; i < 32 * 32; ++i) inverted.insert(inverted.end(), {128, 255, 255, 204});
    const Bytes file = encodeJpeg(inverted, 32, TJPF_CMYK, TJSAMP_444, 0);
    const DecodedImage image = decodeImage(file, "inks");
    const std::array<int, 4> expected{102, 204, 204, 255};
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(image.srgb8[c], expected[c], 3) << c;
}

TEST(Jpeg, ThatWasCutWithinItsDataIsRefused) {
    Bytes noise(3 * 64 * 64);
    for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<std::uint8_t>(mixBits(i));
    Bytes file = encodeJpeg(noise, 64, TJPF_RGB, TJSAMP_420, 0);
    file.resize(file.size() / 2);
    EXPECT_NE(errorOf(file).find("ends early"), std::string::npos) << errorOf(file);
}

/// Bytes of a picture wide enough to be run-length encoded, and what it shows.
struct HdrFile {
    explicit HdrFile(const test::TemporaryFolder& folder) : image(20, 5) {
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i] = {std::exp2(static_cast<float>(i / 9)), 0.5f,
                               3e-5f * static_cast<float>(i % 13)};
        const std::string path = folder.path("source.hdr");
        stbi_write_hdr(path.c_str(), image.width, image.height, 3, &image.pixels[0].x);
        bytes = readFile(path);
    }
    Image image;
    Bytes bytes;
};

TEST(Hdr, IsReadAsLinearWithinItsMantissa) {
    const test::TemporaryFolder folder;
    const HdrFile file(folder);
    writeFile(folder.path("a.hdr"), file.bytes);
    const Image image = readImage(folder.path("a.hdr"));
    ASSERT_EQ(image.pixels.size(), file.image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(image.pixels[i][c], file.image.pixels[i][c],
                        maxComponent(file.image.pixels[i]) / 128);
    EXPECT_EQ(readTextureImage(folder.path("a.hdr")).linear, image.pixels);
}

TEST(Hdr, ReadsRowsThatAreNotEncoded) {
    const std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    Bytes bytes(text.begin(), text.end());
    bytes.insert(bytes.end(), {128, 64, 0, 129, 9, 9, 9, 0});
    const DecodedImage image = decodeImage(bytes, "flat");
    EXPECT_EQ(image.linear, (std::vector<Vec3>{{1, 0.5f, 0}, {0, 0, 0}}));
}

TEST(Hdr, RejectsEveryTruncation) {
    const test::TemporaryFolder folder;
    const HdrFile file(folder);
    for (std::size_t size = 0; size < file.bytes.size(); ++size)
        EXPECT_THROW(decodeImage({file.bytes.data(), size}, "cut"), InputError) << size;
}

TEST(Hdr, RejectsARunOfNothing) {
    const std::string text = "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n";
    Bytes bytes(text.begin(), text.end());
    bytes.insert(bytes.end(), {2, 2, 0, 8});
    bytes.resize(bytes.size() + 100, 0);
    EXPECT_THROW(decodeImage(bytes, "empty run"), InputError);
}

TEST(ImageFile, RejectsEveryTruncatedPng) {
    const test::TemporaryFolder folder;
    const Bytes png = pngBytes(folder);
    for (std::size_t size = 0; size < png.size(); ++size)
        EXPECT_THROW(decodeImage({png.data(), size}, "cut"), InputError) << size << " bytes";
}

TEST(ImageFile, RejectsAJpegBehindFillBytes) {
    const test::TemporaryFolder folder;
    Bytes jpeg = jpegBytes(folder);
    EXPECT_NO_THROW(decodeImage(jpeg, "whole"));
    jpeg.insert(jpeg.begin(), 2, 0xff);
    EXPECT_THROW(decodeImage(jpeg, "filled"), InputError);
}

TEST(ImageFile, RejectsATruncatedJpeg) {
    const test::TemporaryFolder folder;
    const Bytes jpeg = jpegBytes(folder);
    for (std::size_t size = 0; size < jpeg.size(); size += 11)
        EXPECT_THROW(decodeImage({jpeg.data(), size}, "cut"), InputError) << size << " bytes";
}

TEST(ImageFile, SurvivesDamagedBytes) {
    const test::TemporaryFolder folder;
    const Bytes png = pngBytes(folder);
    for (std::size_t at = 0; at < png.size(); ++at) {
        Bytes damaged = png;
        damaged[at] ^= static_cast<std::uint8_t>(1 + 37 * at);
        try {
            decodeImage(damaged, "damaged");
        } catch (const InputError&) {
        }
    }
}

TEST(ImageFile, RejectsASizeThatTheFileCannotHold) {
    const test::TemporaryFolder folder;
    Bytes png = pngBytes(folder);
    png[17] = png[21] = 0x3f;  // width and height of millions
    EXPECT_THROW(decodeImage(png, "huge"), InputError);
}

Bytes::iterator markerOf(Bytes& jpeg, std::uint8_t code) {
    const Bytes marker{0xff, code};
    return std::search(jpeg.begin(), jpeg.end(), marker.begin(), marker.end());
}

TEST(ImageFile, KnowsHowManyPixelsAByteOfItsFormatMayStandFor) {
    const test::TemporaryFolder folder;
    Bytes png = pngBytes(folder), jpeg = jpegBytes(folder);
    ASSERT_LT(png.size(), 1000u);
    png[18] = png[22] = 4;  // 1040 x 1040: of one bit each, but not of three bytes
    EXPECT_NE(errorOf(png).find("too short for 1040x1040"), std::string::npos) << errorOf(png);
    ASSERT_LT(jpeg.size(), 1000u);
    const auto frame = markerOf(jpeg, 0xc0);
    frame[5] = frame[7] = 8;  // 2112 x 2112
    EXPECT_NE(errorOf(jpeg).find("too short for 2112x2112"), std::string::npos) << errorOf(jpeg);
}

TEST(ImageFile, RefusesAJpegOfCountlessScans) {
    Bytes jpeg = encodeJpeg(Bytes(3 * 64 * 64, 9), 64, TJPF_RGB, TJSAMP_444, TJFLAG_PROGRESSIVE);
    const Bytes scanAgain(markerOf(jpeg, 0xda), jpeg.end() - 2);
    for (int i = 0; i < 500; ++i) jpeg.insert(jpeg.end() - 2, scanAgain.begin(), scanAgain.end());
    EXPECT_NE(errorOf(jpeg).find("more than 500 scans"), std::string::npos) << errorOf(jpeg);
}

TEST(ImageFile, RefusesAJpegWhoseTablesAreTooLarge) {
    const test::TemporaryFolder folder;
    Bytes jpeg = jpegBytes(folder);
    const auto tables = markerOf(jpeg, 0xc4);
    tables[5 + 15] = 250;  // codes of 16 bits, besides the twelve shorter ones
    EXPECT_NE(errorOf(jpeg).find("Bogus Huffman table"), std::string::npos) << errorOf(jpeg);
    tables[5 + 15] = 0;
    decodeImage(jpeg, "as it was");
}

TEST(ImageFile, NamesTheFileThatIsNoImage) {
    const test::TemporaryFolder folder;
    writeFile(folder.path("a.png"), Bytes{'t', 'e', 'x', 't'});
    try {
        readImage(folder.path("a.png"));
        FAIL() << "nothing was thrown";
    } catch (const InputError& e) {
        EXPECT_EQ(std::string(e.what()).find(folder.path("a.png")), 0u) << e.what();
    }
}

TEST(ImageFile, RefusesFormatsThatAreNotSupported) {
    const std::string gif = "GIF89a and more";
    EXPECT_THROW(decodeImage(Bytes(gif.begin(), gif.end()), "gif"), InputError);
}

TEST(ImageFile, EmptyBytesAreAnInputError) {
    EXPECT_THROW(decodeImage({}, "empty"), InputError);
}

TEST(ImageFile, MissingIsAFileError) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(readImage(folder.path("missing.png")), FileError);
    EXPECT_THROW(readTextureImage(folder.path("missing.exr")), FileError);
}

TEST(ImageFile, CannotBeWrittenIntoAMissingFolder) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(writeExr(folder.path("no/a.exr"), Image(2, 2)), FileError);
    EXPECT_THROW(writePng(folder.path("no/a.png"), Image(2, 2)), FileError);
    EXPECT_EQ(folder.fileCount(), 0);
}

/// Stands for a full disk: while it lives, no file of this process grows beyond some bytes.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) : oldHandler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit limit{bytes, old_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, oldHandler_);
    }

  private:
    rlimit old_{};
    void (*oldHandler_)(int);
};

TEST(ImageFile, SurvivesAFullDiskWhenRewritten) {
    const test::TemporaryFolder folder;
    writeExr(folder.path("a.exr"), Image(2, 2, Vec3(3)));
    Image noise(64, 64);
    for (std::size_t i = 0; i < noise.pixels.size(); ++i)
        noise.pixels[i] = Vec3(std::sin(1e4f * static_cast<float>(i)));
    {
        const FileSizeLimit limit(1000);
        EXPECT_THROW(writeExr(folder.path("a.exr"), noise), FileError);
    }
    EXPECT_EQ(folder.fileCount(), 1);
    EXPECT_EQ(readImage(folder.path("a.exr")).at(1, 1), Vec3(3));
}

}  // namespace
}  // namespace vlf
