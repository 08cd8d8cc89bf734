#include "vlf/render/gl/wireframe_drawing.h"

namespace vlf::gl {

WireframeDrawing::WireframeDrawing(const Scene& scene)
    : scene_(scene), sphere_(boundingSphere(scene)), edges_(makeEdgeBuffer(meshEdges(scene))) {}

void WireframeDrawing::draw(LinePass& pass, const View& view, bool normals,
                            const std::function<void()>& drawTriangles,
                            const std::function<void(LinePass&)>& drawLines, GLuint framebuffer) {
    if (normals && !normals_) normals_ = makeLineBuffer(normalLines(scene_));
    pass.begin(view, {wireframe::kPens, wireframe::kColors, DepthCue(sphere_, view.eye)});
    pass.beginDepth();
    drawTriangles();
    pass.beginInk();
    pass.draw(edges_, {{"EDGES", 1}, {"HIDING", 1}});
    if (normals) pass.draw(*normals_, {{"HIDING", 1}, {"NORMALS", 1}});
    drawLines(pass);
    pass.finish(framebuffer);
}

}  // namespace vlf::gl
