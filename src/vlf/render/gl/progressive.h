#pragma once
// Mode `progressive`: what can be drawn at once while the view moves; when it rests, traced
// reflections fill in, and then the picture grows smoother, sample by sample.

#include "vlf/render/gl/renderer.h"

#include <memory>

namespace vlf {

/// Refers to a renderer, which must outlive it; what is said there of contexts and state holds
/// here.
class ProgressiveRenderer {
  public:
    static constexpr int kSamplesAlongSide = 8;  ///< of a pixel
    static constexpr int kSamples = kSamplesAlongSide * kSamplesAlongSide;

    /// Makes ready what traced reflections need, which takes a while. Throws InputError as
    /// Renderer::draw does in mode `raytraced`. `options` are those of the renderer.
    explicit ProgressiveRenderer(Renderer& renderer, const RendererOptions& options = {});
    ~ProgressiveRenderer();
    ProgressiveRenderer(ProgressiveRenderer&&) noexcept;
    ProgressiveRenderer& operator=(ProgressiveRenderer&&) noexcept;

    /// Draws into the view's rectangle of `framebuffer` what there is of the picture after
    /// `seconds` of work on it; a call takes no longer unless what it shows of a moving view does,
    /// and returns when the GPU is done. That is mode `field` while the view, its size, settings
    /// that change radiance or the light differ from the call before (or, where the field holds no
    /// radiance of mirrors, traced reflections of fewer pixels), and afterwards the mean of the
    /// samples of mode `raytraced` so far, in the end that of renderStill with antialias =
    /// kSamplesAlongSide. settings.mode and view.part have no effect.
    void draw(const View& view, const RenderSettings& settings, unsigned framebuffer,
              double seconds = 1.0 / 30);

    /// Samples that every pixel has, of kSamples.
    int samples() const;

    /// The part of all samples of all pixels that is done, in [0, 1].
    double progress() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vlf
