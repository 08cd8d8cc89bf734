#include "vlf/base/error.h"
#include "vlf/base/file.h"
#include "vlf/image/image_io.h"

#include "temporary_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfTiledOutputFile.h>

namespace vlf {
namespace {

/// Values of all magnitudes, and those that are no numbers.
Image wildImage(int width, int height) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const float t = static_cast<float>(i);
        image.pixels[i] = {t / 7, -1e-30f * t, 1e30f * std::sin(t)};
    }
    image.pixels.front() = {std::numeric_limits<float>::infinity(), -0.0f,
                            std::numeric_limits<float>::denorm_min()};
    image.pixels.back().x = std::numeric_limits<float>::quiet_NaN();
    return image;
}

void expectSameBits(const Image& a, const Image& b) {
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), sizeof(Vec3) * a.pixels.size()), 0);
}

/// Channels of two by two pixels given in reading order.
class ExrFile {
  public:
    explicit ExrFile(const Imath::Box2i& window) : header_(window, window) {}

    template <class T>
    ExrFile& add(const char* name, Imf::PixelType type, std::vector<T>& values) {
        const Imath::Box2i& window = header_.dataWindow();
        header_.channels().insert(name, Imf::Channel(type));
        pixels_.insert(name, Imf::Slice::Make(type, values.data(), window, sizeof(T),
                                              sizeof(T) * (window.size().x + 1)));
        return *this;
    }

    void write(const std::string& path) {
        Imf::OutputFile file(path.c_str(), header_);
        file.setFrameBuffer(pixels_);
        file.writePixels(header_.dataWindow().size().y + 1);
    }

    void writeTiled(const std::string& path) {
        header_.setTileDescription({1, 2});
        Imf::TiledOutputFile file(path.c_str(), header_);
        file.setFrameBuffer(pixels_);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    }

  private:
    Imf::Header header_;
    Imf::FrameBuffer pixels_;
};

const Imath::Box2i kWindow({-3, 7}, {-2, 8});

std::string messageOf(const std::string& path) {
    try {
        readImage(path);
    } catch (const InputError& e) {
        return e.what();
    }
    return "";
}

TEST(Exr, RoundTripKeepsEveryBit) {
    const test::TemporaryFolder folder;
    for (const auto& [width, height] : {std::pair{37, 21}, {1, 1}, {1, 50}, {50, 1}}) {
        const Image image = wildImage(width, height);
        writeExr(folder.path("a.exr"), image);
        expectSameBits(readImage(folder.path("a.exr")), image);
    }
}

TEST(Exr, KeepsStringAttributes) {
    const test::TemporaryFolder folder;
    writeExr(folder.path("a.exr"), Image(2, 2), {{"spp", "64"}, {"scene", "room.obj"}});
    const Imf::InputFile file(folder.path("a.exr").c_str());
    EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("spp").value(), "64");
    EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("scene").value(), "room.obj");
}

TEST(Exr, ReadsHalfChannelsOfAnOffsetDataWindow) {
    const test::TemporaryFolder folder;
    std::vector<Imath::half> r{0.5f, 1, 2, 4}, g{1, 1, 1, 8};
    ExrFile(kWindow).add("R", Imf::HALF, r).add("G", Imf::HALF, g).write(folder.path("a.exr"));
    const Image image = readImage(folder.path("a.exr"));
    ASSERT_EQ(image.width, 2);
    ASSERT_EQ(image.height, 2);
    EXPECT_EQ(image.at(0, 0), Vec3(0.5f, 1, 0)) << "a missing channel is 0";
    EXPECT_EQ(image.at(1, 0), Vec3(1, 1, 0));
    EXPECT_EQ(image.at(0, 1), Vec3(2, 1, 0));
    EXPECT_EQ(image.at(1, 1), Vec3(4, 8, 0));
}

TEST(Exr, ReadsLuminanceAsGrey) {
    const test::TemporaryFolder folder;
    std::vector<float> y{1, 2, 3, 4};
    ExrFile(kWindow).add("Y", Imf::FLOAT, y).write(folder.path("a.exr"));
    const Image image = readImage(folder.path("a.exr"));
    EXPECT_EQ(image.at(1, 0), Vec3(2));
    EXPECT_EQ(image.at(0, 1), Vec3(3));
}

TEST(Exr, ReadsTiles) {
    const test::TemporaryFolder folder;
    std::vector<float> r{1, 2, 3, 4};
    ExrFile(kWindow).add("R", Imf::FLOAT, r).writeTiled(folder.path("a.exr"));
    EXPECT_EQ(readImage(folder.path("a.exr")).at(1, 1), Vec3(4, 0, 0));
}

TEST(Exr, NamesTheChannelsOfAFileWithoutColour) {
    const test::TemporaryFolder folder;
    std::vector<float> z{1, 2, 3, 4};
    ExrFile(kWindow).add("depth", Imf::FLOAT, z).write(folder.path("a.exr"));
    EXPECT_NE(messageOf(folder.path("a.exr")).find("depth"), std::string::npos);
}

TEST(Exr, IsAnHdrTexture) {
    const test::TemporaryFolder folder;
    writeExr(folder.path("a.exr"), Image(3, 2, Vec3(5, 6, 7)));
    const DecodedImage texture = readTextureImage(folder.path("a.exr"));
    EXPECT_EQ(texture.width, 3);
    EXPECT_TRUE(texture.srgb8.empty());
    ASSERT_EQ(texture.linear.size(), 6u);
    EXPECT_EQ(texture.linear[4], Vec3(5, 6, 7));
}

TEST(Exr, RejectsEveryTruncation) {
    const test::TemporaryFolder folder;
    writeExr(folder.path("a.exr"), wildImage(16, 40));
    const std::vector<std::uint8_t> bytes = readFile(folder.path("a.exr"));
    for (std::size_t size = 0; size < bytes.size(); size += 7)
        EXPECT_THROW(decodeImage({bytes.data(), size}, "cut"), InputError) << size << " bytes";
}

TEST(Exr, SurvivesDamagedBytes) {
    const test::TemporaryFolder folder;
    writeExr(folder.path("a.exr"), wildImage(16, 40), {{"note", "text"}});
    const std::vector<std::uint8_t> bytes = readFile(folder.path("a.exr"));
    for (std::size_t at = 0; at < std::min<std::size_t>(bytes.size(), 600); ++at) {
        std::vector<std::uint8_t> damaged = bytes;
        damaged[at] ^= static_cast<std::uint8_t>(1 + 37 * at);
        try {
            decodeImage(damaged, "damaged");
        } catch (const InputError&) {
        }
    }
}

/// What reading a picture says whose data window has these corners: left, top, right, bottom.
std::string messageOfWindow(const std::array<std::int32_t, 4>& corners) {
    const test::TemporaryFolder folder;
    writeExr(folder.path("a.exr"), Image(4, 4));
    std::vector<std::uint8_t> bytes = readFile(folder.path("a.exr"));
    const std::string name = "dataWindow";
    const auto window = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
    EXPECT_NE(window, bytes.end());
    std::memcpy(&*window + name.size() + 1 + sizeof("box2i") + 4, corners.data(), sizeof corners);
    writeFile(folder.path("b.exr"), bytes);
    return messageOf(folder.path("b.exr"));
}

TEST(Exr, RejectsASizeThatTheFileCannotHold) {
    EXPECT_EQ(messageOfWindow({0, 0, 3, 3}), "");
    EXPECT_NE(messageOfWindow({0, 0, 30000, 30000}), "");
}

TEST(Exr, RejectsADataWindowFarFromTheOrigin) {
    constexpr std::int32_t kFar = 0x2c2c2c2c;
    EXPECT_NE(messageOfWindow({kFar, kFar, kFar + 3, kFar + 3}).find("the header is not valid"),
              std::string::npos);
}

TEST(Exr, RejectsAnAttributeLargerThanTheFile) {
    const test::TemporaryFolder folder;
    writeExr(folder.path("a.exr"), Image(4, 4), {{"note", "text"}});
    std::vector<std::uint8_t> bytes = readFile(folder.path("a.exr"));
    const std::string name = "note";
    const auto note = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
    ASSERT_NE(note, bytes.end());
    const std::int32_t size = 0x7f000000;
    std::memcpy(&*note + name.size() + 1 + sizeof("string"), &size, sizeof size);
    EXPECT_THROW(decodeImage(bytes, "large attribute"), InputError);
}

TEST(Exr, RefusesDeepDataAtOnce) {
    const test::TemporaryFolder folder;
    writeExr(folder.path("a.exr"), Image(4, 4));
    std::vector<std::uint8_t> bytes = readFile(folder.path("a.exr"));
    bytes[5] |= 8;  // bit 11 of the version field
    writeFile(folder.path("b.exr"), bytes);
    EXPECT_NE(messageOf(folder.path("b.exr")).find("deep data"), std::string::npos);
}

TEST(Exr, RefusesToWriteAnEmptyImage) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(writeExr(folder.path("a.exr"), Image()), InputError);
    EXPECT_EQ(folder.fileCount(), 0);
}

}  // namespace
}  // namespace vlf
