#include "vlf/image/jpeg.h"

#include "vlf/base/error.h"
#include "vlf/image/image_size.h"

#include <cstring>
#include <memory>
#include <type_traits>

#include <turbojpeg.h>

namespace vlf {

namespace {

/// What decoding says of a file that was cut off; the rest of its picture is grey.
constexpr char kEndsEarly[] = "Premature end of JPEG file";

/// A file has a bit at least for a block of 8 x 8 pixels, of which components of different sampling
/// share half.
constexpr double kMostPixelsPerByte = 1024;

struct Destroy {
    void operator()(void* decoder) const { tjDestroy(decoder); }
};
using Decoder = std::unique_ptr<std::remove_pointer_t<tjhandle>, Destroy>;

[[noreturn]] void damaged(const std::string& name, const char* what) {
    throw InputError(name + ": damaged image: " + what);
}

/// Warnings are of what encoders do, too: bytes between segments, say.
void check(const Decoder& decoder, int result, const std::string& name) {
    if (result == 0) return;
    const char* what = tjGetErrorStr2(decoder.get());
    if (std::strstr(what, kEndsEarly)) damaged(name, "the file ends early");
    if (tjGetErrorCode(decoder.get()) != TJERR_WARNING) damaged(name, what);
}

/// Of inverted inks in place of RGBA.
void mixInks(std::vector<std::uint8_t>& cmyk) {
    for (std::size_t i = 0; i < cmyk.size(); i += 4) {
        for (std::size_t c = 0; c < 3; ++c)
            cmyk[i + c] = static_cast<std::uint8_t>(cmyk[i + c] * cmyk[i + 3] / 255);
        cmyk[i + 3] = 255;
    }
}

}  // namespace

bool isJpeg(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 2 && bytes[0] == 0xff && bytes[1] == 0xd8;
}

DecodedImage decodeJpeg(std::span<const std::uint8_t> bytes, const std::string& name) {
    const Decoder decoder(tjInitDecompress());
    if (!decoder) throw InputError(name + ": no memory to decode a JPEG");
    DecodedImage image;
    int sampling = 0, colours = 0;
    check(decoder,
          tjDecompressHeader3(decoder.get(), bytes.data(), bytes.size(), &image.width,
                              &image.height, &sampling, &colours),
          name);
    requireImageSize(image.width, image.height, bytes.size(), name, kMostPixelsPerByte);
    image.srgb8.resize(4 * static_cast<std::size_t>(image.width) * image.height);
    const bool inks = colours == TJCS_CMYK || colours == TJCS_YCCK;
    check(decoder,
          tjDecompress2(decoder.get(), bytes.data(), bytes.size(), image.srgb8.data(), image.width,
                        0, image.height, inks ? TJPF_CMYK : TJPF_RGBA, TJFLAG_LIMITSCANS),
          name);
    if (inks) mixInks(image.srgb8);
    return image;
}

}  // namespace vlf
