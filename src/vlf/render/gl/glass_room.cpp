#include "vlf/render/gl/glass_room.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

namespace vlf::gl {

namespace {

using namespace shared;

using ByteColor = std::array<std::uint8_t, 4>;

struct PaneVertex {
    Vec3 position;
    ByteColor front, back;
};

/// Triangles are painted in the order of their centres: large ones are cut until their sides are
/// shorter than this part of the field's radius, so that the order is that of their points.
constexpr float kLongestSide = 0.2f;

class PaneMaker {
  public:
    PaneMaker(const Scene& scene, const LightField& field,
              const std::map<std::uint32_t, Vec3>& colors)
        : colors_(colors), longest_(kLongestSide * field.frame.radius) {
        for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
            const TriangleCharts& c = field.triangleCharts[t];
            front_ = firstColor({c.front, c.front, c.back});
            back_ = firstColor({c.back, c.front, c.back});
            add({scene.position(t, 0), scene.position(t, 1), scene.position(t, 2)});
        }
    }

    std::vector<PaneVertex> vertices;
    std::vector<Vec3> centres;

  private:
    /// Of the first of a triangle's charts that has one; transparent if none has.
    ByteColor firstColor(const std::array<std::uint32_t, 3>& charts) const {
        for (const std::uint32_t chart : charts)
            if (const auto color = colors_.find(chart); color != colors_.end()) {
                const Vec3 c = glm::round(255.0f * color->second);
                return {static_cast<std::uint8_t>(c.x), static_cast<std::uint8_t>(c.y),
                        static_cast<std::uint8_t>(c.z), 255};
            }
        return {};
    }

    void add(const std::array<Vec3, 3>& p) {
        int side = 0;  // the longest, from corner to next corner
        const auto length = [&](int i) { return glm::distance(p[i], p[(i + 1) % 3]); };
        for (int i = 1; i < 3; ++i)
            if (length(i) > length(side)) side = i;
        if (length(side) > longest_) {
            const Vec3 &a = p[side], &b = p[(side + 1) % 3], &c = p[(side + 2) % 3];
            const Vec3 middle = 0.5f * (a + b);
            add({a, middle, c});
            add({middle, b, c});
            return;
        }
        for (const Vec3& corner : p) vertices.push_back({corner, front_, back_});
        centres.push_back((p[0] + p[1] + p[2]) / 3.0f);
    }

    const std::map<std::uint32_t, Vec3>& colors_;
    float longest_;
    ByteColor front_{}, back_{};
};

GlassData glassData(const SubfieldSelection& selection) {
    const ParallelSubfield& s = selection.subfield;
    return {Vec4(s.xAxis, s.xOffset), Vec4(s.yAxis, s.yOffset),
            Vec4(selection.tileLower(), selection.tileUpper()),
            Vec4(subfield::kSeenInBeam, subfield::kSeenOfChart, subfield::kSeenElse, 0),
            Vec4(kInk, 0)};
}

}  // namespace

GlassRoom::GlassRoom(const Scene& scene, const LightField& field,
                     const SubfieldSelection& selection,
                     const std::map<std::uint32_t, Vec3>& colors) {
    PaneMaker panes(scene, field, colors);
    panes_ = makeFigureBuffer(panes.vertices.data(), panes.vertices.size(), sizeof(PaneVertex),
                              {{4, GL_UNSIGNED_BYTE, offsetof(PaneVertex, front)},
                               {4, GL_UNSIGNED_BYTE, offsetof(PaneVertex, back)}});
    order_ = makeBuffer(nullptr, 4 * panes.vertices.size(), GL_DYNAMIC_STORAGE_BIT);
    glVertexArrayElementBuffer(panes_.array.id(), order_.id());
    const GlassData data = glassData(selection);
    data_ = makeBuffer(&data, sizeof data);
    centres_ = std::move(panes.centres);
}

void GlassRoom::sortFrom(const Vec3& eye) {
    if (sorted_ && eye == sortedFrom_) return;
    std::vector<float> distance;
    for (const Vec3& centre : centres_) distance.push_back(glm::distance(centre, eye));
    std::vector<std::uint32_t> panes(centres_.size());
    std::iota(panes.begin(), panes.end(), 0u);
    std::sort(panes.begin(), panes.end(),
              [&](std::uint32_t a, std::uint32_t b) { return distance[a] > distance[b]; });
    std::vector<std::uint32_t> indices;
    for (const std::uint32_t pane : panes)
        for (std::uint32_t corner = 0; corner < 3; ++corner) indices.push_back(3 * pane + corner);
    glNamedBufferSubData(order_.id(), 0, static_cast<GLsizeiptr>(4 * indices.size()),
                         indices.data());
    sortedFrom_ = eye;
    sorted_ = true;
}

const TextureObject& GlassRoom::draw(GLuint program, const View& view) {
    sortFrom(view.eye);
    constexpr DrawingTarget::Attachment kColour{GL_COLOR_ATTACHMENT0, GL_RGBA16F};
    target_.require(view.width, view.height, {&kColour, 1});
    target_.begin(view, Vec4(kPaper, 1));
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glFrontFace(GL_CCW);
    glUseProgram(program);
    glBindBufferBase(GL_UNIFORM_BUFFER, kFigureBlock, data_.id());
    glBindVertexArray(panes_.array.id());
    glDrawElements(GL_TRIANGLES, panes_.count, GL_UNSIGNED_INT, nullptr);
    return target_.textures[0];
}

std::uint64_t GlassRoom::bytes() const {
    return panes_.bytes + 4 * static_cast<std::uint64_t>(panes_.count) + target_.bytes();
}

}  // namespace vlf::gl
