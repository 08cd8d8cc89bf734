#pragma once
// OpenGL in tests: a context, targets, and pictures held against the CPU's.

#include "support/baked_example.h"
#include "vlf/image/flip.h"
#include "vlf/image/tone_map.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/headless_context.h"
#include "vlf/render/gl/still.h"

#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace vlf::test {

inline void noteMessage(GLenum, GLenum, GLuint, GLenum severity, GLsizei, const GLchar* text,
                        const void* messages) {
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    static_cast<std::vector<std::string>*>(const_cast<void*>(messages))->push_back(text);
}

/// A context that must not have had anything to complain of by the end of the test.
class OpenGl : public ::testing::Test {
  protected:
    void SetUp() override {
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(noteMessage, &messages_);
    }
    void TearDown() override {
        EXPECT_EQ(gl::liveObjects(), 0);
        EXPECT_EQ(messages_, std::vector<std::string>());
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }

    gl::HeadlessContext context_{true};
    std::vector<std::string> messages_;
};

/// A picture for the display.
struct Target {
    gl::Framebuffer framebuffer = gl::makeFramebuffer();
    gl::TextureObject color = gl::makeTexture(GL_TEXTURE_2D);
    gl::TextureObject depth = gl::makeTexture(GL_TEXTURE_2D);

    Target(int width, int height) {
        glTextureStorage2D(color.id(), 1, GL_RGBA8, width, height);
        glTextureStorage2D(depth.id(), 1, GL_DEPTH_COMPONENT24, width, height);
        glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, color.id(), 0);
        glNamedFramebufferTexture(framebuffer.id(), GL_DEPTH_ATTACHMENT, depth.id(), 0);
    }
};

/// Sets much of the state to what no renderer wants.
inline void disturbState(const Target& target) {
    glViewport(3, 4, 50, 40);
    glScissor(5, 6, 7, 8);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glBlendEquation(GL_FUNC_SUBTRACT);
    glPolygonOffset(3, 2);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    glCullFace(GL_FRONT);
    glFrontFace(GL_CW);
    glClearColor(0.25f, 0.5f, 0.75f, 1);
    glActiveTexture(GL_TEXTURE2);
    glBindTexture(GL_TEXTURE_2D, target.color.id());
}

inline std::vector<GLint> state() {
    std::vector<GLint> values;
    for (const GLenum name : {GL_VIEWPORT,
                              GL_SCISSOR_BOX,
                              GL_BLEND,
                              GL_DEPTH_TEST,
                              GL_SCISSOR_TEST,
                              GL_CULL_FACE,
                              GL_DEPTH_FUNC,
                              GL_DEPTH_WRITEMASK,
                              GL_CULL_FACE_MODE,
                              GL_FRONT_FACE,
                              GL_ACTIVE_TEXTURE,
                              GL_TEXTURE_BINDING_2D,
                              GL_CURRENT_PROGRAM,
                              GL_VERTEX_ARRAY_BINDING,
                              GL_DRAW_FRAMEBUFFER_BINDING,
                              GL_READ_FRAMEBUFFER_BINDING,
                              GL_UNIFORM_BUFFER_BINDING,
                              GL_COLOR_CLEAR_VALUE,
                              GL_BLEND_SRC_RGB,
                              GL_BLEND_DST_ALPHA,
                              GL_POLYGON_OFFSET_FACTOR,
                              GL_POLYGON_OFFSET_UNITS,
                              GL_BLEND_EQUATION_RGB,
                              GL_BLEND_EQUATION_ALPHA}) {
        GLint value[4] = {0, 0, 0, 0};
        glGetIntegerv(name, value);
        values.insert(values.end(), value, value + 4);
    }
    GLint active = 0;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLenum unit = GL_TEXTURE0; unit < GL_TEXTURE0 + 16; ++unit) {
        glActiveTexture(unit);
        for (const GLenum name : {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_BUFFER})
            glGetIntegerv(name, &values.emplace_back());
    }
    glActiveTexture(static_cast<GLenum>(active));
    return values;
}

inline StillParams stillOf(const Camera& camera, LookupKind lookup = LookupKind::depthCorrected) {
    StillParams params;
    params.camera = camera;
    params.width = 160;
    params.height = 120;
    params.mode = DisplayMode::field;
    params.lookup = lookup;
    return params;
}

inline double meanFlip(const Image& picture, const Image& reference) {
    const float exposure = autoExposure(reference);
    const auto error = flip(toneMap(picture, exposure, ToneCurve::filmic),
                            toneMap(reference, exposure, ToneCurve::filmic))
                           .error;
    return std::accumulate(error.begin(), error.end(), 0.0) / static_cast<double>(error.size());
}

inline double flipAgainstCpu(const BakedExample& room, const StillParams& params) {
    Progress progress;
    Renderer renderer(room.scene, room.field);
    return meanFlip(renderStill(renderer, params, progress),
                    renderStill(room.scene, room.rays, room.field, params, progress));
}

}  // namespace vlf::test
