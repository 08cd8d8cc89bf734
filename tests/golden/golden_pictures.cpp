#include "golden/golden_pictures.h"

#include "vlf/image/tone_map.h"
#include "vlf/render/gl/float_target.h"
#include "vlf/render/gl/headless_context.h"
#include "vlf/render/gl/progressive.h"
#include "vlf/render/gl/read_framebuffer.h"
#include "vlf/render/gl/still.h"

namespace vlf::test {

namespace {

constexpr int kWidth = 96, kHeight = 72, kAntialias = 3;

GoldenPicture light(const std::string& scene, const std::string& camera, float exposure) {
    return {scene, camera, "raytraced", kBakedLight, exposure};
}

GoldenPicture lookedUp(const std::string& scene, const std::string& camera, LookupKind lookup,
                       float exposure) {
    const bool plain = lookup == LookupKind::plain;
    return {scene, camera, plain ? "plain" : "field", kBakedLight, exposure, DisplayMode::field,
            lookup};
}

GoldenPicture wireframe(const std::string& scene, const std::string& camera) {
    return {scene, camera, "wireframe", kDrawing, 0, DisplayMode::wireframe};
}

GoldenPicture diagram(const std::string& scene, const std::string& camera, DiagramKind kind,
                      const std::string& shows, const PictureLimits& limits = kDrawing) {
    GoldenPicture picture{scene, camera, shows, limits, 0, DisplayMode::diagram};
    picture.diagram = kind;
    return picture;
}

GoldenPicture progressive(const std::string& scene, const std::string& camera, float exposure) {
    return {scene, camera, "progressive", kBakedLight, exposure, DisplayMode::progressive};
}

GoldenPicture byOpenGl(GoldenPicture picture) {
    picture.openGl = true;
    if (!showsRadiance(picture.mode)) picture.limits = kDrawnByGpu;
    return picture;
}

}  // namespace

const std::vector<GoldenPicture>& goldenPictures() {
    static const std::vector<GoldenPicture> kPictures{
        light("cornell", "front", 1),
        light("two-rooms", "door", 1),
        light("two-rooms", "dark", 3),
        light("sealed", "overview", 0),
        light("caustic", "patch", 0),
        light("grotto", "pool", 0),
        lookedUp("grotto", "pool", LookupKind::depthCorrected, 0),
        light("office", "overview", 0),
        light("gallery", "statue", 0),
        light("mirror-room", "mirror", 0),
        lookedUp("mirror-room", "mirror", LookupKind::depthCorrected, 0),
        lookedUp("mirror-room", "mirror", LookupKind::plain, 0),
        light("gloss", "front", 0),
        lookedUp("gloss", "front", LookupKind::depthCorrected, 0),
        light("glass", "ball", 0),
        light("glass", "pane", 0),
        lookedUp("glass", "pane", LookupKind::depthCorrected, 0),
        byOpenGl(lookedUp("gloss", "front", LookupKind::depthCorrected, 0)),
        byOpenGl(light("glass", "pane", 0)),
        byOpenGl(light("office", "mirror", 0)),
        byOpenGl(light("caustic", "patch", 0)),
        byOpenGl(light("mirror-room", "mirror", 0)),
        byOpenGl(progressive("mirror-room", "mirror", 0)),
        wireframe("cornell", "corner"),
        wireframe("mirror-room", "statue"),
        diagram("mirror-room", "front", DiagramKind::directions, "directions"),
        diagram("mirror-room", "front", DiagramKind::subfield, "subfield"),
        diagram("mirror-room", "front", DiagramKind::tile, "tile"),
        diagram("mirror-room", "front", DiagramKind::chart, "chart", kBakedLight),
        diagram("cornell", "front", DiagramKind::chart, "chart", kBakedLight),
        byOpenGl(wireframe("cornell", "corner")),
        byOpenGl(wireframe("mirror-room", "statue")),
        byOpenGl(diagram("mirror-room", "front", DiagramKind::directions, "directions")),
        byOpenGl(diagram("mirror-room", "front", DiagramKind::subfield, "subfield")),
        byOpenGl(diagram("mirror-room", "front", DiagramKind::tile, "tile")),
        byOpenGl(diagram("mirror-room", "front", DiagramKind::chart, "chart")),
    };
    return kPictures;
}

namespace {

/// What mode progressive comes to, as the display shows it.
Image progressiveAtRest(Renderer& renderer, const GoldenPicture& picture, const Camera& camera) {
    const gl::FloatTarget target(kWidth, kHeight);
    ProgressiveRenderer progressive(renderer);
    const View view = viewOf(camera, kWidth, kHeight, renderer.nearest());
    RenderSettings settings;
    settings.exposure = picture.exposure;
    while (progressive.samples() < ProgressiveRenderer::kSamples)
        progressive.draw(view, settings, target.framebuffer.id());
    return readFramebuffer(target.framebuffer.id(), kWidth, kHeight);
}

Image shown(const Image& image, const GoldenPicture& picture) {
    return showsRadiance(picture.mode) ? toneMap(image, picture.exposure, ToneCurve::filmic)
                                       : image;
}

Image renderByOpenGl(const BakedExample& baked, const GoldenPicture& picture,
                     const StillParams& params) {
    const gl::HeadlessContext context;
    Renderer renderer(baked.scene, baked.field);
    if (picture.mode == DisplayMode::progressive)
        return progressiveAtRest(renderer, picture, params.camera);
    Progress progress;
    return shown(renderStill(renderer, params, progress), picture);
}

}  // namespace

Image renderGolden(const BakedExample& baked, const GoldenPicture& picture) {
    StillParams params;
    params.camera = baked.camera(picture.camera);
    params.width = kWidth;
    params.height = kHeight;
    params.antialias = kAntialias;
    params.mode = picture.mode;
    params.lookup = picture.lookup;
    params.diagram.kind = picture.diagram;
    if (picture.openGl) return renderByOpenGl(baked, picture, params);
    Progress progress;
    return shown(renderStill(baked.scene, baked.rays, baked.field, params, progress), picture);
}

}  // namespace vlf::test
