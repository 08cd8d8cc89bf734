#pragma once
// Pictures of a baked room by OpenGL 4.5, in a context of the host's. The same few lookups per
// pixel in every room: diffuse light from the irradiance atlas, mirrors from the radiance field.

#include "vlf/field/light_field.h"
#include "vlf/image/tone_map.h"
#include "vlf/render/cpu/radiance_lookup.h"
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
    LookupKind lookup = LookupKind::depthCorrected;  ///< of mirrors
    std::optional<ToneCurve> tone =
        ToneCurve::filmic;  ///< none: writes radiance, for float targets
    float textureBias = 0;  ///< added to the level of detail; negative: sharper, where pictures are
                            ///< averaged
    float exposure = 0;     ///< EV, before the tone curve; tone-mapped colours are sRGB-encoded
};

/// Bytes in the memory of the GPU.
struct GpuMemory {
    std::uint64_t geometry = 0, atlas = 0, radiance = 0, textures = 0;
    std::uint64_t radianceElements = 0;

    std::uint64_t total() const { return geometry + atlas + radiance + textures; }
};

/// Every call, construction and destruction included, needs the context current in which it was
/// made; draw() leaves the context's state as it finds it.
class Renderer {
  public:
    /// Copies what it needs to the GPU. Throws InputError if the field is not of this scene, it has
    /// mirrors but no radiance of them, the atlas or, at its coarsest, the radiance field exceed
    /// what the GPU or options.maxMemory can hold, or a shader of options.shaderFolder is at fault.
    Renderer(const Scene& scene, const LightField& field, const RendererOptions& options = {});
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    /// Clears the view's rectangle of `framebuffer`, which needs a depth attachment, and draws.
    void draw(const View& view, const RenderSettings& settings, unsigned framebuffer);

    /// The light has changed: the atlas is of the same charts as before.
    void updateIrradiance(const IrradianceAtlas& atlas);

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
