#pragma once
// A baked room on the GPU, to be drawn in every mode.

#include "vlf/io/field_file.h"
#include "vlf/render/gl/progressive.h"
#include "vlf/render/gl/renderer.h"

#include <memory>
#include <optional>

namespace vlf::app {

class ShownRoom {
  public:
    /// Throws as Renderer does.
    ShownRoom(std::shared_ptr<const BakedRoom> room, const RendererOptions& options);

    /// Throws as Renderer::draw does.
    void draw(const View& view, const RenderSettings& settings, unsigned framebuffer);

    /// The mode in its place if the field holds no radiance of mirrors: it is then `progressive`
    /// for `field`.
    DisplayMode drawable(DisplayMode mode) const;

    /// The part of a picture at rest that is done, in [0, 1]; none if the mode drawn last does not
    /// refine.
    std::optional<double> refined() const;

    /// See Renderer::reloadShaders.
    void reloadShaders();

    const BakedRoom& room() const { return *room_; }
    const std::shared_ptr<const BakedRoom>& shared() const { return room_; }
    Renderer& renderer() { return renderer_; }

  private:
    std::shared_ptr<const BakedRoom> room_;
    RendererOptions options_;
    Renderer renderer_;
    std::optional<ProgressiveRenderer> progressive_;  ///< once it is drawn
    bool refines_ = false;
};

}  // namespace vlf::app
