#include "room_renderer.h"

#include "gpu_options.h"

#include "vlf/render/gl/still.h"

namespace vlf::app {

namespace {

/// Of the options, or of the path that the camera follows.
Scenario objectsToShow(const RenderOptions& options, const Scene& room, ModelLibrary& models,
                       const Globals& globals) {
    Scenario scenario = readObjects(options.objects, room, models, globals);
    if (options.film.path.empty()) return scenario;
    Walk walk = readWalk(options.film.path, options.objects, models, globals);
    return walk.objects.objects.empty() ? std::move(scenario) : std::move(walk.objects);
}

}  // namespace

RoomRenderer::RoomRenderer(const RenderOptions& options, const BakedRoom& room,
                           const Globals& globals)
    : room_(room) {
    scenario_ = objectsToShow(options, room.scene, models_, globals);
    if (options.backend == Backend::cpu || !scenario_.objects.empty()) rays_.emplace(room.scene);
    if (options.backend == Backend::gl) {
        context_.emplace();
        renderer_.emplace(room.scene, room.field, options.gpu);
        printNotices(globals.quiet, *renderer_);
    }
    if (scenario_.objects.empty()) return;
    objects_.emplace(room.scene, *rays_, room.field);
    for (const ScenarioObject& object : scenario_.objects) objects_->add(object.object);
    moveTo(options.objects.moment);
}

void RoomRenderer::moveTo(double seconds) {
    if (!objects_) return;
    vlf::moveTo(*objects_, scenario_, seconds);
    objects_->update();
}

Image RoomRenderer::render(const StillParams& params, Progress& progress, StillReport& report) {
    StillParams withObjects = params;
    withObjects.objects = objects_ ? &*objects_ : nullptr;
    if (renderer_) return renderStill(*renderer_, withObjects, progress, &report);
    return renderStill(room_.scene, *rays_, room_.field, withObjects, progress, &report);
}

std::optional<GpuMemory> RoomRenderer::gpuMemory() const {
    if (!renderer_) return {};
    return renderer_->memory();
}

}  // namespace vlf::app
