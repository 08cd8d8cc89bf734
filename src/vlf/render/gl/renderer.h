#pragma once
// Pictures of a baked room by OpenGL 4.5, in a context of the host's. Diffuse light
// comes from the irradiance atlas, mirrors from the radiance field, which is the same few lookups
// per pixel in every room, or by tracing reflections.

#include "vlf/dynamic/dynamic_room.h"
#include "vlf/field/light_field.h"
#include "vlf/image/tone_map.h"
#include "vlf/render/cpu/still.h"
#include "vlf/render/gl/view.h"
#include "vlf/scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vlf {

struct RendererOptions {
    std::string shaderFolder;           ///< files here are used in place of the built-in shaders
    std::uint64_t maxMemory = 0;        ///< bytes on the GPU, 0: no limit; see Renderer::notices
    std::uint32_t maxTextureSize = 0;   ///< texels along a side, 0: as the GPU allows
    std::uint64_t maxBufferTexels = 0;  ///< texels of a buffer texture, 0: as the GPU allows
};

struct RenderSettings {
    DisplayMode mode = DisplayMode::field;
    LookupKind lookup = LookupKind::depthCorrected;  ///< of mirrors
    std::optional<ToneCurve> tone =
        ToneCurve::filmic;  ///< none: writes radiance, or of drawings
                            ///< display-linear colours, for float targets
    float textureBias = 0;  ///< added to the level of detail; negative: sharper, where pictures are
                            ///< averaged
    float exposure = 0;     ///< EV, before the tone curve; tone-mapped colours are sRGB-encoded

    bool normals = false;                          ///< of mode wireframe
    DiagramParams diagram;                         ///< of mode diagram
    DisplayMode diagramRoom = DisplayMode::field;  ///< or raytraced: of the dimmed room beneath
                                                   ///< the diagrams `directions` and `chart`
    Camera diagramCamera;        ///< what `diagram` leaves open is chosen to show well from here
    std::optional<Sphere> ball;  ///< where diagram `directions` hangs its ball, metres; none: in
                                 ///< the middle of the room
};

/// Bytes in the memory of the GPU.
struct GpuMemory {
    std::uint64_t geometry = 0, atlas = 0, radiance = 0, textures = 0;
    std::uint64_t hits = 0;      ///< of traced reflections, once they have been drawn
    std::uint64_t drawings = 0;  ///< of modes wireframe and diagram, likewise
    std::uint64_t objects = 0;   ///< once there are any, but for what is in `hits`
    std::uint64_t radianceElements = 0;

    std::uint64_t total() const {
        return geometry + atlas + radiance + textures + hits + drawings + objects;
    }
};

/// Every call, construction and destruction included, needs the context current in which it was
/// made; draw() leaves the context's state as it finds it.
class Renderer {
  public:
    /// Copies what it needs to the GPU; of scene and field, which must outlive it, what traced
    /// reflections and drawings need when they are first drawn. Throws InputError if the field is
    /// not of this scene, the atlas or, at its coarsest, the radiance field exceed what the GPU or
    /// options.maxMemory can hold, or a shader of options.shaderFolder is at fault.
    Renderer(const Scene& scene, const LightField& field, const RendererOptions& options = {});
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    /// Clears the view's part of `framebuffer`, which needs a depth attachment, and draws. Throws
    /// InputError for mode `progressive` (see ProgressiveRenderer), in mode field if the scene has
    /// mirrors but the field no radiance of them (see canLookUp), as drawDiagram does, if what mode
    /// raytraced or a drawing needs exceeds what the GPU can hold, or a shader of
    /// options.shaderFolder is at fault. Drawings leave a depth buffer that is clear, but for the
    /// diagrams `directions` and `chart`.
    void draw(const View& view, const RenderSettings& settings, unsigned framebuffer);

    /// From where to look at a diagram: of kind `subfield` or `tile` at the whole bounding sphere
    /// along the camera's line of sight, else the camera itself. Throws as draw() does.
    Camera diagramView(const DiagramParams& params, const Camera& camera, int width, int height);

    /// The light has changed: the atlas is of the same charts as before.
    void updateIrradiance(const IrradianceAtlas& atlas);

    /// Draws the visible objects of `room` from now on, and the room in the light that it has with
    /// them (as updateIrradiance does). To be called after each DynamicRoom::update(), always with
    /// the same one, which must be of this scene and field; copies what has changed. Throws
    /// InputError if that exceeds what the GPU can hold.
    void updateObjects(const DynamicRoom& room);

    /// Whether mode `field` can be drawn.
    bool canLookUp() const;

    /// How often the light or objects have changed.
    std::uint64_t lightChanges() const;

    /// The files of options.shaderFolder have changed: makes the shaders anew. Throws InputError
    /// with the driver's message; the old ones are then kept.
    void reloadShaders();

    const GpuMemory& memory() const;

    /// What is shown less finely than the field has it, for want of memory: sentences for the user.
    const std::vector<std::string>& notices() const;

    /// Distance of a near plane that suits the room, metres.
    float nearest() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vlf
