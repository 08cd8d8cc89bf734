#pragma once
// Objects in dynamic light beside the truth: the room baked again with them, and the difference of
// the two.

#include "objects.h"
#include "rebake.h"
#include "seen.h"
#include "shown_room.h"

#include "vlf/image/flip.h"
#include "vlf/render/gl/picture_texture.h"

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vlf::app {

enum class ComparisonLayout {
    off,
    sideBySide,  ///< dynamic, baked again, error
    wipe,        ///< dynamic before the pointer, baked again behind it
    wipeError,   ///< dynamic before the pointer, error behind it
};

/// Needs the window's context current.
class Comparison {
  public:
    using Say = std::function<void(const std::string&)>;

    Comparison(const RendererOptions& options, Say say) : options_(options), say_(std::move(say)) {}

    /// The next layout; the first one begins to bake.
    void next(std::shared_ptr<const BakedRoom> room, const Objects& objects);
    void end();

    /// Ends if visible objects have come, gone or moved, or the room is another one; takes what has
    /// been baked. To be called once a frame.
    void update(const std::shared_ptr<const BakedRoom>& room, const Objects& objects);

    /// There is a room that was baked again, to be drawn beside the other.
    bool shown() const { return truth_ != nullptr; }

    /// Draws both rooms into the window of so many pixels; `pointer` is where the wipe is, in parts
    /// of its width. Throws as ShownRoom::draw.
    void draw(ShownRoom& room, const Camera& camera, const RenderSettings& settings, int width,
              int height, float pointer, float seconds);

    /// See Renderer::reloadShaders.
    void reloadShaders();

    /// What lies over them, within a frame of the Gui.
    void drawOverlay() const;

    /// What is under way, or how large the error is; empty: nothing of either.
    std::string status() const;

  private:
    void drawStrip(ShownRoom& room, const Camera& camera, const RenderSettings& settings,
                   int strip) const;
    void drawPart(ShownRoom& room, const Camera& camera, const RenderSettings& settings, int from,
                  int to) const;
    void measure(ShownRoom& room, const Camera& camera, const RenderSettings& settings);
    void takeError();

    RendererOptions options_;
    Say say_;
    ComparisonLayout layout_ = ComparisonLayout::off;
    std::shared_ptr<const BakedRoom> room_;
    std::vector<DynamicObject> compared_;
    std::unique_ptr<Rebake> baking_;
    std::vector<std::unique_ptr<Rebake>> ending_;  ///< cancelled, still at work
    std::unique_ptr<ShownRoom> truth_;
    int width_ = 0, height_ = 0;
    float wipe_ = 0.5f;  ///< of the width
    std::optional<Seen> seen_;
    float rested_ = 0;      ///< seconds since the pictures have changed
    bool measured_ = true;  ///< the error is, or is being found, of what is seen
    int measuredWidth_ = 0, measuredHeight_ = 0;
    std::future<FlipResult> measuring_;
    std::optional<double> meanError_;
    gl::PictureTexture errorMap_;
};

}  // namespace vlf::app
