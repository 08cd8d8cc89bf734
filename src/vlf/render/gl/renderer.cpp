#include "vlf/render/gl/renderer.h"

#include "vlf/base/error.h"
#include "vlf/render/gl/atlas_fit.h"
#include "vlf/render/gl/drawings.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/gl_state.h"
#include "vlf/render/gl/gpu_memory.h"
#include "vlf/render/gl/hit_buffers.h"
#include "vlf/render/gl/object_pass.h"
#include "vlf/render/gl/packed_radiance.h"
#include "vlf/render/gl/reflection_probes.h"
#include "vlf/render/gl/room_geometry.h"
#include "vlf/render/gl/room_vertex_array.h"
#include "vlf/render/gl/scene_textures.h"
#include "vlf/render/gl/shader_library.h"
#include "vlf/render/gl/tone_data.h"
#include "vlf/trace/ray_scene.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace vlf {

namespace {

using namespace gl;
using namespace shared;

/// Surfaces of one depth count as one if they are closer than this in a subfield, in cells; as on
/// the CPU (render/cpu/radiance_lookup.cpp).
constexpr float kTolerance = 5;

constexpr float kNearest = 1e-3f;  ///< the near plane, of the field's radius

void requireLimit(std::uint64_t needed, GLenum limit, const std::string& what) {
    GLint most = 0;
    glGetIntegerv(limit, &most);
    if (needed > static_cast<std::uint64_t>(most))
        throw InputError(what + " (" + std::to_string(needed) + ") exceeds what this GPU holds (" +
                         std::to_string(most) + "); bake it coarser, or render with --backend cpu");
}

std::uint32_t textureSide(const RendererOptions& options) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    const auto side = static_cast<std::uint32_t>(most);
    return options.maxTextureSize > 0 ? std::min(side, options.maxTextureSize) : side;
}

TextureObject makeAtlasTexture(const IrradianceAtlas& atlas) {
    TextureObject texture = makeTexture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.id(), 1, GL_RGB9_E5, static_cast<GLsizei>(std::max(1u, atlas.width)),
                       static_cast<GLsizei>(std::max(1u, atlas.height)));
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTextureParameteri(texture.id(), wrap, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    return texture;
}

std::uint64_t bufferTexels(const RendererOptions& options) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    const auto texels = static_cast<std::uint64_t>(most);
    return options.maxBufferTexels > 0 ? std::min(texels, options.maxBufferTexels) : texels;
}

/// What is left for the radiance field where other things take `others` bytes.
RadianceLimits radianceLimits(const RendererOptions& options, std::uint64_t others) {
    RadianceLimits limits;
    limits.elements = std::min(limits.elements, 4 * bufferTexels(options));
    if (options.maxMemory > 0)
        limits.bytes = options.maxMemory - std::min(options.maxMemory, others);
    return limits;
}

}  // namespace

struct Renderer::Impl {
    Impl(const Scene& shown, const LightField& field, const RendererOptions& options)
        : scene(shown),
          lightField(field),
          shaders(options.shaderFolder),
          textures(scene),
          fit(field, textureSide(options)),
          objects(shaders, hits) {
        if (field.triangleCharts.size() != scene.triangles.size())
            throw InputError("the light field belongs to another scene: bake this one");
        const RoomGeometry room = makeRoomGeometry(scene, fit.layout());
        canLookUp = room.mirrorCharts.empty() || !field.radiance.empty();
        loadGeometry(room);
        atlas = makeAtlasTexture(fit.layout().atlas);
        if (fit.factor() > 1)
            notices.push_back("light is shown with " + std::to_string(fit.factor()) + " x " +
                              std::to_string(fit.factor()) +
                              " texels made one: the irradiance atlas is larger than a texture of "
                              "this GPU may be");
        loadIrradiance(field.atlas);
        viewBuffer = makeBuffer(nullptr, sizeof(ViewData), GL_DYNAMIC_STORAGE_BIT);
        nearest = kNearest * field.frame.radius;
        rayStart = rayEpsilon(scene);
        memory.textures = textureBytes(scene);
        loadRadiance(field, room.mirrorCharts, options);
        makePrograms();
    }

    void loadGeometry(const RoomGeometry& room) {
        batches = room.batches;
        indexCount = static_cast<GLsizei>(room.indices.size());
        mirrorTriangles = room.mirrorTriangles;
        vertices = makeBuffer(room.vertices.data(), room.vertices.size() * sizeof(RoomVertex));
        indices = makeBuffer(room.indices.data(), room.indices.size() * sizeof(std::uint32_t));
        vertexArray = makeRoomVertexArray(vertices, indices);
        for (const RoomBatch& batch : batches)
            materialBuffers.push_back(makeBuffer(&batch.data, sizeof batch.data));
        memory.geometry = bytesOf(room);
    }

    void loadRadiance(const LightField& field, const std::vector<std::uint32_t>& charts,
                      const RendererOptions& options) {
        const std::uint64_t others = memory.total();
        const RadianceLayout layout =
            layOutWithin(radianceLimits(options, others), field.radiance, charts);
        const PackedRadiance packed = packRadiance(field.radiance, charts, layout);
        requireLimit(layout.records.size(), GL_MAX_TEXTURE_BUFFER_SIZE,
                     "the number of mirrors times directions");
        elements = makeBuffer(packed.elements.data(), 4 * packed.elements.size());
        records = makeBuffer(layout.records.data(), sizeof(RadianceRecord) * layout.records.size());
        fourATexel = layout.elements > bufferTexels(options);
        elementTexture = makeBufferTexture(elements, fourATexel ? GL_RGBA32UI : GL_R32UI);
        recordTexture = makeBufferTexture(records, GL_RGBA32UI);
        if (layout.coarseness > 1)
            notices.push_back(
                "mirrors are shown with cells of " + std::to_string(layout.coarseness) + " x " +
                std::to_string(layout.coarseness) +
                " made one: all of the radiance field is too much for the GPU's memory");
        const RadianceField& r = field.radiance;
        const float diameter = 2 * field.frame.radius;
        const float cells = static_cast<float>(r.cells - 1) / static_cast<float>(layout.coarseness);
        viewData.fieldFrame = Vec4(field.frame.centre, cells / diameter);
        viewData.field = {std::sqrt(0.5f * static_cast<float>(std::max(r.lines, 1) - 1)), r.lines, 0.5f * cells,
                          kTolerance * diameter / std::max(cells, 1.0f)};
        viewData.elementCode = {packed.longestDistance, packed.logSum.first, packed.logSum.step, 0};
        viewData.shareCode = {packed.red.first, packed.red.step, packed.blue.first,
                              packed.blue.step};
        memory.radiance = layout.bytes();
        memory.radianceElements = layout.elements;
    }

    void loadIrradiance(const IrradianceAtlas& whole) {
        const IrradianceAtlas fitted = fit.unchanged() ? IrradianceAtlas{} : fit.fit(whole);
        const IrradianceAtlas& light = fit.unchanged() ? whole : fitted;
        std::vector<std::uint32_t> packed(light.irradiance.size());
        std::transform(light.irradiance.begin(), light.irradiance.end(), packed.begin(),
                       packRgb9e5);
        glTextureSubImage2D(atlas.id(), 0, 0, 0, static_cast<GLsizei>(light.width),
                            static_cast<GLsizei>(light.height), GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV,
                            packed.data());
        memory.atlas = 4 * packed.size();
    }

    /// Those of mode field, so that no frame waits for them.
    void makePrograms() {
        for (const RoomBatch& batch : batches)
            for (const LookupKind lookup : {LookupKind::depthCorrected, LookupKind::plain}) {
                RenderSettings settings;
                settings.lookup = lookup;
                shaders.program("surface", definesOf(batch, settings));
            }
    }

    /// Of the variant of the shader that draws a batch.
    Defines definesOf(const RoomBatch& batch, const RenderSettings& settings,
                      bool probed = false) const {
        const bool traced = settings.mode == DisplayMode::raytraced;
        Defines d;
        if (scene.materials[batch.material].diffuseTexture >= 0) d.emplace("DIFFUSE_MAP", "1");
        if (maxComponent(Vec3(batch.data.emission)) > 0) d.emplace("EMISSION", "1");
        if (batch.mirror)
            d.emplace("MIRROR", traced ? "\"traced_reflection.glsl\"" : "\"radiance_field.glsl\"");
        if (batch.mirror && !traced && settings.lookup == LookupKind::plain)
            d.emplace("PLAIN", "1");
        if (batch.mirror && !objects.empty()) d.emplace("OBJECTS", "1");
        if (probed) d.emplace("PROBED", std::to_string(ReflectionProbes::kSize));
        if (batch.mirror && !probed && !traced && !objects.probeCentres().empty())
            d.emplace("PROBES", "1");
        if (batch.mirror && !traced && fourATexel) d.emplace("FOUR_A_TEXEL", "1");
        return d;
    }

    void makeReady(DisplayMode mode) {
        if (!showsRadiance(mode)) {
            if (!drawings) drawings.emplace(scene, lightField, shaders);
        } else if (mode == DisplayMode::raytraced) {
            if (!hits.hasRoom()) loadHits();
        } else if (mode != DisplayMode::field) {
            throw InputError("mode progressive takes many calls: it is ProgressiveRenderer's");
        } else if (!canLookUp) {
            throw InputError(
                "the light field holds no radiance of mirrors to look up: bake with "
                "radiance directions, or trace reflections (mode raytraced)");
        }
    }

    void loadHits() {
        const LightField layout = fit.layout();
        hits.loadRoom(scene, layout.charts, layout.triangleCharts, mirrorTriangles);
        objects.hitsReloaded();
        memory.hits = hits.bytes();
    }

    void updateObjects(const DynamicRoom& room) {
        if (!change)
            change.emplace(scene, lightField,
                           !mirrorTriangles.empty() && canLookUp && fit.unchanged());
        change->update(room.irradiance(), room.roomIrradiance());
        objects.update(room);
        objects.setChange(*change);
        probesStale = true;
        if (room.irradianceVersion() != roomVersion) loadIrradiance(room.irradiance());
        roomVersion = room.irradianceVersion();
        memory.hits = hits.bytes();
        memory.objects = objects.bytes() + change->bytes() + probes.bytes();
        ++lightChanges;
    }

    void draw(const View& view, const RenderSettings& settings, GLuint framebuffer) {
        makeReady(settings.mode);
        const StateGuard guard;
        setView(view, settings);
        if (settings.mode == DisplayMode::wireframe)
            drawWireframe(view, settings, framebuffer);
        else if (settings.mode == DisplayMode::diagram)
            drawDiagram(view, settings, framebuffer);
        else
            drawRoom(view, settings, framebuffer);
        if (drawings) memory.drawings = drawings->bytes();
    }

    void drawRoom(const View& view, const RenderSettings& settings, GLuint framebuffer) {
        if (settings.mode == DisplayMode::field) drawProbes();
        prepare(view, framebuffer);
        if (!objects.empty()) {
            bindObjects();
            objects.draw(settings);
        }
        drawBatches(settings);
    }

    void bindObjects() const {
        objects.bind();
        change->bind();
        probes.bind();
    }

    void drawBatches(const RenderSettings& settings, bool probed = false) {
        glBindVertexArray(vertexArray.id());
        for (std::size_t i = 0; i < batches.size(); ++i)
            drawBatch(i, definesOf(batches[i], settings, probed));
    }

    /// What mirror objects show, if it may have changed.
    void drawProbes() {
        if (objects.probeCentres().empty() || !std::exchange(probesStale, false)) return;
        RenderSettings settings;
        settings.tone.reset();
        const ViewData shown = viewData;
        probes.draw(objects.probeCentres(), nearest,
                    [&](const Mat4& clipFromWorld, const Vec3& eye, GLuint framebuffer) {
                        View face;
                        face.width = face.height = ReflectionProbes::kSize;
                        face.clipFromWorld = clipFromWorld;
                        face.eye = eye;
                        setView(face, settings);
                        prepare(face, framebuffer);
                        bindObjects();
                        drawBatches(settings, true);
                    });
        viewData = shown;
        glNamedBufferSubData(viewBuffer.id(), 0, sizeof viewData, &viewData);
        memory.objects = objects.bytes() + change->bytes() + probes.bytes();
    }

    void setView(const View& view, const RenderSettings& settings) {
        viewData.clipFromWorld = view.clipFromWorld;
        viewData.eye = Vec4(view.eye, rayStart);
        viewData.tone = toneData(settings);
        glNamedBufferSubData(viewBuffer.id(), 0, sizeof viewData, &viewData);
    }

    void drawWireframe(const View& view, const RenderSettings& settings, GLuint framebuffer) {
        prepare(view, framebuffer);
        const auto drawTriangles = [&] {
            glBindVertexArray(vertexArray.id());
            glDrawElements(GL_TRIANGLES, indexCount, GL_UNSIGNED_INT, nullptr);
            objects.drawTriangles(shaders.program("depth", {{"OBJECT", "1"}}));
        };
        const auto drawLines = [&](LinePass& lines) { objects.drawLines(lines, settings.normals); };
        drawings->wireframe(view, settings.normals, drawTriangles, drawLines, framebuffer);
    }

    void drawDiagram(const View& view, const RenderSettings& settings, GLuint framebuffer) {
        const DiagramKind kind = settings.diagram.kind;
        if (kind == DiagramKind::subfield || kind == DiagramKind::tile) {
            prepare(view, framebuffer);
            drawings->subfield(view, settings.diagram, settings.diagramCamera, framebuffer);
            return;
        }
        if (kind == DiagramKind::chart && !fit.unchanged())
            throw InputError(
                "the texels of a chart cannot be shown: this GPU shows the irradiance atlas packed "
                "anew; render the diagram with --backend cpu");
        RenderSettings beneath = settings;
        beneath.mode = settings.diagramRoom;
        makeReady(beneath.mode);
        drawRoom(view, beneath, framebuffer);
        if (kind == DiagramKind::directions)
            drawings->directions(settings.ball);
        else
            drawings->chart(settings.diagram, settings.diagramCamera, atlas.id());
    }

    void prepare(const View& view, GLuint framebuffer) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glViewport(view.x, view.y, view.width, view.height);
        const PixelRectangle part =
            view.part.value_or(PixelRectangle{view.x, view.y, view.width, view.height});
        glScissor(part.x, part.y, part.width, part.height);
        glEnable(GL_SCISSOR_TEST);
        for (const GLenum off :
             {GL_BLEND, GL_STENCIL_TEST, GL_FRAMEBUFFER_SRGB, GL_POLYGON_OFFSET_FILL})
            glDisable(off);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LEQUAL);
        glDepthMask(GL_TRUE);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glFrontFace(GL_CCW);
        glCullFace(GL_BACK);
        glClearColor(0, 0, 0, 1);
        glClearDepthf(1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glBindBufferBase(GL_UNIFORM_BUFFER, kViewBlock, viewBuffer.id());
        for (int unit = 0; unit < kUnits; ++unit) glBindSampler(static_cast<GLuint>(unit), 0);
        glBindTextureUnit(kIrradianceUnit, atlas.id());
        glBindTextureUnit(kElementUnit, elementTexture.id());
        glBindTextureUnit(kRecordUnit, recordTexture.id());
        hits.bind();
    }

    void drawBatch(std::size_t i, const Defines& defines) {
        const RoomBatch& batch = batches[i];
        const Material& material = scene.materials[batch.material];
        glUseProgram(shaders.program("surface", defines));
        (batch.cull ? glEnable : glDisable)(GL_CULL_FACE);
        textures.bind(kDiffuseUnit, material.diffuseTexture);
        textures.bind(kEmissionUnit, material.emissionTexture);
        textures.bind(kMirrorMapUnit, material.mirrorTexture);
        glBindBufferBase(GL_UNIFORM_BUFFER, kMaterialBlock, materialBuffers[i].id());
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(batch.indexCount), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(4 * std::size_t{batch.firstIndex}));
    }

    const Scene& scene;
    const LightField& lightField;
    ShaderLibrary shaders;
    SceneTextures textures;
    std::vector<RoomBatch> batches;
    Buffer vertices, indices, elements, records, viewBuffer;
    std::vector<Buffer> materialBuffers;  ///< of each batch
    VertexArray vertexArray;
    AtlasFit fit;
    TextureObject atlas, elementTexture, recordTexture;
    std::vector<std::uint32_t> mirrorTriangles;
    HitBuffers hits;  ///< of the room once reflections are traced
    ObjectPass objects;
    std::optional<ChangedLight> change;  ///< once objects have been there
    ReflectionProbes probes;
    bool probesStale = true;
    std::uint64_t roomVersion = 0;  ///< of the DynamicRoom's irradiance
    std::optional<Drawings> drawings;  ///< once one is drawn
    GLsizei indexCount = 0;
    ViewData viewData{};
    GpuMemory memory;
    std::vector<std::string> notices;
    bool fourATexel = false;  ///< elements of the radiance field
    float nearest = 0, rayStart = 0;  ///< metres
    bool canLookUp = true;
    std::uint64_t lightChanges = 0;
};

Renderer::Renderer(const Scene& scene, const LightField& field, const RendererOptions& options)
    : impl_(std::make_unique<Impl>(scene, field, options)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::draw(const View& view, const RenderSettings& settings, unsigned framebuffer) {
    impl_->draw(view, settings, framebuffer);
}

Camera Renderer::diagramView(const DiagramParams& params, const Camera& camera, int width,
                             int height) {
    if (params.kind != DiagramKind::subfield && params.kind != DiagramKind::tile) return camera;
    impl_->makeReady(DisplayMode::diagram);
    return impl_->drawings->overview(params, camera, width, height);
}

void Renderer::updateIrradiance(const IrradianceAtlas& atlas) {
    impl_->loadIrradiance(atlas);
    impl_->probesStale = true;
    ++impl_->lightChanges;
}

void Renderer::updateObjects(const DynamicRoom& room) {
    impl_->updateObjects(room);
}

bool Renderer::canLookUp() const {
    return impl_->canLookUp;
}

std::uint64_t Renderer::lightChanges() const {
    return impl_->lightChanges;
}

void Renderer::reloadShaders() {
    impl_->shaders.reload();
    impl_->probesStale = true;
}

float Renderer::nearest() const {
    return impl_->nearest;
}

const std::vector<std::string>& Renderer::notices() const {
    return impl_->notices;
}

const GpuMemory& Renderer::memory() const {
    return impl_->memory;
}

}  // namespace vlf
