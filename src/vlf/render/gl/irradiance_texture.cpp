#include "vlf/render/gl/irradiance_texture.h"

#include "vlf/field/radiance_field.h"

#include <algorithm>

namespace vlf::gl {

namespace {

constexpr std::uint32_t kRows = 16;  // copied at once

}  // namespace

IrradianceTexture::IrradianceTexture(const LightField& field, std::uint32_t largestSide)
    : fit_(field, largestSide),
      width_(std::max(1u, fit_.layout().atlas.width)),
      height_(std::max(1u, fit_.layout().atlas.height)),
      texture_(makeTexture(GL_TEXTURE_2D)) {
    glTextureStorage2D(texture_.id(), 1, GL_RGB9_E5, static_cast<GLsizei>(width_),
                       static_cast<GLsizei>(height_));
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTextureParameteri(texture_.id(), wrap, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    load(field.atlas);
}

std::uint64_t IrradianceTexture::bytes() const {
    return std::uint64_t{4} * width_ * height_;
}

void IrradianceTexture::load(const IrradianceAtlas& whole) {
    shown_ = {};
    const IrradianceAtlas fitted = fit_.unchanged() ? IrradianceAtlas{} : fit_.fit(whole);
    const IrradianceAtlas& light = fit_.unchanged() ? whole : fitted;
    if (!light.irradiance.empty()) loadRows(light, 0, light.height, 0, light.width);
}

void IrradianceTexture::update(const IrradianceAtlas& whole) {
    if (!fit_.unchanged() || shown_.irradiance.size() != whole.irradiance.size()) {
        load(whole);
        if (fit_.unchanged()) shown_ = whole;
        return;
    }
    for (std::uint32_t first = 0; first < whole.height; first += kRows) {
        const std::uint32_t last = std::min(first + kRows, whole.height);
        std::uint32_t left = whole.width, right = 0;
        for (std::uint32_t y = first; y < last; ++y) {
            const Vec3* now = &whole.at(0, y);
            Vec3* before = &shown_.irradiance[shown_.index(0, y)];
            std::uint32_t x = 0, end = whole.width;
            while (x < end && now[x] == before[x]) ++x;
            while (end > x && now[end - 1] == before[end - 1]) --end;
            if (x == end) continue;
            std::copy(now + x, now + end, before + x);
            left = std::min(left, x);
            right = std::max(right, end);
        }
        if (left < right) loadRows(whole, first, last, left, right);
    }
}

void IrradianceTexture::loadRows(const IrradianceAtlas& light, std::uint32_t first,
                                 std::uint32_t last, std::uint32_t left, std::uint32_t right) {
    packed_.clear();
    for (std::uint32_t y = first; y < last; ++y)
        for (std::uint32_t x = left; x < right; ++x) packed_.push_back(packRgb9e5(light.at(x, y)));
    glTextureSubImage2D(texture_.id(), 0, static_cast<GLint>(left), static_cast<GLint>(first),
                        static_cast<GLsizei>(right - left), static_cast<GLsizei>(last - first),
                        GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, packed_.data());
}

}  // namespace vlf::gl
