#pragma once
// Antialiased lines by OpenGL: as LineLayer of render/cpu, on sheets of ink that keep the
// strongest.

#include "vlf/render/drawing/mesh_edges.h"
#include "vlf/render/drawing/pen.h"
#include "vlf/render/drawing/wireframe_lines.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/shader_library.h"
#include "vlf/render/gl/shaders/drawing_data.h"
#include "vlf/render/gl/view.h"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace vlf::gl {

/// Lines in the memory of the GPU.
struct LineBuffer {
    Buffer buffer;
    TextureObject texture;
    int count = 0;
    std::uint64_t bytes = 0;
};
LineBuffer makeLineBuffer(const std::vector<PenLine>& lines);
LineBuffer makeEdgeBuffer(const std::vector<MeshEdge>& edges);

/// Textures of at least the size of a view, to draw into.
struct DrawingTarget {
    struct Attachment {
        GLenum point, format;
        bool operator==(const Attachment&) const = default;
    };

    Framebuffer framebuffer;
    std::vector<TextureObject> textures;
    int width = 0, height = 0;

    /// Makes it anew with these attachments if it is too small or has others.
    void require(int width, int height, std::span<const Attachment> attachments);
    /// Binds it with the view's size as viewport, cleared to a colour.
    void begin(const View& view, const Vec4& clear) const;
    std::uint64_t bytes() const;

  private:
    std::vector<Attachment> attachments_;
};

/// What a drawing draws with.
struct LineStyle {
    std::span<const Pen> pens;
    std::span<const Vec3> sheets;  ///< colours
    DepthCue cue;                  ///< of lines that the room hides
};

/// Draws within StateGuard: framebuffer, viewport, blending and bindings are left as they come. A
/// drawing is begin; beginDepth and the room's triangles, if it hides lines; beginInk; any number
/// of draw; finish.
class LinePass {
  public:
    explicit LinePass(ShaderLibrary& shaders) : shaders_(shaders) {}

    void begin(const View& view, const LineStyle& style);
    /// The triangles drawn next, positions at shared::kPositionAttribute, hide lines.
    void beginDepth();
    void beginInk();  ///< on blank sheets
    /// How `lines` are drawn: plainly, or, by the names of shaders/line.vert, as EDGES, HIDING or
    /// NORMALS; as OBJECT, `place` leads from their space to the world's.
    void draw(const LineBuffer& lines, const Defines& kind, const Mat4& place = Mat4(1));
    /// Lays the sheets on paper, or on a picture in display-linear colours, in the view's rectangle
    /// of `framebuffer`.
    void finish(GLuint framebuffer, const TextureObject* picture = nullptr);

    std::uint64_t bytes() const { return ink_.bytes() + depth_.bytes(); }

  private:
    ShaderLibrary& shaders_;
    Buffer data_ = makeBuffer(nullptr, sizeof(shared::DrawingData), GL_DYNAMIC_STORAGE_BIT);
    VertexArray noAttributes_ = makeVertexArray();
    DrawingTarget ink_, depth_;
    View view_;
    int sheets_ = 0;
};

}  // namespace vlf::gl
