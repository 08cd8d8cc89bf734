#include "object_panel.h"

#include "viewer.h"

#include "vlf/dynamic/object_names.h"
#include "vlf/scene/generate/primitives.h"

#include <algorithm>

#include <imgui.h>
#include <imgui_stdlib.h>

namespace vlf::app {

namespace {

constexpr float kMoveStep = 0.005f, kTurnStep = 0.5f, kScaleStep = 0.005f;  // of a drag, a pixel
constexpr float kLeastScale = 1e-4f, kMostScale = 1e4f;
constexpr float kFarthest = 1e5f;      // metres
constexpr float kMostEmission = 1000;  // W·m⁻²·sr⁻¹
constexpr float kDegree = kPi / 180;

/// Whether another was chosen.
template <typename Names, typename Value>
bool combo(const char* label, const Names& names, Value& value) {
    const Value before = value;
    if (ImGui::BeginCombo(label, nameAmong(names, value))) {
        for (const auto& named : names)
            if (ImGui::Selectable(named.name, named.value == value)) value = named.value;
        ImGui::EndCombo();
    }
    return value != before;
}

void drawAdding(Viewer& viewer) {
    static std::string text;
    for (const std::string& name : primitiveNames()) {
        if (ImGui::Button(name.c_str())) viewer.addObject(name);
        ImGui::SameLine();
    }
    ImGui::TextDisabled("add one");
    const bool entered = ImGui::InputTextWithHint("##add", "cube:0.3:red or chair.glb", &text,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    if ((ImGui::Button("add") || entered) && !text.empty()) viewer.addObject(text);
}

void drawList(Objects& objects) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        bool visible = objects.now(i).visible;
        if (ImGui::Checkbox("##visible", &visible)) objects.setVisible(i, visible);
        ImGui::SameLine();
        const std::string& name = objects.scenario().objects[i].object.name;
        if (ImGui::Selectable(name.empty() ? "(no name)" : name.c_str(), objects.selected() == i))
            objects.select(i);
        ImGui::PopID();
    }
}

/// Degrees about X, Y and Z, in this order.
Vec3 anglesOf(const Quat& q) {
    const Mat3 m = glm::mat3_cast(q);
    const float y = std::asin(std::clamp(-m[0][2], -1.0f, 1.0f));
    return Vec3(std::atan2(m[1][2], m[2][2]), y, std::atan2(m[0][1], m[0][0])) / kDegree;
}

Quat rotationOf(const Vec3& degrees) {
    const Vec3 a = kDegree * degrees;
    return glm::normalize(glm::angleAxis(a.z, Vec3(0, 0, 1)) * glm::angleAxis(a.y, Vec3(0, 1, 0)) *
                          glm::angleAxis(a.x, Vec3(1, 0, 0)));
}

void drawPose(Objects& objects, std::size_t i) {
    Pose pose = objects.now(i).pose;
    bool changed = ImGui::DragFloat3("position", &pose.translation.x, kMoveStep, -kFarthest,
                                     kFarthest, "%.3f m", ImGuiSliderFlags_AlwaysClamp);
    Vec3 angles = anglesOf(pose.rotation);
    if (ImGui::DragFloat3("rotation", &angles.x, kTurnStep, -360, 360, "%.1f",
                          ImGuiSliderFlags_AlwaysClamp)) {
        pose.rotation = rotationOf(angles);
        changed = true;
    }
    changed |= ImGui::DragFloat("scale", &pose.scale, kScaleStep * pose.scale, kLeastScale,
                                kMostScale, "%.4g", ImGuiSliderFlags_AlwaysClamp);
    if (changed) objects.setPose(i, pose);
}

/// A colour of the source, or, if it states none, that of the first material. Whether it was
/// changed: once, when the mouse lets go of it, since a model is made anew for it.
bool editColour(const char* label, std::optional<Vec3>& stated, const Vec3& present, bool hdr) {
    static ImGuiID editing = 0;
    static Vec3 edited;
    const ImGuiID id = ImGui::GetID(label);
    Vec3 colour = editing == id ? edited : stated.value_or(present);
    if (hdr)
        ImGui::DragFloat3(label, &colour.x, 0.1f, 0, kMostEmission, "%.2f",
                          ImGuiSliderFlags_AlwaysClamp);
    else
        ImGui::SliderFloat3(label, &colour.x, 0, 1, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    if (ImGui::IsItemActive()) editing = id, edited = colour;
    if (!ImGui::IsItemDeactivatedAfterEdit()) {
        if (editing == id && !ImGui::IsItemActive()) editing = 0;
        return false;
    }
    editing = 0;
    stated = colour;
    return true;
}

void drawMaterial(Viewer& viewer, std::size_t i) {
    Objects& objects = viewer.objects();
    ObjectSource source = objects.scenario().objects[i].source;
    const Material& present = objects.now(i).model->scene().materials.front();
    bool changed = editColour("diffuse", source.diffuse, present.diffuse, false);
    changed |= editColour("mirror", source.mirror, present.mirror, false);
    changed |= editColour("emission", source.emission, present.emission, true);
    if (changed) viewer.attempt([&] { objects.setSource(i, source); });
}

void drawGather(GatherSettings& gather) {
    combo("light found at", kGatherPointNames, gather.points);
    if (gather.points == GatherPoints::vertices)
        ImGui::SliderInt("subdivision", &gather.subdivision, 0, ObjectModel::kMaxSubdivision);
    else
        ImGui::SliderFloat("texel", &gather.texelSize, 0, 0.2f,
                           gather.texelSize > 0 ? "%.3f m" : "by size",
                           ImGuiSliderFlags_AlwaysClamp);
    if (ImGui::BeginCombo("lines", std::to_string(gather.lines).c_str())) {
        for (const int lines : {33, 129, 513, 2049, 8193})
            if (ImGui::Selectable(std::to_string(lines).c_str(), lines == gather.lines))
                gather.lines = lines;
        ImGui::EndCombo();
    }
    ImGui::SliderInt("every so many", &gather.step, 1, 16, "%d", ImGuiSliderFlags_AlwaysClamp);
    ImGui::SliderInt("by importance", &gather.importanceSamples, 0, 1024,
                     gather.importanceSamples > 0 ? "%d" : "off", ImGuiSliderFlags_AlwaysClamp);
    ImGui::Checkbox("lamps by directions alone", &gather.emittersByDirections);
    ImGui::Checkbox("light near by used again", &gather.cache);
    ImGui::Checkbox("only what is seen", &gather.onlyVisible);
}

void drawPrt(PrtSettings& prt) {
    ImGui::SliderInt("order", &prt.order, 1, 5, "%d", ImGuiSliderFlags_AlwaysClamp);
    ImGui::Checkbox("light between its parts", &prt.reflections);
}

void drawHard(HardShadowSettings& hard) {
    if (ImGui::BeginCombo("shadow map", std::to_string(hard.mapSize).c_str())) {
        for (int size = 128; size <= 4096; size *= 2)
            if (ImGui::Selectable(std::to_string(size).c_str(), size == hard.mapSize))
                hard.mapSize = size;
        ImGui::EndCombo();
    }
    ImGui::SliderFloat("darkness", &hard.opacity, 0, 1, "%.2f", ImGuiSliderFlags_AlwaysClamp);
}

void drawLighting(Viewer& viewer, std::size_t i) {
    Objects& objects = viewer.objects();
    ObjectSettings settings = objects.now(i).settings;
    combo("shading", kShadingNames, settings.shading);
    if (settings.shading == Shading::gather) drawGather(settings.gather);
    if (settings.shading == Shading::prt) drawPrt(settings.prt);
    combo("shadow", kShadowNames, settings.shadow);
    if (settings.shadow == ShadowKind::hard) drawHard(settings.hard);
    ImGui::SliderInt("rays to lamps", &settings.directSamples, 1, 256, "%d",
                     ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    if (settings != objects.now(i).settings)
        viewer.attempt([&] { objects.setSettings(i, settings); });
}

void drawName(Objects& objects, std::size_t i) {
    std::string name = objects.scenario().objects[i].object.name;
    if (ImGui::InputText("name", &name)) objects.setName(i, name);
}

void drawSelected(Viewer& viewer, std::size_t i) {
    Objects& objects = viewer.objects();
    drawName(objects, i);
    drawPose(objects, i);
    drawMaterial(viewer, i);
    drawLighting(viewer, i);
    const bool copied = ImGui::Button("duplicate");
    ImGui::SameLine();
    const bool removed = ImGui::Button("remove");
    if (copied) objects.duplicate(i);
    if (removed) objects.remove(i);
}

}  // namespace

void drawObjectPanel(Viewer& viewer) {
    Objects& objects = viewer.objects();
    drawAdding(viewer);
    if (objects.size() == 0) return;
    drawList(objects);
    bool playing = objects.playing();
    if (ImGui::Checkbox("motions", &playing)) objects.setPlaying(playing);
    ImGui::SameLine();
    bool steered = objects.subject() == Subject::object;
    if (ImGui::Checkbox("keys move the object", &steered)) objects.toggleSubject();
    ImGui::SameLine();
    if (ImGui::Button("save")) viewer.saveObjects();
    ImGui::SameLine();
    if (ImGui::Button("compare")) viewer.compareNext();
    if (objects.selected()) drawSelected(viewer, *objects.selected());
}

}  // namespace vlf::app
