#include "vlf/image/image_io.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"
#include "vlf/image/exr.h"
#include "vlf/image/image_size.h"
#include "vlf/image/jpeg.h"
#include "vlf/image/radiance_hdr.h"
#include "vlf/image/srgb.h"
#include "vlf/image/webp.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <stb_image.h>
#include <stb_image_write.h>

namespace vlf {

namespace {

using Bytes = std::span<const std::uint8_t>;

template <class T>
using StbPixels = std::unique_ptr<T[], decltype(&stbi_image_free)>;

bool startsWith(Bytes bytes, Bytes start) {
    return bytes.size() >= start.size() && std::equal(start.begin(), start.end(), bytes.begin());
}

/// What stb reads but is not trusted with: formats whose decoders do not stand damaged files, and
/// JPEGs behind fill bytes.
bool isRefused(Bytes bytes) {
    constexpr std::uint8_t kGif[] = {'G', 'I', 'F'}, kPsd[] = {'8', 'B', 'P', 'S'},
                           kPic[] = {0x53, 0x80, 0xf6, 0x34}, kFill[] = {0xff, 0xff},
                           kPnm5[] = {'P', '5'}, kPnm6[] = {'P', '6'};
    return startsWith(bytes, kGif) || startsWith(bytes, kPsd) || startsWith(bytes, kPic) ||
           startsWith(bytes, kFill) || startsWith(bytes, kPnm5) || startsWith(bytes, kPnm6);
}

constexpr std::uint8_t kPng[] = {0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a};

/// Bits of a pixel by the header of a PNG: its depth times the channels of its colour type. stb
/// takes what is cut off as zeros.
int pngBitsPerPixel(Bytes png) {
    constexpr std::size_t kDepth = 24, kColourType = 25;
    constexpr std::array<int, 7> kChannels{1, 1, 3, 1, 2, 1, 4};
    if (png.size() <= kColourType) return 1;
    const std::uint8_t type = png[kColourType];
    return std::max<int>(1, png[kDepth]) * (type < kChannels.size() ? kChannels[type] : 1);
}

/// Most pixels that a byte of a file may stand for. Deflate yields at most 1032 bytes per byte; no
/// other format comes near.
double mostPixelsPerByte(Bytes bytes) {
    return startsWith(bytes, kPng) ? 1032.0 * 8 / pngBitsPerPixel(bytes) : 1024;
}

/// Checks what the header says and returns the size through the image.
template <class AnyImage>
void readSize(Bytes bytes, const std::string& name, AnyImage& image) {
    int channels = 0;
    if (bytes.size() > INT_MAX) throw InputError(name + ": image files over 2 GB are not read");
    if (isRefused(bytes) || !stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()),
                                                   &image.width, &image.height, &channels))
        throw InputError(
            name +
            ": not an image that can be read (EXR, PNG, JPEG, HDR, TGA, BMP; of textures, WebP)");
    requireImageSize(image.width, image.height, bytes.size(), name, mostPixelsPerByte(bytes));
}

/// Follows the chunks of a PNG, each of a length, a type, data and a checksum, up to IEND.
bool hasAllPngChunks(Bytes bytes) {
    constexpr std::size_t kSignature = 8, kAround = 12;
    constexpr std::uint8_t kLast[] = {'I', 'E', 'N', 'D'};
    for (bytes = bytes.subspan(kSignature); bytes.size() >= kAround;) {
        const std::size_t length = std::size_t{bytes[0]} << 24 | std::size_t{bytes[1]} << 16 |
                                   std::size_t{bytes[2]} << 8 | bytes[3];
        if (length > bytes.size() - kAround) return false;
        if (startsWith(bytes.subspan(4), kLast)) return true;
        bytes = bytes.subspan(length + kAround);
    }
    return false;
}

/// stb takes memory for what the chunk of a PNG claims to hold.
void requireWholeFile(Bytes bytes, const std::string& name) {
    if (startsWith(bytes, kPng) && !hasAllPngChunks(bytes))
        throw InputError(name + ": damaged image: the file ends early");
}

/// Pixels from one of stb's loaders, `channels` values each. `inFile`: how many the file has.
template <class T, class Load>
StbPixels<T> loadPixels(Load load, Bytes bytes, const std::string& name, int channels,
                        int& inFile) {
    int width = 0, height = 0;
    T* pixels =
        load(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &inFile, channels);
    if (!pixels) throw InputError(name + ": damaged image: " + stbi_failure_reason());
    return {pixels, stbi_image_free};
}

template <class T, class Decode>
std::vector<Vec3> toVectors(const T* values, std::size_t pixels, Decode decode) {
    std::vector<Vec3> result(pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        result[i] = {decode(values[3 * i]), decode(values[3 * i + 1]), decode(values[3 * i + 2])};
    return result;
}

/// Linear values of sRGB-encoded RGBA; alpha is left out.
Image linearImage(const DecodedImage& decoded) {
    Image image(decoded.width, decoded.height);
    const std::uint8_t* rgba = decoded.srgb8.data();
    for (std::size_t i = 0; i < image.pixels.size(); ++i, rgba += 4)
        image.pixels[i] = {linearFromSrgb8(rgba[0]), linearFromSrgb8(rgba[1]),
                           linearFromSrgb8(rgba[2])};
    return image;
}

std::vector<Vec3> decodeSrgb8(Bytes bytes, const std::string& name, std::size_t pixels) {
    int inFile = 0;
    const auto values = loadPixels<std::uint8_t>(stbi_load_from_memory, bytes, name, 3, inFile);
    return toVectors(values.get(), pixels, linearFromSrgb8);
}

std::vector<Vec3> decodeSrgb16(Bytes bytes, const std::string& name, std::size_t pixels) {
    int inFile = 0;
    const auto values = loadPixels<std::uint16_t>(stbi_load_16_from_memory, bytes, name, 3, inFile);
    return toVectors(values.get(), pixels,
                     [](std::uint16_t v) { return linearFromSrgb(static_cast<float>(v) / 65535); });
}

/// The image of a format that stores linear values; nothing for other formats.
std::optional<Image> decodeHighRange(Bytes bytes, const std::string& name) {
    if (isExr(bytes)) return decodeExr(bytes, name);
    if (isRadianceHdr(bytes)) return decodeRadianceHdr(bytes, name);
    return std::nullopt;
}

std::size_t pixelCount(int width, int height) {
    return static_cast<std::size_t>(width) * height;
}

void appendBytes(void* target, void* data, int count) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(target);
    bytes.insert(bytes.end(), first, first + count);
}

}  // namespace

DecodedImage decodeImage(Bytes bytes, const std::string& nameForErrors) {
    if (std::optional<Image> linear = decodeHighRange(bytes, nameForErrors))
        return {linear->width, linear->height, {}, std::move(linear->pixels)};
    if (isWebp(bytes)) return decodeWebp(bytes, nameForErrors);
    if (isJpeg(bytes)) return decodeJpeg(bytes, nameForErrors);
    DecodedImage image;
    readSize(bytes, nameForErrors, image);
    requireWholeFile(bytes, nameForErrors);
    int inFile = 0;
    const auto rgba =
        loadPixels<std::uint8_t>(stbi_load_from_memory, bytes, nameForErrors, 4, inFile);
    image.hasAlpha = inFile == 2 || inFile == 4;
    image.srgb8.assign(rgba.get(), rgba.get() + 4 * pixelCount(image.width, image.height));
    return image;
}

DecodedImage readTextureImage(const std::string& path) {
    return decodeImage(readFile(path), path);
}

Image readImage(const std::string& path) {
    const std::vector<std::uint8_t> bytes = readFile(path);
    if (std::optional<Image> linear = decodeHighRange(bytes, path)) return std::move(*linear);
    if (isJpeg(bytes)) return linearImage(decodeJpeg(bytes, path));
    Image image;
    readSize(bytes, path, image);
    requireWholeFile(bytes, path);
    const std::size_t pixels = pixelCount(image.width, image.height);
    const bool deep = stbi_is_16_bit_from_memory(bytes.data(), static_cast<int>(bytes.size()));
    image.pixels = deep ? decodeSrgb16(bytes, path, pixels) : decodeSrgb8(bytes, path, pixels);
    return image;
}

void writeExr(const std::string& path, const Image& image, const ImageAttributes& attributes) {
    writeFile(path, encodeExr(image, attributes));
}

void writePng(const std::string& path, const Image& image) {
    if (image.pixels.empty()) throw InputError("an image without pixels cannot be written as PNG");
    std::vector<std::uint8_t> rgb;
    rgb.reserve(3 * image.pixels.size());
    for (const Vec3& p : image.pixels)
        for (int c = 0; c < 3; ++c) rgb.push_back(srgb8FromLinear(p[c]));
    std::vector<std::uint8_t> png;
    if (!stbi_write_png_to_func(appendBytes, &png, image.width, image.height, 3, rgb.data(),
                                3 * image.width))
        throw FileError(path, "cannot encode as PNG: out of memory");
    writeFile(path, png);
}

}  // namespace vlf
