#include "fuzz/readers.h"
#include "fuzz/require.h"
#include "fuzz/scratch.h"

#include "vlf/image/image_io.h"
#include "vlf/io/field_file.h"
#include "vlf/io/validate.h"

#include <cmath>
#include <string>

namespace vlf::fuzz {

namespace {

void requireSound(const DecodedImage& image) {
    const std::size_t pixels = static_cast<std::size_t>(image.width) * image.height;
    require(image.width > 0 && image.height > 0 && pixels <= kMaxPixels, "of a size that is read");
    require(image.srgb8.empty() ? image.linear.size() == pixels
                                : image.srgb8.size() == 4 * pixels && image.linear.empty(),
            "of as many pixels as its size says");
}

void requireSound(const BakeRecord& record) {
    require(std::isfinite(record.texelSize) && std::isfinite(record.residual), "of finite numbers");
    for (const Vec3& power : {record.energy.emitted, record.energy.absorbed, record.energy.unshot,
                              record.energy.escaped})
        require(isFinite(power), "of finite powers");
}

void requireSound(const BakedRoom& room) {
    const LightField& field = room.field;
    requireAccepted([&] {
        checkScene(room.scene, "room");
        checkCharts(field, room.scene, "room");
        checkAtlas(field.atlas, "room");
        checkRadianceLayout(field.radiance, field.charts.size(), "room");
        checkRadianceElements(field.radiance, "room");
    });
    require(isFinite(field.frame.centre) && std::isfinite(field.frame.radius), "in a finite place");
    requireSound(field.record);
}

}  // namespace

bool readPicture(Bytes bytes) {
    const bool isTexture = isAccepted([&] { requireSound(decodeImage(bytes, "input")); });
    const bool isPicture = isAccepted([&] {
        const Image image = readImage(putFile("input.png", bytes));
        require(image.pixels.size() == static_cast<std::size_t>(image.width) * image.height,
                "of as many pixels as its size says");
    });
    require(isTexture == isPicture, "both as texture and as picture");
    return isTexture;
}

bool readFieldFile(Bytes bytes) {
    const std::string path = putFile("input.vlf", bytes);
    const bool isRead = isAccepted([&] { requireSound(readField(path)); });
    const bool isDescribed = isAccepted([&] { readFieldInfo(path); });
    require(!isRead || isDescribed, "by vlf info, too");
    return isRead;
}

}  // namespace vlf::fuzz
