#include "overlay.h"

#include "key_bindings.h"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

namespace vlf::app {

namespace {

constexpr ImGuiWindowFlags kReadOnly = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                       ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoSavedSettings |
                                       ImGuiWindowFlags_AlwaysAutoResize |
                                       ImGuiWindowFlags_NoFocusOnAppearing;
const ImVec4 kKeyColour{1, 0.82f, 0.45f, 1};
const ImVec4 kProblemColour{1, 0.55f, 0.45f, 1};
constexpr float kGraphLines = 4;  // height of the graph of frame times, in lines of text

void text(const std::string& line) {
    ImGui::TextUnformatted(line.c_str());
}

void label(const std::string& name, const std::string& value) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name.c_str());
    ImGui::TableNextColumn();
    text(value);
}

/// Places the next window at a part (0 to 1) of the display's width and height, with its own same
/// part there, a margin off the edge.
void placeNext(float x, float y) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float margin = ImGui::GetFontSize();
    ImGui::SetNextWindowPos(
        {margin + x * (size.x - 2 * margin), margin + y * (size.y - 2 * margin)}, ImGuiCond_Always,
        {x, y});
}

std::string bytes(std::uint64_t count) {
    return fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(count));
}

void drawGraph(const FrameStatistics& frames) {
    const std::vector<float> times = frames.milliseconds();
    const auto most = static_cast<float>(1.5e3 * frames.times().p99);
    ImGui::PlotLines("##frames", times.data(), static_cast<int>(times.size()), 0,
                     fmt::format("ms, 0 to {:.0f}", most).c_str(), 0, most,
                     {20 * ImGui::GetFontSize(), kGraphLines * ImGui::GetTextLineHeight()});
}

}  // namespace

void drawMessage(const std::string& line, float opacity) {
    placeNext(0.5f, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, std::clamp(opacity, 0.0f, 1.0f));
    if (ImGui::Begin("message", nullptr, kReadOnly)) text(line);
    ImGui::End();
    ImGui::PopStyleVar();
}

void drawStatus(const std::string& line) {
    placeNext(0, 1);
    if (ImGui::Begin("status", nullptr, kReadOnly)) text(line);
    ImGui::End();
}

void drawProblem(const std::string& message) {
    placeNext(0.5f, 0.8f);
    ImGui::SetNextWindowSize({0.7f * ImGui::GetIO().DisplaySize.x, 0});
    if (ImGui::Begin("problem", nullptr, kReadOnly & ~ImGuiWindowFlags_AlwaysAutoResize)) {
        ImGui::PushStyleColor(ImGuiCol_Text, kProblemColour);
        ImGui::PushTextWrapPos(0);
        text(message);
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
    }
    ImGui::End();
}

void drawHelp() {
    placeNext(0.5f, 0.5f);
    ImGui::SetNextWindowBgAlpha(0.9f);
    if (ImGui::Begin("keys", nullptr, kReadOnly) &&
        ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const Binding& binding : keyBindings()) {
            if (binding.name.empty()) continue;
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextColored(kKeyColour, "%s", binding.name.c_str());
            ImGui::TableNextColumn();
            text(binding.help);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

void drawStatistics(const FrameStatistics& frames, const PassTimes& passes,
                    const GpuMemory& memory) {
    placeNext(1, 0);
    if (ImGui::Begin("statistics", nullptr, kReadOnly)) {
        drawGraph(frames);
        if (ImGui::BeginTable("numbers", 2, ImGuiTableFlags_SizingFixedFit)) {
            label("frames a second", fmt::format("{:.1f}", frames.rate()));
            label("median frame", fmt::format("{:.2f} ms", 1e3 * frames.times().median));
            label("99 in 100 within", fmt::format("{:.2f} ms", 1e3 * frames.times().p99));
            for (const auto& [name, time] : passes)
                label(name, time ? fmt::format("{:.2f} ms", *time) : "-");
            label("GPU memory", bytes(memory.total()));
            label("  geometry", bytes(memory.geometry));
            label("  irradiance", bytes(memory.atlas));
            label("  radiance", bytes(memory.radiance));
            label("  textures", bytes(memory.textures));
            if (memory.objects > 0) label("  objects", bytes(memory.objects));
            if (memory.hits > 0) label("  tracing", bytes(memory.hits));
            if (memory.drawings > 0) label("  drawings", bytes(memory.drawings));
            if (memory.radianceElements > 0)
                label(
                    "  a radiance element",
                    fmt::format("{:.2f} bytes", static_cast<double>(memory.radiance) /
                                                    static_cast<double>(memory.radianceElements)));
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

}  // namespace vlf::app
