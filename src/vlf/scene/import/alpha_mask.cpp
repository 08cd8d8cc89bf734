#include "vlf/scene/import/alpha_mask.h"

#include "vlf/scene/texture_coordinates.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

std::uint8_t toByte(float opacity) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(opacity, 0.0f, 1.0f)));
}

std::uint8_t opacityOf(const std::uint8_t* rgba, AlphaSource source) {
    switch (source) {
        case AlphaSource::alpha:
            return rgba[3];
        case AlphaSource::red:
            return rgba[0];
        case AlphaSource::green:
            return rgba[1];
        case AlphaSource::blue:
            return rgba[2];
        default:
            return toByte(luminance(Vec3(rgba[0], rgba[1], rgba[2]) / 255.0f));
    }
}

std::uint8_t opacityOf(const Vec3& linear, AlphaSource source) {
    switch (source) {
        case AlphaSource::alpha:
            return 255;
        case AlphaSource::red:
            return toByte(linear.x);
        case AlphaSource::green:
            return toByte(linear.y);
        case AlphaSource::blue:
            return toByte(linear.z);
        default:
            return toByte(luminance(linear));
    }
}

}  // namespace

AlphaImage::AlphaImage(const DecodedImage& image, AlphaSource source, Wrap wrapU, Wrap wrapV)
    : wrapU_(wrapU), wrapV_(wrapV) {
    if (source == AlphaSource::alphaOrLuminance)
        source = image.hasAlpha ? AlphaSource::alpha : AlphaSource::luminance;
    Level first{image.width, image.height, {}};
    first.alpha.resize(static_cast<std::size_t>(image.width) * image.height);
    for (std::size_t i = 0; i < first.alpha.size(); ++i)
        first.alpha[i] = image.srgb8.empty() ? opacityOf(image.linear[i], source)
                                             : opacityOf(&image.srgb8[4 * i], source);
    levels_.push_back(std::move(first));
    while (levels_.back().width > 1 || levels_.back().height > 1)
        levels_.push_back(halved(levels_.back()));
}

AlphaImage::Level AlphaImage::halved(const Level& fine) {
    Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
    coarse.alpha.reserve(static_cast<std::size_t>(coarse.width) * coarse.height);
    const auto begin = [](int i, int from, int to) {
        return static_cast<int>(static_cast<std::int64_t>(i) * from / to);
    };
    for (int y = 0; y < coarse.height; ++y)
        for (int x = 0; x < coarse.width; ++x) {
            int sum = 0, count = 0;
            const int endY = begin(y + 1, fine.height, coarse.height);
            const int endX = begin(x + 1, fine.width, coarse.width);
            for (int v = begin(y, fine.height, coarse.height); v < endY; ++v)
                for (int u = begin(x, fine.width, coarse.width); u < endX; ++u, ++count)
                    sum += fine.alpha[static_cast<std::size_t>(v) * fine.width + u];
            coarse.alpha.push_back(static_cast<std::uint8_t>((sum + count / 2) / count));
        }
    return coarse;
}

float AlphaImage::sample(const Vec2& uv, int level) const {
    const Level& from = levels_[level];
    const BilinearPlace at(uv, from.width, from.height, wrapU_, wrapV_);
    const auto pixel = [&](int x, int y) -> float {
        return from.alpha[static_cast<std::size_t>(y) * from.width + x];
    };
    return ((1 - at.t) * ((1 - at.s) * pixel(at.x0, at.y0) + at.s * pixel(at.x1, at.y0)) +
            at.t * ((1 - at.s) * pixel(at.x0, at.y1) + at.s * pixel(at.x1, at.y1))) /
           255;
}

}  // namespace vlf
