#include "object_panel.h"

#include "viewer.h"

#include "vlf/dynamic/object_names.h"
#include "vlf/scene/generate/primitives.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>
#include <imgui_stdlib.h>

namespace vlf::app {

namespace {

constexpr float kMoveStep = 0.005f, kTurnStep = 0.5f, kScaleStep = 0.005f;  // of a drag, a pixel
constexpr float kLeastScale = 1e-4f, kMostScale = 1e4f;
constexpr float kFarthest = 1e5f;      // metres
constexpr float kLargestTexel = 0.2f;  // metres
constexpr float kMostTexels = 1 << 16;
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

void drawList(Objects& objects) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        bool visible = objects.now(i).visible;
        if (ImGui::Checkbox("##visible", &visible)) objects.setVisible(i, visible);
        ImGui::SameLine();
        const std::string& name = objects.name(i);
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

/// A colour of the source, or, if it states none, that of the first material.
void drawColour(const char* label, std::optional<Vec3>& stated, const Vec3& present) {
    Vec3 colour = stated.value_or(present);
    if (ImGui::SliderFloat3(label, &colour.x, 0, 1, "%.2f", ImGuiSliderFlags_AlwaysClamp))
        stated = colour;
}

void drawEmission(std::optional<Vec3>& stated, const Vec3& present) {
    Vec3 colour = stated.value_or(present);
    if (ImGui::DragFloat3("emission", &colour.x, 0.1f, 0, kMostEmission, "%.2f",
                          ImGuiSliderFlags_AlwaysClamp))
        stated = colour;
}

/// 0: by the object's size.
void drawTexel(float& texel, const Scene& model) {
    const char* format = texel > 0 ? "%.3f m" : "by size";
    if (!ImGui::SliderFloat("texel", &texel, 0, kLargestTexel, format,
                            ImGuiSliderFlags_AlwaysClamp) ||
        texel <= 0)
        return;
    float surface = 0;
    for (std::uint32_t t = 0; t < model.triangles.size(); ++t) surface += area(model, t);
    texel = std::max(texel, std::sqrt(surface / kMostTexels));
}

void drawSubdivision(GatherSettings& gather) {
    ImGui::SliderInt("subdivision", &gather.subdivision, 0, ObjectModel::kMaxSubdivision, "%d",
                     ImGuiSliderFlags_AlwaysClamp);
}

void drawGather(GatherSettings& gather, const Scene& model) {
    combo("light found at", kGatherPointNames, gather.points);
    if (gather.points == GatherPoints::vertices)
        drawSubdivision(gather);
    else
        drawTexel(gather.texelSize, model);
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

void drawLighting(Objects& objects, std::size_t i) {
    ObjectSettings settings = objects.now(i).settings;
    combo("shading", kShadingNames, settings.shading);
    if (settings.shading == Shading::gather)
        drawGather(settings.gather, objects.now(i).model->scene());
    if (settings.shading == Shading::lights || settings.shading == Shading::prt)
        drawSubdivision(settings.gather);
    if (settings.shading == Shading::prt) drawPrt(settings.prt);
    combo("shadow", kShadowNames, settings.shadow);
    if (settings.shadow == ShadowKind::hard) drawHard(settings.hard);
    ImGui::SliderInt("rays to lamps", &settings.directSamples, 1, 256, "%d",
                     ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    if (settings != objects.now(i).settings) objects.setSettings(i, settings);
}

void drawName(Objects& objects, std::size_t i) {
    std::string name = objects.name(i);
    if (ImGui::InputText("name", &name)) objects.setName(i, name);
}

}  // namespace

void ObjectPanel::drawAdding() {
    for (const std::string& name : primitiveNames()) {
        if (ImGui::Button(name.c_str())) viewer_.addObject(name);
        ImGui::SameLine();
    }
    ImGui::TextDisabled("add one");
    const bool entered = ImGui::InputTextWithHint("##add", "cube:0.3:red or chair.glb", &adding_,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    if ((ImGui::Button("add") || entered) && !adding_.empty()) viewer_.addObject(adding_);
}

/// A model is made anew when the mouse lets go of a colour.
void ObjectPanel::drawMaterial(std::size_t i) {
    Objects& objects = viewer_.objects();
    const bool edits = editing_ && editing_->object == objects.id(i);
    ObjectSource source = edits ? editing_->source : objects.scenario().objects[i].source;
    const Material& present = objects.now(i).model->scene().materials.front();
    bool held = false, released = false;
    const auto look = [&] {
        held |= ImGui::IsItemActive();
        released |= ImGui::IsItemDeactivatedAfterEdit();
    };
    drawColour("diffuse", source.diffuse, present.diffuse);
    look();
    drawColour("mirror", source.mirror, present.mirror);
    look();
    drawEmission(source.emission, present.emission);
    look();
    editing_.reset();
    if (held) editing_ = {objects.id(i), source};
    if (released) viewer_.attempt([&] { objects.setSource(i, source); });
}

void ObjectPanel::drawSelected(std::size_t i) {
    Objects& objects = viewer_.objects();
    // What is typed or dragged is of this object alone, though another be selected meanwhile.
    ImGui::PushID(std::to_string(objects.id(i)).c_str());
    drawName(objects, i);
    drawPose(objects, i);
    drawMaterial(i);
    drawLighting(objects, i);
    const bool copied = ImGui::Button("duplicate");
    ImGui::SameLine();
    const bool removed = ImGui::Button("remove");
    ImGui::PopID();
    if (copied) objects.duplicate(i);
    if (removed) objects.remove(i);
}

void ObjectPanel::draw() {
    Objects& objects = viewer_.objects();
    drawAdding();
    if (objects.size() == 0) return;
    drawList(objects);
    bool playing = objects.playing();
    if (ImGui::Checkbox("motions", &playing)) objects.setPlaying(playing);
    ImGui::SameLine();
    bool steered = objects.subject() == Subject::object;
    if (ImGui::Checkbox("keys move the object", &steered)) objects.toggleSubject();
    ImGui::SameLine();
    if (ImGui::Button("save")) viewer_.saveObjects();
    ImGui::SameLine();
    if (ImGui::Button("compare")) viewer_.compareNext();
    if (objects.selected()) drawSelected(*objects.selected());
}

}  // namespace vlf::app
