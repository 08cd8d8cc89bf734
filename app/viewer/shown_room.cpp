#include "shown_room.h"

#include <utility>

namespace vlf::app {

ShownRoom::ShownRoom(std::shared_ptr<const BakedRoom> room, const RendererOptions& options)
    : room_(std::move(room)), options_(options), renderer_(room_->scene, room_->field, options) {}

DisplayMode ShownRoom::drawable(DisplayMode mode) const {
    return mode == DisplayMode::field && !renderer_.canLookUp() ? DisplayMode::progressive : mode;
}

void ShownRoom::draw(const View& view, const RenderSettings& settings, unsigned framebuffer) {
    RenderSettings drawn = settings;
    drawn.mode = drawable(settings.mode);
    if (!renderer_.canLookUp()) drawn.diagramRoom = DisplayMode::raytraced;
    refines_ = drawn.mode == DisplayMode::progressive;
    if (!refines_) return renderer_.draw(view, drawn, framebuffer);
    if (!progressive_) progressive_.emplace(renderer_, options_);
    progressive_->draw(view, drawn, framebuffer);
}

std::optional<double> ShownRoom::refined() const {
    if (!refines_) return {};
    return progressive_->progress();
}

void ShownRoom::reloadShaders() {
    renderer_.reloadShaders();
    progressive_.reset();
}

}  // namespace vlf::app
