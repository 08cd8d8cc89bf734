#include "gui.h"

#include <cmath>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace vlf::app {

namespace {

constexpr float kFontPixels = 13;  // of the built-in font, which is sharp at multiples of it

void setStyle(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 4;
    style.FrameRounding = 3;
    style.WindowBorderSize = 0;
    style.WindowPadding = {10, 10};
    style.Colors[ImGuiCol_WindowBg] = {0.06f, 0.06f, 0.07f, 0.88f};
    style.Colors[ImGuiCol_FrameBg] = {0.2f, 0.25f, 0.33f, 1};
    style.Colors[ImGuiCol_TextDisabled] = {0.7f, 0.7f, 0.7f, 1};
    style.ScaleAllSizes(scale);
    ImFontConfig font;
    font.SizePixels = kFontPixels * std::round(scale);
    ImGui::GetIO().Fonts->AddFontDefault(&font);
}

}  // namespace

Gui::Gui(const Window& window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    setStyle(window.contentScale());
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 450 core");
}

Gui::~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Gui::begin(bool interactive) {
    ImGuiConfigFlags& flags = ImGui::GetIO().ConfigFlags;
    flags = interactive ? flags & ~ImGuiConfigFlags_NoMouse : flags | ImGuiConfigFlags_NoMouse;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Gui::draw() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Gui::wantsPointer() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::typing() const {
    return ImGui::GetIO().WantTextInput;
}

}  // namespace vlf::app
