#include "vlf/render/gl/drawings.h"

#include "vlf/render/cpu/diagram.h"
#include "vlf/render/gl/shaders/shared.h"

namespace vlf::gl {

namespace {

/// Of the ball of directions where none is given, of the field's radius.
constexpr float kBallSize = 0.2f;

bool same(const SubfieldSelection& a, const SubfieldSelection& b) {
    return a.direction == b.direction && a.tileX == b.tileX && a.tileY == b.tileY;
}

}  // namespace

static_assert(shared::kRoomEdgePen == subfield::roomEdges);

const RayScene& Drawings::rays() {
    if (!rays_) rays_.emplace(scene_);
    return *rays_;
}

const DirectionSet& Drawings::directionSet() {
    if (!directionSet_) directionSet_.emplace(field_.record.directions);
    return *directionSet_;
}

void Drawings::wireframe(const View& view, bool normals, const std::function<void()>& drawTriangles,
                         const std::function<void(LinePass&)>& drawLines, GLuint framebuffer) {
    if (!wireframe_) wireframe_.emplace(scene_);
    wireframe_->draw(lines_, view, normals, drawTriangles, drawLines, framebuffer);
}

void Drawings::directions(const std::optional<Sphere>& ball) {
    if (!directions_) directions_.emplace(directionSet());
    directions_->draw(shaders_.program("ball", {}),
                      ball.value_or(Sphere{field_.frame.centre, kBallSize * field_.frame.radius}));
}

void Drawings::chart(const DiagramParams& params, const Camera& camera, GLuint irradianceAtlas) {
    const std::uint32_t chosen = chooseChart(scene_, rays(), field_, params, camera);
    if (!chart_ || chart_->chart() != chosen) chart_.emplace(scene_, field_, chosen);
    chart_->draw(shaders_.program("texels", {}), irradianceAtlas);
}

Drawings::Subfield& Drawings::subfieldOf(const DiagramParams& params, const Camera& camera) {
    const SubfieldSelection wanted = selectSubfield(field_, directionSet(), params, camera);
    if (subfield_ && subfield_->kind == params.kind && same(subfield_->selection, wanted))
        return *subfield_;
    subfield_.reset();
    Subfield made{wanted,
                  params.kind,
                  makeLineBuffer(subfieldLines(rays(), field_.frame, wanted, params.kind)),
                  {}};
    if (params.kind == DiagramKind::tile)
        made.glass.emplace(scene_, field_, wanted, tileChartColors(rays(), field_, wanted));
    return subfield_.emplace(std::move(made));
}

void Drawings::subfield(const View& view, const DiagramParams& params, const Camera& camera,
                        GLuint framebuffer) {
    Subfield& drawn = subfieldOf(params, camera);
    if (!edges_) edges_ = makeEdgeBuffer(meshEdges(scene_));
    const TextureObject* picture =
        drawn.glass ? &drawn.glass->draw(shaders_.program("glass", {}), view) : nullptr;
    const Sphere sphere{field_.frame.centre, field_.frame.radius};
    lines_.begin(view, {subfield::kPens, subfield::kColors, DepthCue(sphere, view.eye)});
    lines_.beginInk();
    lines_.draw(*edges_, {{"EDGES", 1}});
    lines_.draw(drawn.lines, {});
    lines_.finish(framebuffer, picture);
}

Camera Drawings::overview(const DiagramParams& params, const Camera& camera, int width,
                          int height) {
    const SubfieldSelection wanted = selectSubfield(field_, directionSet(), params, camera);
    return subfieldOverview(camera, field_.frame, wanted.subfield.direction, width, height);
}

std::uint64_t Drawings::bytes() const {
    std::uint64_t sum = lines_.bytes();
    if (wireframe_) sum += wireframe_->bytes();
    if (directions_) sum += directions_->bytes();
    if (chart_) sum += chart_->bytes();
    if (edges_) sum += edges_->bytes;
    if (subfield_) sum += subfield_->lines.bytes;
    if (subfield_ && subfield_->glass) sum += subfield_->glass->bytes();
    return sum;
}

}  // namespace vlf::gl
