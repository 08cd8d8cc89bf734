#include "gizmo_drawing.h"

#include <array>
#include <span>
#include <vector>

#include <imgui.h>

namespace vlf::app {

namespace {

constexpr std::array kColours{IM_COL32(235, 80, 70, 230), IM_COL32(95, 200, 80, 230),
                              IM_COL32(85, 140, 255, 230)};
constexpr ImU32 kBright = IM_COL32(255, 225, 120, 255);
constexpr ImU32 kShade = IM_COL32(0, 0, 0, 110);  // beneath lines, for bright rooms
constexpr float kThin = 2, kThick = 3;            // units of the window
constexpr float kTip = 5;
constexpr ImU32 kFillAlpha = 90;

class Pen {
  public:
    Pen(const Screen& screen, float width)
        : screen_(screen), unit_(ImGui::GetIO().DisplaySize.x / width) {}

    void line(std::span<const Vec3> points, ImU32 colour, float thickness, bool closed) {
        if (!project(points)) return;
        const ImDrawFlags flags = closed ? ImDrawFlags_Closed : ImDrawFlags_None;
        const int count = static_cast<int>(points_.size());
        list_->AddPolyline(points_.data(), count, kShade, flags, thickness + 2);
        list_->AddPolyline(points_.data(), count, colour, flags, thickness);
    }
    void fill(std::span<const Vec3> points, ImU32 colour) {
        if (!project(points)) return;
        const ImU32 pale = (colour & ~IM_COL32_A_MASK) | kFillAlpha << IM_COL32_A_SHIFT;
        list_->AddConvexPolyFilled(points_.data(), static_cast<int>(points_.size()), pale);
    }
    void dot(const Vec3& point, ImU32 colour) {
        if (project({&point, 1})) list_->AddCircleFilled(points_.front(), kTip, colour);
    }

  private:
    /// False: not all are before the eye.
    bool project(std::span<const Vec3> points) {
        points_.clear();
        for (const Vec3& p : points) {
            const auto at = screen_.point(p);
            if (!at) return false;
            points_.push_back({unit_ * at->x, unit_ * at->y});
        }
        return true;
    }

    const Screen& screen_;
    float unit_;
    ImDrawList* list_ = ImGui::GetBackgroundDrawList();
    std::vector<ImVec2> points_;
};

}  // namespace

void drawGizmo(const Screen& screen, float width, const Gizmo& gizmo, const GizmoHandle& bright) {
    Pen pen(screen, width);
    const auto colour = [&](GizmoPart part, int axis) {
        return bright == GizmoHandle{part, axis} ? kBright
                                                 : kColours[static_cast<std::size_t>(axis)];
    };
    const auto thickness = [&](GizmoPart part, int axis) {
        return bright == GizmoHandle{part, axis} ? kThick : kThin;
    };
    for (int axis = 0; axis < 3; ++axis) {
        std::array<Vec3, Gizmo::kRingPoints> ring;
        for (int i = 0; i < Gizmo::kRingPoints; ++i)
            ring[static_cast<std::size_t>(i)] = gizmo.ringPoint(axis, i);
        pen.line(ring, colour(GizmoPart::ring, axis), thickness(GizmoPart::ring, axis), true);
    }
    for (int axis = 0; axis < 3; ++axis) {
        pen.fill(gizmo.plane(axis), colour(GizmoPart::plane, axis));
        const std::array arm{gizmo.centre(), gizmo.armEnd(axis)};
        pen.line(arm, colour(GizmoPart::arm, axis), thickness(GizmoPart::arm, axis), false);
        pen.dot(gizmo.armEnd(axis), colour(GizmoPart::arm, axis));
    }
}

}  // namespace vlf::app
