#pragma once
// Modes wireframe and diagram of the renderer. What they draw is made when first shown.

#include "vlf/field/direction_set.h"
#include "vlf/field/light_field.h"
#include "vlf/render/drawing/diagram_params.h"
#include "vlf/render/gl/chart_figure.h"
#include "vlf/render/gl/direction_figure.h"
#include "vlf/render/gl/glass_room.h"
#include "vlf/render/gl/line_pass.h"
#include "vlf/render/gl/wireframe_drawing.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace vlf::gl {

/// Refers to scene, field and shaders, which must outlive it. Draws within StateGuard, with the
/// view in shared::kViewBlock.
class Drawings {
  public:
    Drawings(const Scene& scene, const LightField& field, ShaderLibrary& shaders)
        : scene_(scene), field_(field), shaders_(shaders), lines_(shaders) {}

    /// As WireframeDrawing::draw.
    void wireframe(const View& view, bool normals, const std::function<void()>& drawTriangles,
                   const std::function<void(LinePass&)>& drawLines, GLuint framebuffer);

    /// Over the dimmed room, which has just been drawn.
    void directions(const std::optional<Sphere>& ball);
    void chart(const DiagramParams& params, const Camera& camera, GLuint irradianceAtlas);

    /// Kind `subfield` or `tile`.
    void subfield(const View& view, const DiagramParams& params, const Camera& camera,
                  GLuint framebuffer);

    Camera overview(const DiagramParams& params, const Camera& camera, int width, int height);

    std::uint64_t bytes() const;

  private:
    /// A subfield as it was last drawn.
    struct Subfield {
        SubfieldSelection selection;
        DiagramKind kind;
        LineBuffer lines;
        std::optional<GlassRoom> glass;  ///< of kind `tile`
    };

    const RayScene& rays();
    const DirectionSet& directionSet();
    Subfield& subfieldOf(const DiagramParams& params, const Camera& camera);

    const Scene& scene_;
    const LightField& field_;
    ShaderLibrary& shaders_;
    LinePass lines_;
    std::optional<RayScene> rays_;
    std::optional<DirectionSet> directionSet_;
    std::optional<WireframeDrawing> wireframe_;
    std::optional<DirectionFigure> directions_;
    std::optional<ChartFigure> chart_;
    std::optional<LineBuffer> edges_;
    std::optional<Subfield> subfield_;
};

}  // namespace vlf::gl
