#include "vlf/render/gl/sky_picture.h"

#include "vlf/field/radiance_field.h"

#include <algorithm>
#include <vector>

#include <glm/matrix.hpp>

namespace vlf::gl {

namespace {

/// Mean of a block of pixels.
Vec3 meanOf(const Image& picture, int left, int top, int size) {
    Vec3 sum(0);
    int count = 0;
    for (int y = top; y < std::min(top + size, picture.height); ++y)
        for (int x = left; x < std::min(left + size, picture.width); ++x, ++count)
            sum += picture.at(x, y);
    return sum / static_cast<float>(std::max(count, 1));
}

}  // namespace

SkyPicture::SkyPicture(const Environment& environment, std::uint32_t largestSide) {
    if (environment.isBlack()) return;
    Image one(1, 1, Vec3(1));
    const Image& picture = environment.isUniform() ? one : environment.picture;
    const int most = static_cast<int>(std::max(1u, largestSide));
    const int size = (std::max(picture.width, picture.height) + most - 1) / most;
    width_ = (picture.width + size - 1) / size;
    height_ = (picture.height + size - 1) / size;
    turn_ = environment.turn / 360;
    std::vector<std::uint32_t> packed;
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x)
            packed.push_back(
                packRgb9e5(environment.radiance * meanOf(picture, size * x, size * y, size)));
    texture_ = makeTexture(GL_TEXTURE_2D);
    glTextureStorage2D(texture_.id(), 1, GL_RGB9_E5, width_, height_);
    glTextureSubImage2D(texture_.id(), 0, 0, 0, width_, height_, GL_RGB,
                        GL_UNSIGNED_INT_5_9_9_9_REV, packed.data());
    glTextureParameteri(texture_.id(), GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(texture_.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
}

void SkyPicture::bind() const {
    if (!isBlack()) glBindTextureUnit(shared::kSkyUnit, texture_.id());
}

std::uint64_t SkyPicture::bytes() const {
    return std::uint64_t{4} * static_cast<std::uint64_t>(width_) *
           static_cast<std::uint64_t>(height_);
}

/// A pixel at (x, y) of the clip space looks along x right + y up + ahead.
void SkyPicture::describe(const Mat4& clipFromWorld, shared::ViewData& view) const {
    const glm::dmat4 m(clipFromWorld);
    glm::dmat3 clipFromDirection;
    for (int axis = 0; axis < 3; ++axis)
        clipFromDirection[axis] = {m[axis][0], m[axis][1], m[axis][3]};
    const glm::dmat3 inverse = glm::inverse(clipFromDirection);
    view.skyRight = Vec4(Vec3(inverse[0]), turn_);
    view.skyUp = Vec4(Vec3(inverse[1]), 0);
    view.skyAhead = Vec4(Vec3(inverse[2]), 0);
}

std::uint64_t skyBytes(const Environment& environment) {
    if (environment.isBlack()) return 0;
    return 4 * std::max<std::uint64_t>(1, environment.picture.pixels.size());
}

}  // namespace vlf::gl
