#include "vlf/render/gl/changed_light.h"

#include "vlf/field/radiance_field.h"

#include <algorithm>
#include <cmath>

namespace vlf::gl {

namespace {

static_assert(shared::kMostReceivers == ChangedCharts::kMaxCharts);

shared::ReceiverData receiverOf(const ChangedChart& changed, const Chart& chart) {
    return {Vec4(chart.uAxis, chart.uOffset), Vec4(chart.vAxis, chart.vOffset),
            Vec4(chart.normal, changed.lower), Vec4(changed.first, changed.last),
            Vec4(chart.x, chart.y, changed.upper, changed.planar ? 1 : 0)};
}

/// Of the part of space that the change's ranges of coordinates say.
std::array<Vec3, 8> placeOf(const ChangedChart& changed, const Chart& chart) {
    const Mat3 world = glm::inverse(glm::transpose(Mat3(chart.uAxis, chart.vAxis, chart.normal)));
    std::array<Vec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i)
        corners[i] = world * Vec3((i & 1 ? changed.first.x : changed.last.x) - chart.uOffset,
                                  (i & 2 ? changed.first.y : changed.last.y) - chart.vOffset,
                                  i & 4 ? changed.lower : changed.upper);
    return corners;
}

}  // namespace

ChangedLight::ChangedLight(const Scene& scene, const LightField& field, bool looksUp)
    : field_(field), charts_(scene, field), grid_(boundsOf(scene)), looksUp_(looksUp) {
    if (!looksUp) return;
    factors_ = makeTexture(GL_TEXTURE_2D);
    glTextureStorage2D(factors_.id(), 1, GL_RGB9_E5, static_cast<GLsizei>(field.atlas.width),
                       static_cast<GLsizei>(field.atlas.height));
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTextureParameteri(factors_.id(), wrap, GL_CLAMP_TO_EDGE);
    glTextureParameteri(factors_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
}

void ChangedLight::update(const IrradianceAtlas& with, const IrradianceAtlas& without) {
    if (!looksUp_) return;
    charts_.update(with, without);
    receivers_.clear();
    places_.clear();
    for (const ChangedChart& changed : charts_.charts()) {
        receivers_.push_back(receiverOf(changed, field_.charts[changed.chart]));
        places_.push_back(placeOf(changed, field_.charts[changed.chart]));
        load(changed, with, without);
    }
    grid_.fill(receivers_, places_, tolerance());
}

/// The texels that bilinear interpolation within the changed part reads.
void ChangedLight::load(const ChangedChart& changed, const IrradianceAtlas& with,
                        const IrradianceAtlas& without) {
    const Chart& chart = field_.charts[changed.chart];
    const auto from = [](float first, std::uint32_t place) {
        return static_cast<std::uint32_t>(
            std::max(static_cast<int>(place) + static_cast<int>(std::floor(first - 0.5f)), 0));
    };
    const auto to = [](float last, std::uint32_t place, std::uint32_t size) {
        return std::min(place + static_cast<std::uint32_t>(std::ceil(last + 0.5f)), size);
    };
    const std::uint32_t x0 = from(changed.first.x, chart.x), y0 = from(changed.first.y, chart.y);
    const std::uint32_t x1 = to(changed.last.x, chart.x, with.width);
    const std::uint32_t y1 = to(changed.last.y, chart.y, with.height);
    packed_.clear();
    for (std::uint32_t y = y0; y < y1; ++y)
        for (std::uint32_t x = x0; x < x1; ++x)
            packed_.push_back(packRgb9e5(ChangedCharts::factorOf(with.at(x, y), without.at(x, y))));
    glTextureSubImage2D(factors_.id(), 0, static_cast<GLint>(x0), static_cast<GLint>(y0),
                        static_cast<GLsizei>(x1 - x0), static_cast<GLsizei>(y1 - y0), GL_RGB,
                        GL_UNSIGNED_INT_5_9_9_9_REV, packed_.data());
}

void ChangedLight::bind() const {
    if (looksUp_) glBindTextureUnit(shared::kChangeUnit, factors_.id());
}

std::uint64_t ChangedLight::bytes() const {
    return looksUp_ ? std::uint64_t{4} * field_.atlas.width * field_.atlas.height : 0;
}

}  // namespace vlf::gl
