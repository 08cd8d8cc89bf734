#pragma once
// The environment on the GPU: what is seen where there is nothing.

#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/shaders/shared.h"
#include "vlf/scene/environment.h"

#include <cstdint>

namespace vlf::gl {

class SkyPicture {
  public:
    /// A picture wider than `largestSide` texels is shown with several pixels made one.
    SkyPicture(const Environment& environment, std::uint32_t largestSide);

    bool isBlack() const { return !texture_; }
    void bind() const;
    std::uint64_t bytes() const;

    /// Tells the shaders where in the picture a direction lies, and in which directions the pixels
    /// of a view look.
    void describe(const Mat4& clipFromWorld, shared::ViewData& view) const;

  private:
    TextureObject texture_;
    int width_ = 0, height_ = 0;
    float turn_ = 0;  ///< of the whole circle
};

/// Bytes of what a SkyPicture without limits takes.
std::uint64_t skyBytes(const Environment& environment);

}  // namespace vlf::gl
