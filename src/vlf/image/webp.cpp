#include "vlf/image/webp.h"

#include "vlf/base/error.h"
#include "vlf/image/image_size.h"

#include <cstring>

#include <webp/decode.h>

namespace vlf {

bool isWebp(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
           std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

DecodedImage decodeWebp(std::span<const std::uint8_t> bytes, const std::string& name) {
    DecodedImage image;
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK)
        throw InputError(name + ": damaged image: the header of a WebP file ends early");
    image.width = features.width;
    image.height = features.height;
    image.hasAlpha = features.has_alpha != 0;
    requireImageSize(image.width, image.height, bytes.size(), name);
    image.srgb8.resize(4 * static_cast<std::size_t>(image.width) * image.height);
    if (!WebPDecodeRGBAInto(bytes.data(), bytes.size(), image.srgb8.data(), image.srgb8.size(),
                            4 * image.width))
        throw InputError(name + ": damaged image: not a whole still picture in WebP");
    return image;
}

}  // namespace vlf
