#include "golden/golden_pictures.h"

#include "vlf/image/tone_map.h"
#include "vlf/render/gl/headless_context.h"
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

GoldenPicture byOpenGl(GoldenPicture picture) {
    picture.byOpenGl = true;
    picture.limits = kDrawnByGpu;
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

Image renderByOpenGl(const BakedExample& baked, const StillParams& params, Progress& progress) {
    const gl::HeadlessContext context;
    Renderer renderer(baked.scene, baked.field);
    return renderStill(renderer, params, progress);
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
    Progress progress;
    const Image image = picture.byOpenGl
                            ? renderByOpenGl(baked, params, progress)
                            : renderStill(baked.scene, baked.rays, baked.field, params, progress);
    return showsRadiance(picture.mode) ? toneMap(image, picture.exposure, ToneCurve::filmic)
                                       : image;
}

}  // namespace vlf::test
