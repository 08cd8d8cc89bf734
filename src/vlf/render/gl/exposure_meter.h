#pragma once
// The exposure that suits a view, from a small picture of it.

#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/renderer.h"

#include <optional>

namespace vlf::gl {

/// Draws the view's radiance small and reads it back without waiting: the answer comes a frame or
/// two later.
class ExposureMeter {
  public:
    ExposureMeter();
    ~ExposureMeter();
    ExposureMeter(const ExposureMeter&) = delete;
    ExposureMeter& operator=(const ExposureMeter&) = delete;

    /// Asks for the exposure of what a camera sees in a picture of this width to height. Does
    /// nothing while an answer is under way.
    void measure(Renderer& renderer, const Camera& camera, float aspect);

    /// autoExposure (image/tone_map.h) of the last picture whose answer has come, in EV.
    std::optional<float> exposure();

  private:
    static constexpr int kWidth = 64, kHeight = 48;

    TextureObject color_, depth_;
    Framebuffer framebuffer_;
    Buffer pixels_;
    GLsync drawn_ = nullptr;
    std::optional<float> exposure_;
};

}  // namespace vlf::gl
