#pragma once
// Whoever draws the pictures of a room and the objects in it: the CPU, or OpenGL without a window.

#include "render_options.h"

#include "vlf/dynamic/scenario.h"
#include "vlf/io/field_file.h"
#include "vlf/render/gl/headless_context.h"
#include "vlf/render/gl/renderer.h"
#include "vlf/trace/ray_scene.h"

#include <optional>

namespace vlf::app {

class RoomRenderer {
  public:
    /// `room` must outlive it. Throws as Renderer, HeadlessContext and readObjects.
    RoomRenderer(const RenderOptions& options, const BakedRoom& room, const Globals& globals);

    /// Moves the objects to where the scenario has them at a time, s.
    void moveTo(double seconds);

    /// As renderStill.
    Image render(const StillParams& params, Progress& progress, StillReport& report);

    /// What the room takes in the memory of the GPU, if that draws.
    std::optional<GpuMemory> gpuMemory() const;

  private:
    const BakedRoom& room_;
    std::optional<RayScene> rays_;
    std::optional<gl::HeadlessContext> context_;
    std::optional<Renderer> renderer_;
    ModelLibrary models_;
    Scenario scenario_;
    std::optional<DynamicRoom> objects_;
};

}  // namespace vlf::app
