#include "vlf/render/gl/reflection_probes.h"

#include "vlf/render/gl/shaders/shared.h"

#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace vlf::gl {

namespace {

struct Face {
    Vec3 forward, up;
};

/// In the order and orientation of OpenGL's cube maps.
constexpr std::array<Face, 6> kFaces{{{{1, 0, 0}, {0, -1, 0}},
                                      {{-1, 0, 0}, {0, -1, 0}},
                                      {{0, 1, 0}, {0, 0, 1}},
                                      {{0, -1, 0}, {0, 0, -1}},
                                      {{0, 0, 1}, {0, -1, 0}},
                                      {{0, 0, -1}, {0, -1, 0}}}};

}  // namespace

void ReflectionProbes::draw(const std::vector<Vec3>& centres, float nearest,
                            const DrawFace& drawFace) {
    require(centres.size());
    const Mat4 projection = glm::infinitePerspective(0.5f * kPi, 1.0f, nearest);
    for (std::size_t layer = 0; layer < centres.size(); ++layer)
        for (std::size_t face = 0; face < kFaces.size(); ++face) {
            glNamedFramebufferTextureLayer(framebuffer_.id(), GL_COLOR_ATTACHMENT0, cubes_.id(), 0,
                                           static_cast<GLint>(6 * layer + face));
            const Vec3& eye = centres[layer];
            drawFace(projection * glm::lookAt(eye, eye + kFaces[face].forward, kFaces[face].up),
                     eye, framebuffer_.id());
        }
}

void ReflectionProbes::require(std::size_t probes) {
    if (probes <= capacity_) return;
    capacity_ = probes;
    cubes_ = makeTexture(GL_TEXTURE_CUBE_MAP_ARRAY);
    glTextureStorage3D(cubes_.id(), 1, GL_RGBA16F, kSize, kSize,
                       static_cast<GLsizei>(6 * capacity_));
    glTextureParameteri(cubes_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    if (framebuffer_) return;
    depth_ = makeTexture(GL_TEXTURE_2D);
    glTextureStorage2D(depth_.id(), 1, GL_DEPTH_COMPONENT32F, kSize, kSize);
    framebuffer_ = makeFramebuffer();
    glNamedFramebufferTexture(framebuffer_.id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
}

void ReflectionProbes::bind() const {
    if (cubes_) glBindTextureUnit(shared::kProbeUnit, cubes_.id());
}

std::uint64_t ReflectionProbes::bytes() const {
    return capacity_ * 6 * kSize * kSize * 8 + (capacity_ > 0 ? 4 * kSize * kSize : 0);
}

}  // namespace vlf::gl
