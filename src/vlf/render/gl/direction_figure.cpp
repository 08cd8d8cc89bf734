#include "vlf/render/gl/direction_figure.h"

#include "vlf/render/drawing/direction_ball.h"
#include "vlf/render/gl/shaders/drawing_data.h"

#include <cstddef>
#include <vector>

namespace vlf::gl {

using namespace shared;

DirectionFigure::DirectionFigure(const DirectionSet& set) : lines_(set.lineCount()) {
    const std::vector<BallVertex> vertices = makeBall(set);
    triangles_ = makeFigureBuffer(vertices.data(), vertices.size(), sizeof(BallVertex),
                                  {{2, GL_FLOAT, offsetof(BallVertex, weight)},
                                   {3, GL_UNSIGNED_INT, offsetof(BallVertex, corner)}});
    const float mean = 4 * kPi / static_cast<float>(set.directionCount());
    meanDistance_ = std::sqrt(mean);
    std::vector<Vec4> texels;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(set.directionCount()); ++i) {
        texels.emplace_back(set.direction(i), 0);
        texels.emplace_back(weightColor(set.weight(i) / mean), 1);
    }
    directionBytes_ = texels.size() * sizeof(Vec4);
    directions_ = makeBuffer(texels.data(), directionBytes_);
    directionTexture_ = makeBufferTexture(directions_, GL_RGBA32F);
    data_ = makeBuffer(nullptr, sizeof(BallData), GL_DYNAMIC_STORAGE_BIT);
}

void DirectionFigure::draw(GLuint program, const Sphere& sphere) {
    const BallData data{
        Vec4(sphere.centre, sphere.radius),
        {ball::kDotRadius * meanDistance_, ball::kRimWeight, ball::kRimShade, lines_},
        {ball::kOutlineShade, ball::kFacingShade, 0, 0},
        {Vec4(ball::kUpperDot, 1), Vec4(ball::kLowerDot, 1)}};
    glNamedBufferSubData(data_.id(), 0, sizeof data, &data);
    glBindBufferBase(GL_UNIFORM_BUFFER, kFigureBlock, data_.id());
    glBindTextureUnit(kDirectionUnit, directionTexture_.id());
    glEnable(GL_CULL_FACE);
    glUseProgram(program);
    glBindVertexArray(triangles_.array.id());
    glDrawArrays(GL_TRIANGLES, 0, triangles_.count);
}

}  // namespace vlf::gl
