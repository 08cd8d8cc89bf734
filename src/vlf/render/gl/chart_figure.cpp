#include "vlf/render/gl/chart_figure.h"

#include "vlf/image/heat_map.h"
#include "vlf/render/cpu/diagram.h"
#include "vlf/render/gl/shaders/drawing_data.h"
#include "vlf/render/gl/shaders/shared.h"

#include <array>
#include <cstddef>
#include <vector>

namespace vlf::gl {

namespace {

using namespace shared;

struct ChartVertex {
    Vec3 position;
    Vec2 texel;
};

/// Counter-clockwise seen from the side that the chart is of.
std::vector<ChartVertex> chartVertices(const Scene& scene, const LightField& field,
                                       std::uint32_t chart) {
    std::vector<ChartVertex> vertices;
    const auto add = [&](std::uint32_t triangle, const std::array<int, 3>& corners) {
        for (const int corner : corners) {
            const Vec3& p = scene.position(triangle, corner);
            vertices.push_back({p, field.charts[chart].texelCoordinates(p)});
        }
    };
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        if (field.triangleCharts[t].front == chart) add(t, {0, 1, 2});
        if (field.triangleCharts[t].back == chart) add(t, {2, 1, 0});
    }
    return vertices;
}

TextureObject makeHeatTexture() {
    constexpr int kColors = 256;
    std::array<Vec3, kColors> colors;
    for (int i = 0; i < kColors; ++i)
        colors[static_cast<std::size_t>(i)] = heatColor(static_cast<float>(i) / (kColors - 1));
    TextureObject texture = makeTexture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.id(), 1, GL_RGBA16F, kColors, 1);
    glTextureSubImage2D(texture.id(), 0, 0, 0, kColors, 1, GL_RGB, GL_FLOAT, colors.data());
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    return texture;
}

}  // namespace

ChartFigure::ChartFigure(const Scene& scene, const LightField& field, std::uint32_t chart)
    : chart_(chart), heat_(makeHeatTexture()) {
    const std::vector<ChartVertex> vertices = chartVertices(scene, field, chart);
    triangles_ = makeFigureBuffer(vertices.data(), vertices.size(), sizeof(ChartVertex),
                                  {{2, GL_FLOAT, offsetof(ChartVertex, texel)}});
    const Chart& c = field.charts[chart];
    const float brightest = brightestTexel(field.atlas, c);
    const TexelData data{
        Vec4(c.x, c.y, c.width, c.height),
        {kTexelRim, kTexelRimShade, kTexelRimLight, brightest > 0 ? brightest : 1}};
    data_ = makeBuffer(&data, sizeof data);
}

void ChartFigure::draw(GLuint program, GLuint irradianceAtlas) {
    glBindBufferBase(GL_UNIFORM_BUFFER, kFigureBlock, data_.id());
    glBindTextureUnit(kIrradianceUnit, irradianceAtlas);
    glBindTextureUnit(kHeatUnit, heat_.id());
    glEnable(GL_CULL_FACE);
    glUseProgram(program);
    glBindVertexArray(triangles_.array.id());
    glDrawArrays(GL_TRIANGLES, 0, triangles_.count);
}

}  // namespace vlf::gl
