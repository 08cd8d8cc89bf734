#include "vlf/render/gl/renderer.h"

#include "vlf/base/error.h"
#include "vlf/render/gl/drawings.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/gl_state.h"
#include "vlf/render/gl/gpu_memory.h"
#include "vlf/render/gl/irradiance_texture.h"
#include "vlf/render/gl/mirror_region.h"
#include "vlf/render/gl/object_stage.h"
#include "vlf/render/gl/radiance_buffers.h"
#include "vlf/render/gl/room_geometry.h"
#include "vlf/render/gl/room_vertex_array.h"
#include "vlf/render/gl/scene_textures.h"
#include "vlf/render/gl/shader_library.h"
#include "vlf/render/gl/sky_picture.h"
#include "vlf/render/gl/tone_data.h"
#include "vlf/trace/ray_scene.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace vlf {

namespace {

using namespace gl;
using namespace shared;

constexpr float kNearest = 1e-3f;  ///< the near plane, of the field's radius

std::uint32_t textureSide(const RendererOptions& options) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    const auto side = static_cast<std::uint32_t>(most);
    return options.maxTextureSize > 0 ? std::min(side, options.maxTextureSize) : side;
}

std::uint64_t bufferTexels(const RendererOptions& options) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    const auto texels = static_cast<std::uint64_t>(most);
    return options.maxBufferTexels > 0 ? std::min(texels, options.maxBufferTexels) : texels;
}

PixelRectangle partOf(const View& view) {
    return view.part.value_or(PixelRectangle{view.x, view.y, view.width, view.height});
}

const LightField& requireSameScene(const Scene& scene, const LightField& field) {
    if (field.triangleCharts.size() != scene.triangles.size())
        throw InputError("the light field belongs to another scene: bake this one");
    return field;
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
          sky(scene.environment, textureSide(options)),
          atlas(requireSameScene(scene, field), textureSide(options)),
          canLookUp(!hasSpecular(scene, MirrorKind::perfect) || !field.radiance.empty()),
          showsPanes(hasPane(scene)),
          objects(scene, field, shaders,
                  (hasMirror(scene, MirrorKind::rough) ||
                   (hasSpecular(scene, MirrorKind::perfect) && canLookUp)) &&
                      atlas.fit().unchanged()) {
        if (hasMirror(scene, MirrorKind::rough) && field.gloss.empty())
            throw InputError(
                "the light field holds no radiance of rough mirrors: bake with gloss directions");
        const RoomGeometry room = makeRoomGeometry(scene, atlas.fit().layout());
        loadGeometry(room);
        if (const std::uint32_t k = atlas.fit().factor(); k > 1)
            notices.push_back("light is shown with " + std::to_string(k) + " x " +
                              std::to_string(k) +
                              " texels made one: the irradiance atlas is larger than a texture of "
                              "this GPU may be");
        memory.atlas = atlas.bytes();
        viewBuffer = makeBuffer(nullptr, sizeof(ViewData), GL_DYNAMIC_STORAGE_BIT);
        nearest = kNearest * field.frame.radius;
        rayStart = rayEpsilon(scene);
        memory.textures = textureBytes(scene);
        if (!sky.isBlack()) shaders.setCommon({{"SKY", 1}});
        loadRadiance(radiance, lightField.radiance, room.mirrorCharts, options);
        loadRadiance(gloss, lightField.gloss, room.roughCharts, options);
        makePrograms();
    }

    void loadGeometry(const RoomGeometry& room) {
        batches = room.batches;
        mirrorTriangles = room.mirrorTriangles;
        vertices = makeBuffer(room.vertices.data(), room.vertices.size() * sizeof(RoomVertex));
        indices = makeBuffer(room.indices.data(), room.indices.size() * sizeof(std::uint32_t));
        vertexArray = makeRoomVertexArray(vertices, indices);
        for (const RoomBatch& batch : batches) {
            materialBuffers.push_back(makeBuffer(&batch.data, sizeof batch.data));
            mirrorPlanes.push_back(batch.mirror ? mirrorPlanesOf(scene, lightField, room, batch)
                                                : MirrorPlanes{});
            planes += mirrorPlanes.back().anywhere ? MirrorPlanes::kMost
                                                   : mirrorPlanes.back().planes.size();
        }
        memory.geometry = bytesOf(room);
    }

    void loadRadiance(std::optional<RadianceBuffers>& buffers, const RadianceField& stored,
                      const std::vector<std::uint32_t>& charts, const RendererOptions& options) {
        buffers.emplace(lightField.frame, stored, charts, radianceLimits(options, memory.total()),
                        bufferTexels(options));
        const std::string k = std::to_string(buffers->coarseness());
        if (buffers->coarseness() > 1)
            notices.push_back("mirrors are shown with cells of " + k + " x " + k +
                              " made one: all of the radiance field is too much for the GPU's "
                              "memory");
        memory.radiance += buffers->bytes();
        memory.radianceElements += buffers->elements();
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

    /// Of the variant of the shader that draws a batch. `withObjects`: as far as they concern it;
    /// `probed`: in a reflection probe.
    Defines definesOf(const RoomBatch& batch, const RenderSettings& settings,
                      bool withObjects = false, bool probed = false) const {
        const bool traced = batch.mirror && settings.mode == DisplayMode::raytraced;
        const bool lookedUp = batch.rough || (batch.mirror && !traced);
        // What solid glass shows by lookup are not reflections alone, among which objects are
        // found.
        const bool reflects = batch.mirror && (traced || !batch.glass || batch.pane);
        Defines d;
        if (scene.materials[batch.material].diffuseTexture >= 0) d.add({"DIFFUSE_MAP", 1});
        if (maxComponent(Vec3(batch.data.emission)) > 0) d.add({"EMISSION", 1});
        if (traced) d.add({"MIRROR", "\"traced_reflection.glsl\""});
        if (lookedUp) d.add({"MIRROR", "\"radiance_field.glsl\""});
        if (lookedUp && settings.lookup == LookupKind::plain)
            d.add({"PLAIN", 1});
        else if (batch.rough)
            d.add({"ROUGH", 1});
        if (lookedUp && (batch.rough ? gloss : radiance)->fourATexel()) d.add({"FOUR_A_TEXEL", 1});
        if (batch.glass) d.add({"GLASS", 1});
        if (batch.pane) d.add({"PANE", 1});
        if (batch.pane && !traced) d.add({"BEHIND", "\"behind_pane.glsl\""});
        if (withObjects) objects.addDefines(d, reflects, traced, probed);
        if (withObjects && batch.rough && objects.changesLookedUp()) d.add({"CHANGED", 1});
        return d;
    }

    void makeReady(DisplayMode mode) {
        if (!showsRadiance(mode)) {
            if (!drawings) drawings.emplace(scene, lightField, shaders);
        } else if (mode == DisplayMode::raytraced) {
            if (!objects.hits().hasRoom()) loadHits();
        } else if (mode != DisplayMode::field) {
            throw InputError("mode progressive takes many calls: it is ProgressiveRenderer's");
        } else if (!canLookUp) {
            throw InputError(
                "the light field holds no radiance of mirrors or glass to look up: bake with "
                "radiance directions, or trace reflections (mode raytraced)");
        } else if (showsPanes && !objects.hits().hasRoom()) {
            loadHits();
        }
    }

    void loadHits() {
        const LightField layout = atlas.fit().layout();
        objects.hits().loadRoom(scene, layout.charts, layout.triangleCharts, mirrorTriangles);
        objects.hitsReloaded();
        memory.hits = objects.hits().bytes();
    }

    void updateObjects(const DynamicRoom& room) {
        if (roomVersion == room.irradianceVersion()) return;
        objects.update(room);
        atlas.update(room.irradiance());
        roomVersion = room.irradianceVersion();
        memory.hits = objects.hits().bytes();
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
        if (!objects.empty()) memory.objects = objects.bytes();
        if (drawings) memory.drawings = drawings->bytes();
    }

    void drawRoom(const View& view, const RenderSettings& settings, GLuint framebuffer) {
        objects.drawShadows([&] { drawTriangles(false); });
        if (settings.mode == DisplayMode::field) drawProbes();
        prepare(view, framebuffer);
        if (!objects.empty()) {
            objects.bind();
            objects.draw(view, settings);
        }
        glBindVertexArray(vertexArray.id());
        for (std::size_t i = 0; i < batches.size(); ++i)
            if (batches[i].mirror && !batches[i].glass && !objects.empty())
                drawMirror(i, view, settings);
            else
                drawBatch(i, definesOf(batches[i], settings, !objects.empty()));
        drawSky({});
    }

    /// Where nothing has been drawn.
    void drawSky(const Defines& defines) {
        if (sky.isBlack()) return;
        glUseProgram(shaders.program("sky", defines));
        glDisable(GL_CULL_FACE);
        glDepthFunc(GL_LEQUAL);
        glDepthMask(GL_FALSE);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glDepthMask(GL_TRUE);
    }

    /// With objects where it shows them, with changed light where it shows that, and elsewhere as
    /// if there were none. What has been drawn is not drawn again.
    void drawMirror(std::size_t i, const View& view, const RenderSettings& settings) {
        const PixelRectangle part = partOf(view);
        const ObjectStage::Regions regions = objects.regions(
            view, mirrorPlanes[i], part, settings.mode == DisplayMode::raytraced, planes == 1);
        const Defines plain = definesOf(batches[i], settings);
        glDepthFunc(GL_LEQUAL);
        if (regions.objects) drawWithin(*regions.objects, i, definesOf(batches[i], settings, true));
        glDepthFunc(GL_LESS);
        if (regions.change && regions.objects != part) {
            Defines changed = plain;
            changed.add({"CHANGED", 1});
            drawWithin(*regions.change, i, changed);
        }
        if (regions.objects != part && regions.change != part) drawWithin(part, i, plain);
        glDepthFunc(GL_LEQUAL);
        glScissor(part.x, part.y, part.width, part.height);
    }

    void drawWithin(const PixelRectangle& r, std::size_t i, const Defines& defines) {
        glScissor(r.x, r.y, r.width, r.height);
        drawBatch(i, defines);
    }

    void drawProbes() {
        if (objects.objects().probeCentres().empty()) return;
        RenderSettings settings;
        settings.tone.reset();
        const ViewData shown = viewData;
        objects.drawProbes(nearest,
                           [&](const Mat4& clipFromWorld, const Vec3& eye, GLuint framebuffer) {
                               View face;
                               face.width = face.height = ReflectionProbes::kSize;
                               face.clipFromWorld = clipFromWorld;
                               face.eye = eye;
                               setView(face, settings);
                               prepare(face, framebuffer);
                               objects.bind();
                               glBindVertexArray(vertexArray.id());
                               for (std::size_t i = 0; i < batches.size(); ++i)
                                   drawBatch(i, definesOf(batches[i], settings, true, true));
                               drawSky({{"PROBED", 1}});
                           });
        viewData = shown;
        glNamedBufferSubData(viewBuffer.id(), 0, sizeof viewData, &viewData);
    }

    /// Those of the room, with the program in use.
    void drawTriangles(bool lamps) const {
        glBindVertexArray(vertexArray.id());
        for (const RoomBatch& batch : batches)
            if (lamps || !(batch.glass || scene.materials[batch.material].isEmitter()))
                glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(batch.indexCount),
                               GL_UNSIGNED_INT,
                               reinterpret_cast<const void*>(4 * std::size_t{batch.firstIndex}));
    }

    void setView(const View& view, const RenderSettings& settings) {
        viewData.clipFromWorld = view.clipFromWorld;
        viewData.eye = Vec4(view.eye, rayStart);
        viewData.tone = toneData(settings);
        viewData.trace.x = static_cast<int>(objects.hits().roomNodes());
        if (!sky.isBlack()) sky.describe(view.clipFromWorld, viewData);
        glNamedBufferSubData(viewBuffer.id(), 0, sizeof viewData, &viewData);
    }

    void drawWireframe(const View& view, const RenderSettings& settings, GLuint framebuffer) {
        prepare(view, framebuffer);
        const auto drawDepth = [&] {
            drawTriangles(true);
            if (objects.empty()) return;
            glUseProgram(shaders.program("depth", {{"OBJECT", 1}}));
            objects.objects().drawTriangles();
        };
        const auto drawLines = [&](LinePass& lines) {
            if (!objects.empty()) objects.objects().drawLines(lines, settings.normals);
        };
        // By reference: a function that holds what these refer to would allocate.
        drawings->wireframe(view, settings.normals, std::ref(drawDepth), std::ref(drawLines),
                            framebuffer);
    }

    void drawDiagram(const View& view, const RenderSettings& settings, GLuint framebuffer) {
        const DiagramKind kind = settings.diagram.kind;
        if (kind == DiagramKind::subfield || kind == DiagramKind::tile) {
            prepare(view, framebuffer);
            drawings->subfield(view, settings.diagram, settings.diagramCamera, framebuffer);
            return;
        }
        if (kind == DiagramKind::chart && !atlas.fit().unchanged())
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
        const PixelRectangle part = partOf(view);
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
        sky.bind();
        objects.hits().bind();
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
        if (batch.mirror || batch.rough) (batch.rough ? gloss : radiance)->bind();
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(batch.indexCount), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(4 * std::size_t{batch.firstIndex}));
    }

    const Scene& scene;
    const LightField& lightField;
    ShaderLibrary shaders;
    SceneTextures textures;
    SkyPicture sky;
    std::vector<RoomBatch> batches;
    Buffer vertices, indices, viewBuffer;
    std::vector<Buffer> materialBuffers;     ///< of each batch
    std::vector<MirrorPlanes> mirrorPlanes;  ///< likewise
    std::size_t planes = 0;                  ///< in all
    VertexArray vertexArray;
    IrradianceTexture atlas;
    bool canLookUp, showsPanes;
    std::optional<RadianceBuffers> radiance, gloss;  ///< of perfect and rough mirrors
    std::vector<std::uint32_t> mirrorTriangles;
    ObjectStage objects;
    std::optional<std::uint64_t> roomVersion;  ///< of the DynamicRoom that is shown
    std::optional<Drawings> drawings;          ///< once one is drawn
    ViewData viewData{};
    GpuMemory memory;
    std::vector<std::string> notices;
    float nearest = 0, rayStart = 0;  ///< metres
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
    impl_->atlas.load(atlas);
    impl_->objects.outdate();
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
    impl_->objects.outdate();
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
