#include "vlf/render/gl/line_pass.h"

#include "vlf/base/error.h"
#include "vlf/render/gl/shaders/shared.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <string>
#include <utility>

namespace vlf::gl {

namespace {

using namespace shared;

LineBuffer makeTexelBuffer(const std::vector<Vec4>& texels, int texelsPerLine) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (texels.size() > static_cast<std::size_t>(most))
        throw InputError("the drawing has more lines (" +
                         std::to_string(texels.size() / static_cast<std::size_t>(texelsPerLine)) +
                         ") than this GPU holds; render it with --backend cpu");
    LineBuffer lines;
    lines.bytes = texels.size() * sizeof(Vec4);
    lines.count = static_cast<int>(texels.size()) / texelsPerLine;
    lines.buffer = makeBuffer(texels.data(), lines.bytes);
    lines.texture = makeBufferTexture(lines.buffer, GL_RGBA32F);
    return lines;
}

/// The view's matrix without its offset.
Mat4 unmoved(const View& view) {
    Mat4 m = view.clipFromWorld;
    for (int column = 0; column < 4; ++column) {
        m[column].x += 2 * view.offset.x / static_cast<float>(view.width) * m[column].w;
        m[column].y -= 2 * view.offset.y / static_cast<float>(view.height) * m[column].w;
    }
    return m;
}

}  // namespace

static_assert(kHiddenPen == wireframe::hidden && kTriangleEdgePen == wireframe::triangleEdges &&
              kCreasePen == wireframe::creases);

LineBuffer makeLineBuffer(const std::vector<PenLine>& lines) {
    std::vector<Vec4> texels;
    texels.reserve(kLineTexels * lines.size());
    for (const PenLine& line : lines) {
        texels.emplace_back(line.from, line.pen);
        texels.emplace_back(line.to, 0);
    }
    return makeTexelBuffer(texels, kLineTexels);
}

LineBuffer makeEdgeBuffer(const std::vector<MeshEdge>& edges) {
    std::vector<Vec4> texels;
    texels.reserve(kEdgeTexels * edges.size());
    for (const MeshEdge& edge : edges) {
        texels.emplace_back(edge.from, edge.crease ? 1 : 0);
        texels.emplace_back(edge.to, 0);
        texels.emplace_back(edge.normal, 0);
        texels.emplace_back(edge.otherNormal, 0);
    }
    return makeTexelBuffer(texels, kEdgeTexels);
}

void DrawingTarget::require(int w, int h, std::span<const Attachment> attachments) {
    if (w <= width && h <= height &&
        std::equal(attachments.begin(), attachments.end(), attachments_.begin(),
                   attachments_.end()))
        return;
    width = std::max(w, width);
    height = std::max(h, height);
    attachments_.assign(attachments.begin(), attachments.end());
    framebuffer = makeFramebuffer();
    textures.clear();
    std::vector<GLenum> drawn;
    for (const auto& [point, format] : attachments) {
        textures.push_back(makeTexture(GL_TEXTURE_2D));
        const GLuint id = textures.back().id();
        glTextureStorage2D(id, 1, format, width, height);
        glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glNamedFramebufferTexture(framebuffer.id(), point, id, 0);
        if (point != GL_DEPTH_ATTACHMENT) drawn.push_back(point);
    }
    glNamedFramebufferDrawBuffers(framebuffer.id(), static_cast<GLsizei>(drawn.size()),
                                  drawn.data());
}

void DrawingTarget::begin(const View& view, const Vec4& clear) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glViewport(0, 0, view.width, view.height);
    glScissor(0, 0, view.width, view.height);
    glEnable(GL_SCISSOR_TEST);
    for (const GLenum off : {GL_BLEND, GL_STENCIL_TEST, GL_FRAMEBUFFER_SRGB, GL_CULL_FACE,
                             GL_POLYGON_OFFSET_FILL, GL_DEPTH_TEST})
        glDisable(off);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(clear.x, clear.y, clear.z, clear.w);
    glClearDepthf(1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

std::uint64_t DrawingTarget::bytes() const {
    std::uint64_t perPixel = 0;
    for (const auto& [point, format] : attachments_) perPixel += format == GL_RGBA16F ? 8 : 4;
    return perPixel * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

void LinePass::begin(const View& view, const LineStyle& style) {
    assert(style.pens.size() <= kMostPens && style.sheets.size() <= kMostSheets);
    view_ = view;
    sheets_ = static_cast<int>(style.sheets.size());
    DrawingData data{};
    data.clipFromWorld = unmoved(view);
    const Mat4& m = view.clipFromWorld;
    data.eye = Vec4(view.eye, 1 / glm::length(Vec3(m[0].w, m[1].w, m[2].w)));
    data.viewport = Vec4(view.width, view.height, view.x, view.y);
    data.stroke = {wireframe::kStrokeLength, wireframe::kFullStrength, wireframe::kSurfaceSlack, 0};
    data.cue = {style.cue.near, style.cue.far, wireframe::kFarStrength, 0};
    data.paper = Vec4(kPaper, 1);
    for (std::size_t i = 0; i < style.pens.size(); ++i)
        data.pens[i] = {style.pens[i].thickness, style.pens[i].strength, style.pens[i].sheet, 0};
    for (std::size_t i = 0; i < style.sheets.size(); ++i) data.sheets[i] = Vec4(style.sheets[i], 1);
    glNamedBufferSubData(data_.id(), 0, sizeof data, &data);
    glBindBufferBase(GL_UNIFORM_BUFFER, kDrawingBlock, data_.id());
}

void LinePass::beginDepth() {
    constexpr DrawingTarget::Attachment kDepth{GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F};
    depth_.require(view_.width, view_.height, {&kDepth, 1});
    depth_.begin(view_, Vec4(0));
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    // The depth at a pixel's centre stands for that at any of its points: as deep as the surface
    // gets within it.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1);
    glUseProgram(shaders_.program("depth", {}));
}

void LinePass::beginInk() {
    constexpr std::array<DrawingTarget::Attachment, 2> kInk{
        {{GL_COLOR_ATTACHMENT0, GL_RGBA8}, {GL_COLOR_ATTACHMENT1, GL_RGBA8}}};
    ink_.require(view_.width, view_.height, std::span(kInk).first(sheets_ > 4 ? 2 : 1));
    ink_.begin(view_, Vec4(0));
    glEnable(GL_BLEND);
    glBlendEquation(GL_MAX);
    glBindVertexArray(noAttributes_.id());
}

void LinePass::draw(const LineBuffer& lines, const Defines& kind, const Mat4& place) {
    glUseProgram(shaders_.program("line", kind));
    if (kind.find("OBJECT")) glUniformMatrix4fv(kPlaceLocation, 1, GL_FALSE, &place[0][0]);
    for (const int unit : {kLineUnit, kRoomDepthUnit}) glBindSampler(static_cast<GLuint>(unit), 0);
    glBindTextureUnit(kLineUnit, lines.texture.id());
    if (!depth_.textures.empty()) glBindTextureUnit(kRoomDepthUnit, depth_.textures[0].id());
    glDrawArrays(GL_TRIANGLES, 0, 6 * lines.count);
}

void LinePass::finish(GLuint framebuffer, const TextureObject* picture) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(view_.x, view_.y, view_.width, view_.height);
    const PixelRectangle part =
        view_.part.value_or(PixelRectangle{view_.x, view_.y, view_.width, view_.height});
    glScissor(part.x, part.y, part.width, part.height);
    glDisable(GL_BLEND);
    Defines kind{{"SHEETS", sheets_}};
    if (picture) kind.add({"PICTURE", 1});
    glUseProgram(shaders_.program("sheets", kind));
    for (std::size_t i = 0; i < ink_.textures.size(); ++i)
        glBindTextureUnit(static_cast<GLuint>(kInkUnit + i), ink_.textures[i].id());
    if (picture) glBindTextureUnit(kPaperUnit, picture->id());
    for (int unit = 0; unit <= kPaperUnit; ++unit) glBindSampler(static_cast<GLuint>(unit), 0);
    glBindVertexArray(noAttributes_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace vlf::gl
