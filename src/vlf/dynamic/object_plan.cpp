#include "vlf/dynamic/object_plan.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

/// The one that fits, or null; forgets those that nobody uses.
template <class Plan, class Fits>
std::shared_ptr<const Plan> find(std::vector<std::weak_ptr<const Plan>>& plans, Fits fits) {
    std::erase_if(plans, [](const auto& plan) { return plan.expired(); });
    for (const auto& weak : plans)
        if (const auto plan = weak.lock(); plan && fits(*plan)) return plan;
    return nullptr;
}

/// Patches that share rays are no wider than a few texels of the room, by which `texels` are
/// counted.
float patchesAcross(int texels) {
    return std::max(4.0f, 0.12f * std::sqrt(static_cast<float>(texels)));
}

}  // namespace

std::shared_ptr<const ObjectPlan> ObjectPlans::plan(const DynamicObject& object, int texels) {
    const Shading shading = object.settings.shading;
    GatherSettings settings = object.settings.gather;
    if (shading != Shading::gather) settings.points = GatherPoints::vertices;
    const PrtSettings& prt = object.settings.prt;
    const auto found = find(plans_, [&](const ObjectPlan& p) {
        return p.model == object.model && p.shading == shading && p.settings == settings &&
               p.prt == prt && p.texels == texels;
    });
    if (found) return found;
    auto plan = std::make_shared<ObjectPlan>();
    plan->model = object.model;
    plan->shading = shading;
    plan->settings = settings;
    plan->prt = prt;
    plan->texels = texels;
    plan->receivers = makeReceivers(*object.model, settings, texels);
    if (object.model->emits())
        plan->emitting = std::make_unique<const Unwrap>(unwrapObject(*object.model, 0, texels));
    if (shading == Shading::gather)
        plan->gather = makeGatherPlan(*plan->receivers, object.model->bounds(),
                                      {settings.lines, settings.step, patchesAcross(texels)});
    if (shading == Shading::prt)
        plan->transfer = transfers_.transfer(object.model, settings.subdivision, prt);
    plans_.push_back(plan);
    return plan;
}

std::shared_ptr<const LinesPlan> ObjectPlans::linesPlan(
    const std::shared_ptr<const ObjectPlan>& plan, int lines, float cell) {
    const auto found = find(lines_, [&](const LinesPlan& l) {
        return l.of == plan && l.lines == lines && std::abs(l.cell - cell) <= 1e-4f * cell;
    });
    if (found) return found;
    auto made = std::make_shared<LinesPlan>();
    made->of = plan;
    made->lines = lines;
    made->cell = cell;
    made->data = makeObjectLines(*plan->receivers, plan->model->bounds(), lines, cell);
    lines_.push_back(made);
    return made;
}

}  // namespace vlf
