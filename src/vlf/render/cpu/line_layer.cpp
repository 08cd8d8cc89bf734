#include "vlf/render/cpu/line_layer.h"

#include <algorithm>

namespace vlf {

namespace {

float distanceToSegment(const Vec2& p, const Vec2& from, const Vec2& to) {
    const Vec2 along = to - from;
    const float length2 = glm::dot(along, along);
    const float t = length2 > 0 ? std::clamp(glm::dot(p - from, along) / length2, 0.0f, 1.0f) : 0;
    return glm::distance(p, from + t * along);
}

/// The pixel of a picture coordinate, in [0, count].
int pixelWithin(float coordinate, int count) {
    return static_cast<int>(std::clamp(coordinate, 0.0f, static_cast<float>(count)));
}

/// The part of row y's extent in x that a stroke `reach` wide on both sides can touch.
Vec2 extentInRow(int y, const Vec2& from, const Vec2& to, float reach) {
    const Vec2 along = to - from;
    Vec2 t(0, 1);
    if (along.y != 0) {
        t = (static_cast<float>(y) + 0.5f - from.y + Vec2(-reach, reach)) / along.y;
        t = glm::clamp(Vec2(std::min(t.x, t.y), std::max(t.x, t.y)), 0.0f, 1.0f);
    }
    const Vec2 x = from.x + t * along.x;
    return {std::min(x.x, x.y) - reach, std::max(x.x, x.y) + reach};
}

}  // namespace

void LineLayer::line(const Vec2& from, const Vec2& to, float thickness, float strength) {
    // Coverage of a pixel by a stroke's edge falls from 1 to 0 over one pixel of distance.
    const float reach = 0.5f * thickness + 0.5f;
    const int y0 = pixelWithin(std::min(from.y, to.y) - reach, height_);
    const int y1 = pixelWithin(std::max(from.y, to.y) + reach + 1, height_);
    for (int y = y0; y < y1; ++y) {
        const Vec2 extent = extentInRow(y, from, to, reach);
        const int x0 = pixelWithin(extent.x, width_), x1 = pixelWithin(extent.y + 1, width_);
        for (int x = x0; x < x1; ++x) {
            const float distance = distanceToSegment({x + 0.5f, y + 0.5f}, from, to);
            const float coverage = std::clamp(reach - distance, 0.0f, std::min(thickness, 1.0f));
            float& ink = ink_[static_cast<std::size_t>(y) * width_ + x];
            ink = std::max(ink, coverage * strength);
        }
    }
}

void LineLayer::drawOn(Image& image, const Vec3& color) const {
    for (std::size_t i = 0; i < ink_.size(); ++i)
        image.pixels[i] = glm::mix(image.pixels[i], color, ink_[i]);
}

}  // namespace vlf
