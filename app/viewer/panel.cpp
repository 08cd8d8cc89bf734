#include "panel.h"

#include "display_modes.h"
#include "viewer.h"

#include <optional>

#include <imgui.h>
#include <imgui_stdlib.h>

namespace vlf::app {

namespace {

constexpr float kLeastEye = 0.1f, kMostEye = 3;  // metres
constexpr float kMostCompensation = 8;           // EV
constexpr float kWidth = 25;                     // of the panel, in heights of its text

void drawView(Walkthrough& walk) {
    if (ImGui::BeginCombo("mode", kViewModes[walk.mode()].name)) {
        for (std::size_t i = 0; i < kViewModes.size(); ++i)
            if (ImGui::Selectable(kViewModes[i].name, i == walk.mode())) walk.setMode(i);
        ImGui::EndCombo();
    }
    bool corrected = walk.lookup() == LookupKind::depthCorrected;
    if (ImGui::Checkbox("mirrors corrected by depth", &corrected))
        walk.setLookup(corrected ? LookupKind::depthCorrected : LookupKind::plain);
    float fov = walk.navigator().pose().verticalFov;
    if (ImGui::SliderFloat("field of view", &fov, Navigator::kLeastFov, Navigator::kMostFov,
                           "%.0f degrees"))
        walk.navigator().setVerticalFov(fov);
}

void drawMovement(Walkthrough& walk) {
    Navigator& navigator = walk.navigator();
    int movement = static_cast<int>(navigator.movement());
    ImGui::RadioButton("fly", &movement, static_cast<int>(Movement::fly));
    ImGui::SameLine();
    ImGui::RadioButton("walk", &movement, static_cast<int>(Movement::walk));
    if (movement != static_cast<int>(navigator.movement()))
        walk.setMovement(static_cast<Movement>(movement));
    float speed = navigator.speedFactor();
    if (ImGui::SliderFloat("speed", &speed, Navigator::kLeastSpeed, Navigator::kMostSpeed, "x %.2f",
                           ImGuiSliderFlags_Logarithmic))
        navigator.setSpeedFactor(speed);
    float eye = navigator.eyeHeight();
    if (ImGui::SliderFloat("eye height", &eye, kLeastEye, kMostEye, "%.2f m"))
        navigator.setEyeHeight(eye);
}

void drawExposure(Walkthrough& walk) {
    bool automatic = walk.exposure().automatic();
    if (ImGui::Checkbox("automatic", &automatic)) walk.setAutomaticExposure(automatic);
    ImGui::SameLine();
    ImGui::TextDisabled("now %+.2f EV", walk.exposure().value());
    float compensation = walk.exposure().compensation();
    if (ImGui::SliderFloat("brighter", &compensation, -kMostCompensation, kMostCompensation,
                           "%+.2f EV"))
        walk.exposure().setCompensation(compensation);
    int tone = static_cast<int>(walk.tone());
    if (ImGui::Combo("tone curve", &tone, "linear\0filmic\0"))
        walk.setTone(static_cast<ToneCurve>(tone));
}

void drawCameras(Walkthrough& walk) {
    for (std::size_t i = 0; i < walk.cameras().size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable(walk.cameras()[i].name.c_str())) walk.goToCamera(i);
        ImGui::PopID();
    }
    if (walk.cameras().empty()) ImGui::TextDisabled("the scene has none");
}

void drawBookmarks(Viewer& viewer) {
    std::vector<Bookmark>& bookmarks = viewer.walk().bookmarks();
    std::optional<std::size_t> unwanted;
    for (std::size_t i = 0; i < bookmarks.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Button("go")) viewer.walk().goTo(bookmarks[i].pose, bookmarks[i].name);
        ImGui::SameLine();
        ImGui::InputText("##name", &bookmarks[i].name);
        if (ImGui::IsItemDeactivatedAfterEdit()) viewer.remember();
        ImGui::SameLine();
        if (ImGui::Button("delete")) unwanted = i;
        ImGui::PopID();
    }
    if (unwanted) {
        bookmarks.erase(bookmarks.begin() + static_cast<std::ptrdiff_t>(*unwanted));
        viewer.remember();
    }
    if (ImGui::Button("add this place")) viewer.addBookmark();
}

void drawButtons(Viewer& viewer) {
    if (ImGui::Button("picture")) viewer.wantPicture(Picture::png);
    ImGui::SameLine();
    if (ImGui::Button("radiance")) viewer.wantPicture(Picture::exr);
    ImGui::SameLine();
    if (ImGui::Button("full screen")) viewer.toggleFullscreen();
    ImGui::Checkbox("frame times", &viewer.shown().statistics);
    ImGui::SameLine();
    ImGui::Checkbox("keys", &viewer.shown().help);
}

}  // namespace

void drawPanel(Viewer& viewer) {
    constexpr ImGuiTreeNodeFlags kOpen = ImGuiTreeNodeFlags_DefaultOpen;
    const float margin = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({margin, margin}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize({kWidth * ImGui::GetFontSize(), 0}, ImGuiCond_FirstUseEver);
    // What does not fit is reached by scrolling.
    ImGui::SetNextWindowSizeConstraints(
        {0, 0}, {ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y - 2 * margin});
    if (ImGui::Begin("Settings (Tab hides them)", &viewer.shown().panel,
                     ImGuiWindowFlags_NoSavedSettings)) {
        ImGui::PushItemWidth(-9 * ImGui::GetFontSize());
        if (ImGui::CollapsingHeader("View", kOpen)) drawView(viewer.walk());
        if (ImGui::CollapsingHeader("Objects", kOpen)) viewer.objectPanel().draw();
        if (ImGui::CollapsingHeader("Movement", kOpen)) drawMovement(viewer.walk());
        if (ImGui::CollapsingHeader("Exposure", kOpen)) drawExposure(viewer.walk());
        if (ImGui::CollapsingHeader("Cameras", kOpen)) drawCameras(viewer.walk());
        if (ImGui::CollapsingHeader("Bookmarks", kOpen)) drawBookmarks(viewer);
        ImGui::Separator();
        drawButtons(viewer);
        ImGui::PopItemWidth();
    }
    ImGui::End();
}

}  // namespace vlf::app
