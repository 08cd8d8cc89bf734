#include "vlf/scene/environment.h"

#include "vlf/base/error.h"
#include "vlf/image/image_io.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <glm/common.hpp>

namespace vlf {

namespace {

constexpr float kBrightest = 1e9f;

float fraction(float x) {
    const float f = x - std::floor(x);
    return f < 1 ? f : 0;
}

}  // namespace

Vec2 skyCoordinates(const Environment& environment, const Vec3& direction) {
    const float azimuth = std::atan2(direction.x, -direction.z);
    const float polar = std::atan2(std::hypot(direction.x, direction.z), direction.y);
    return {fraction(0.5f + azimuth / (2 * kPi) + environment.turn / 360), polar / kPi};
}

Vec3 skyDirection(const Environment& environment, const Vec2& place) {
    const float azimuth = 2 * kPi * (place.x - 0.5f - environment.turn / 360);
    const float polar = kPi * place.y, s = std::sin(polar);
    return {s * std::sin(azimuth), std::cos(polar), -s * std::cos(azimuth)};
}

SkyPixels::SkyPixels(int width, int height, const Vec2& place) {
    const float x = place.x * static_cast<float>(width) - 0.5f;
    const float y = std::clamp(place.y * static_cast<float>(height) - 0.5f, 0.0f,
                               static_cast<float>(height - 1));
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(y);
    const float s = x - static_cast<float>(left), t = y - static_cast<float>(top);
    for (int k = 0; k < 4; ++k) {
        const int column = (left + (k & 1) + width) % width;
        const int row = std::min(top + (k >> 1), height - 1);
        index[k] = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(column);
        weight[k] = ((k & 1) != 0 ? s : 1 - s) * (k >> 1 != 0 ? t : 1 - t);
    }
}

Vec3 skyRadiance(const Environment& environment, const Vec3& direction) {
    if (environment.isUniform()) return environment.radiance;
    const Image& picture = environment.picture;
    const SkyPixels pixels(picture.width, picture.height, skyCoordinates(environment, direction));
    Vec3 sum(0);
    for (int k = 0; k < 4; ++k) sum += pixels.weight[k] * picture.pixels[pixels.index[k]];
    return environment.radiance * sum;
}

Environment readEnvironment(const std::string& path) {
    Environment environment;
    environment.name = std::filesystem::path(path).filename().string();
    environment.radiance = Vec3(1);
    environment.picture = readImage(path);
    Image& picture = environment.picture;
    if (picture.width != 2 * picture.height)
        throw InputError({path, 0, ""},
                         fmt::format("{} x {} pixels: the picture of an environment must be "
                                     "equirectangular, twice as wide as high",
                                     picture.width, picture.height));
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        Vec3& pixel = picture.pixels[i];
        if (!isFinite(pixel) || maxComponent(pixel) > kBrightest) {
            const auto width = static_cast<std::size_t>(picture.width);
            throw InputError({path, 0, fmt::format("pixel {}, {}", i % width, i / width)},
                             "is not a radiance: it must be finite and at most 1e9");
        }
        pixel = glm::max(pixel, Vec3(0));
    }
    return environment;
}

}  // namespace vlf
