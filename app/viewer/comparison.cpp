#include "comparison.h"

#include "dynamic_report.h"

#include "vlf/base/error.h"
#include "vlf/image/heat_map.h"
#include "vlf/render/gl/read_framebuffer.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

namespace vlf::app {

namespace {

constexpr int kStrips = 3;
constexpr float kRest = 0.3f;  // seconds of rest before the error is found
constexpr ImU32 kLine = IM_COL32(255, 255, 255, 160);

/// Whether they are where they were; how they are lit is no matter.
bool samePlaces(const std::vector<DynamicObject>& a, const std::vector<DynamicObject>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const DynamicObject& before, const DynamicObject& now) {
                          return before.pose == now.pose && before.model == now.model;
                      });
}

/// Both rooms are drawn alike, in a mode that needs no rest.
RenderSettings comparable(const ShownRoom& a, const ShownRoom& b, RenderSettings settings) {
    const bool looksUp = settings.mode == DisplayMode::field &&
                         a.drawable(settings.mode) == DisplayMode::field &&
                         b.drawable(settings.mode) == DisplayMode::field;
    if (!looksUp && settings.mode != DisplayMode::wireframe) settings.mode = DisplayMode::raytraced;
    return settings;
}

void label(const std::string& text, float x) {
    const ImVec2 at{x + ImGui::GetFontSize(), ImGui::GetFontSize()};
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    list->AddRectFilled({at.x - 4, at.y - 2}, {at.x + size.x + 4, at.y + size.y + 2},
                        IM_COL32(0, 0, 0, 150), 3);
    list->AddText(at, IM_COL32_WHITE, text.c_str());
}

}  // namespace

void Comparison::next(std::shared_ptr<const BakedRoom> room, const Objects& objects) {
    switch (layout_) {
        case ComparisonLayout::off:
            compared_ = objects.visible();
            if (compared_.empty()) return say_("there is no object to compare");
            room_ = std::move(room);
            baking_ = std::make_unique<Rebake>(room_, compared_);
            layout_ = ComparisonLayout::sideBySide;
            return say_("comparing with the room baked again");
        case ComparisonLayout::sideBySide:
            layout_ = ComparisonLayout::wipe;
            measured_ = false;
            return say_("wipe: dynamic | baked again");
        case ComparisonLayout::wipe:
            layout_ = ComparisonLayout::wipeError;
            return say_("wipe: dynamic | error");
        case ComparisonLayout::wipeError:
            end();
            return say_("comparison ended");
    }
}

void Comparison::end() {
    layout_ = ComparisonLayout::off;
    truth_.reset();
    room_.reset();
    seen_.reset();
    meanError_.reset();
    if (!baking_) return;
    baking_->cancel();
    ending_.push_back(std::move(baking_));
}

void Comparison::update(const std::shared_ptr<const BakedRoom>& room, const Objects& objects) {
    std::erase_if(ending_, [](const auto& rebake) { return rebake->done(); });
    if (layout_ == ComparisonLayout::off) return;
    if (room != room_ || !samePlaces(compared_, objects.visible())) {
        end();
        return say_("comparison ended: the room has changed");
    }
    if (!baking_ || !baking_->done()) return;
    try {
        const std::unique_ptr<Rebake> baked = std::move(baking_);
        truth_ = std::make_unique<ShownRoom>(baked->result(), options_);
        say_("baked again: V shows it otherwise");
    } catch (const Error& e) {
        end();
        say_(e.what());
    }
}

void Comparison::reloadShaders() {
    if (truth_) truth_->reloadShaders();
    seen_.reset();
}

void Comparison::drawStrip(ShownRoom& room, const Camera& camera, const RenderSettings& settings,
                           int strip) const {
    const int from = width_ * strip / kStrips, to = width_ * (strip + 1) / kStrips;
    if (from >= to) return;
    View view = viewOf(camera, to - from, height_, room.renderer().nearest());
    view.x = from;
    room.draw(view, settings, 0);
}

void Comparison::drawPart(ShownRoom& room, const Camera& camera, const RenderSettings& settings,
                          int from, int to) const {
    if (from >= to) return;
    View view = viewOf(camera, width_, height_, room.renderer().nearest());
    view.part = PixelRectangle{from, 0, to - from, height_};
    room.draw(view, settings, 0);
}

void Comparison::draw(ShownRoom& room, const Camera& camera, const RenderSettings& wanted,
                      int width, int height, float pointer, float seconds) {
    width_ = width, height_ = height;
    wipe_ = std::clamp(pointer, 0.0f, 1.0f);
    const RenderSettings settings = comparable(room, *truth_, wanted);
    const Seen now{camera, settings, width, height, room.renderer().lightChanges()};
    if (seen_ != now) {
        seen_ = now;
        rested_ = 0;
        measured_ = false;
    }
    rested_ += seconds;
    takeError();
    if (rested_ > kRest && !measured_ && !measuring_.valid()) measure(room, camera, settings);
    if (layout_ == ComparisonLayout::sideBySide) {
        for (int strip = 0; strip < kStrips; ++strip)
            drawStrip(strip == 1 ? *truth_ : room, camera, settings, strip);
        return;
    }
    const int edge = static_cast<int>(wipe_ * static_cast<float>(width));
    drawPart(room, camera, settings, 0, edge);
    drawPart(*truth_, camera, settings, edge, width);
}

/// Of pictures of the layout's shape.
void Comparison::measure(ShownRoom& room, const Camera& camera, const RenderSettings& settings) {
    const int width = layout_ == ComparisonLayout::sideBySide ? width_ / kStrips : width_;
    if (width == 0) return;
    measuredWidth_ = width, measuredHeight_ = height_;
    const auto picture = [&](ShownRoom& of) {
        of.draw(viewOf(camera, width, height_, of.renderer().nearest()), settings, 0);
        return readFramebuffer(0, width, height_);
    };
    measuring_ = std::async(std::launch::async, [test = picture(room), truth = picture(*truth_)] {
        return flip(test, truth);
    });
    measured_ = true;
}

void Comparison::takeError() {
    if (!measuring_.valid() ||
        measuring_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    const FlipResult result = measuring_.get();
    if (!measured_) return;  // what is seen has changed since
    meanError_ = result.mean;
    errorMap_.set(heatMap(result.error, measuredWidth_, measuredHeight_, kBrightestError));
}

void Comparison::drawOverlay() const {
    if (!shown()) return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const bool side = layout_ == ComparisonLayout::sideBySide;
    const float edge = side ? 2 * size.x / kStrips : wipe_ * size.x;
    const bool error = meanError_ && measured_ && !measuring_.valid();
    const auto map = (ImTextureID)(std::intptr_t)errorMap_.id();
    if (error && side) list->AddImage(map, {edge, 0}, size);
    if (error && layout_ == ComparisonLayout::wipeError)
        list->AddImage(map, {edge, 0}, size, {wipe_, 0}, {1, 1});
    const std::string name = error ? "error (FLIP)" : "error: when at rest";
    list->AddLine({edge, 0}, {edge, size.y}, kLine);
    if (side) list->AddLine({size.x / kStrips, 0}, {size.x / kStrips, size.y}, kLine);
    label("dynamic", 0);
    if (side) label("baked again", size.x / kStrips);
    label(layout_ == ComparisonLayout::wipe ? "baked again" : name, edge);
}

std::string Comparison::status() const {
    if (baking_) return baking_->activity();
    if (!shown()) return {};
    if (!meanError_ || !measured_ || measuring_.valid()) return "against the room baked again";
    return fmt::format("against the room baked again: mean FLIP {:.4f}", *meanError_);
}

}  // namespace vlf::app
