#include "room_renderer.h"

#include "gpu_options.h"

#include "vlf/render/gl/still.h"

namespace vlf::app {

RoomRenderer::RoomRenderer(const RenderOptions& options, const BakedRoom& room, bool quiet)
    : room_(room) {
    if (options.backend == Backend::cpu) {
        rays_.emplace(room.scene);
    } else {
        context_.emplace();
        renderer_.emplace(room.scene, room.field, options.gpu);
        printNotices(quiet, *renderer_);
    }
}

Image RoomRenderer::render(const StillParams& params, Progress& progress, StillReport& report) {
    if (renderer_) return renderStill(*renderer_, params, progress, &report);
    return renderStill(room_.scene, *rays_, room_.field, params, progress, &report);
}

std::optional<GpuMemory> RoomRenderer::gpuMemory() const {
    if (!renderer_) return {};
    return renderer_->memory();
}

}  // namespace vlf::app
