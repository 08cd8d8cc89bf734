#include "room_renderer.h"

#include "gpu_options.h"

#include "vlf/base/error.h"
#include "vlf/render/gl/still.h"

namespace vlf::app {

RoomRenderer::RoomRenderer(const RenderOptions& options, const BakedRoom& room,
                           const Globals& globals)
    : room_(room) {
    if (options.backend == Backend::gl && options.objects.any())
        throw InputError("--object and --scenario: OpenGL draws no objects; use --backend cpu");
    if (options.backend == Backend::cpu) {
        rays_.emplace(room.scene);
    } else {
        context_.emplace();
        renderer_.emplace(room.scene, room.field, options.gpu);
        printNotices(globals.quiet, *renderer_);
    }
    if (!options.objects.any()) return;
    scenario_ = readObjects(options.objects, room.scene, models_, globals);
    objects_.emplace(room.scene, *rays_, room.field);
    for (const ScenarioObject& object : scenario_.objects) objects_->add(object.object);
    moveTo(options.moment);
}

void RoomRenderer::moveTo(double seconds) {
    if (!objects_) return;
    vlf::moveTo(*objects_, scenario_, seconds);
    objects_->update();
}

Image RoomRenderer::render(const StillParams& params, Progress& progress, StillReport& report) {
    if (renderer_) return renderStill(*renderer_, params, progress, &report);
    StillParams withObjects = params;
    withObjects.objects = objects_ ? &*objects_ : nullptr;
    return renderStill(room_.scene, *rays_, room_.field, withObjects, progress, &report);
}

std::optional<GpuMemory> RoomRenderer::gpuMemory() const {
    if (!renderer_) return {};
    return renderer_->memory();
}

}  // namespace vlf::app
