// shaders/trace.glsl finds what the CPU's ray tracing kernels find.

#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/headless_context.h"
#include "vlf/render/gl/shader_library.h"
#include "vlf/scene/generate/generate.h"
#include "vlf/trace/bvh.h"
#include "vlf/trace/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

#include <gtest/gtest.h>

namespace vlf::gl::test {

namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 128, kHeight = 64;

/// A pixel traces a ray of a buffer: triangle or -1, distance, and whether anything lies before
/// nine tenths and eleven tenths of it.
constexpr const char* kVertexShader = R"glsl(
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(4 * corner - 1, 0, 1);
}
)glsl";
constexpr const char* kFragmentShader = R"glsl(
#include "trace.glsl"
uniform samplerBuffer rays;
out vec4 found;
void main() {
    int i = 2 * (int(gl_FragCoord.y) * 128 + int(gl_FragCoord.x));
    vec3 origin = texelFetch(rays, i).xyz, direction = texelFetch(rays, i + 1).xyz;
    TraceHit hit;
    bool any = traceClosest(origin, direction, 0, hit);
    found = any ? vec4(hit.triangle, hit.t, traceAny(origin, direction, 0, 0.9 * hit.t),
                       traceAny(origin, direction, 0, 1.1 * hit.t))
                : vec4(-1, 0, 0, 0);
}
)glsl";

/// Rays from random points within the scene's bounds.
std::vector<Ray> randomRays(const Scene& scene) {
    const Bounds bounds = boundsOf(scene);
    RandomStream random(7, 1);
    std::vector<Ray> rays;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        const Vec3 part(random.next2(), random.next());
        rays.push_back({bounds.lower + part * bounds.size(), sampleUniformSphere(random.next2())});
    }
    return rays;
}

/// Whether a ray passes a triangle's edge so closely that only the overlap of shaders/trace.glsl,
/// 1e-5 of the triangle's size, decides if it is met.
bool grazes(const Scene& scene, const Ray& ray, std::uint32_t triangle) {
    const auto corner = [&](int i) { return glm::dvec3(scene.position(triangle, i)); };
    const glm::dvec3 e1 = corner(1) - corner(0), e2 = corner(2) - corner(0);
    const glm::dvec3 direction(ray.direction), s = glm::dvec3(ray.origin) - corner(0);
    const glm::dvec3 p = glm::cross(direction, e2), q = glm::cross(s, e1);
    const double u = glm::dot(s, p) / glm::dot(e1, p);
    const double v = glm::dot(direction, q) / glm::dot(e1, p);
    return std::abs(std::min({u, v, 1 - u - v})) < 2e-5;
}

class TraceShader : public ::testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        fs::create_directories(folder_);
        std::ofstream(folder_ / "search.vert") << kVertexShader;
        std::ofstream(folder_ / "search.frag") << kFragmentShader;
    }
    void TearDown() override { fs::remove_all(folder_); }

    /// What the shader writes for each ray.
    std::vector<Vec4> search(const Bvh& bvh, const std::vector<Ray>& rays) const {
        std::vector<Vec4> rayTexels;
        for (const Ray& ray : rays) {
            rayTexels.emplace_back(ray.origin, 0);
            rayTexels.emplace_back(ray.direction, 0);
        }
        ShaderLibrary shaders(folder_.string());
        const GLuint program = shaders.program("search", {});
        const Buffer buffers[] = {
            makeBuffer(bvh.nodes.data(), bvh.nodes.size() * sizeof(BvhNode)),
            makeBuffer(bvh.triangles.data(), bvh.triangles.size() * sizeof(BvhTriangle)),
            makeBuffer(rayTexels.data(), rayTexels.size() * sizeof(Vec4))};
        const char* names[] = {"bvhNodes", "bvhTriangles", "rays"};
        std::vector<TextureObject> textures;
        for (int i = 0; i < 3; ++i) {
            textures.push_back(makeBufferTexture(buffers[i], GL_RGBA32F));
            glBindTextureUnit(static_cast<GLuint>(i), textures.back().id());
            glProgramUniform1i(program, glGetUniformLocation(program, names[i]), i);
        }
        return draw(program);
    }

  private:
    static std::vector<Vec4> draw(GLuint program) {
        const TextureObject found = makeTexture(GL_TEXTURE_2D);
        glTextureStorage2D(found.id(), 1, GL_RGBA32F, kWidth, kHeight);
        const Framebuffer target = makeFramebuffer();
        glNamedFramebufferTexture(target.id(), GL_COLOR_ATTACHMENT0, found.id(), 0);
        const VertexArray nothing = makeVertexArray();
        glBindFramebuffer(GL_FRAMEBUFFER, target.id());
        glViewport(0, 0, kWidth, kHeight);
        glBindVertexArray(nothing.id());
        glUseProgram(program);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glUseProgram(0);
        std::vector<Vec4> pixels(kWidth * kHeight);
        glGetTextureImage(found.id(), 0, GL_RGBA, GL_FLOAT,
                          static_cast<GLsizei>(pixels.size() * sizeof(Vec4)), pixels.data());
        return pixels;
    }

    HeadlessContext context_;
    const fs::path folder_ =
        fs::path(::testing::TempDir()) / (std::string("vlf_trace_") + GetParam());
};

}  // namespace

TEST_P(TraceShader, FindsTheClosestHit) {
    const Scene scene = generateScene(GetParam());
    const RayScene rayScene(scene);
    const std::vector<Ray> rays = randomRays(scene);
    const std::vector<Vec4> found = search(buildBvh(scene), rays);
    int hits = 0, grazed = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit expected = rayScene.closest(rays[i]);
        ASSERT_EQ(static_cast<bool>(expected), found[i].x >= 0) << "ray " << i;
        if (!expected) continue;
        ++hits;
        if (found[i].x != static_cast<float>(expected.triangle) &&
            grazes(scene, rays[i], static_cast<std::uint32_t>(found[i].x))) {
            ++grazed;
            continue;
        }
        ASSERT_EQ(found[i].x, static_cast<float>(expected.triangle)) << "ray " << i;
        ASSERT_NEAR(found[i].y, expected.t, 1e-5f * expected.t + rayScene.epsilon()) << "ray " << i;
        ASSERT_EQ(found[i].z, 0) << "something lies before the closest hit of ray " << i;
        ASSERT_EQ(found[i].w, 1) << "nothing lies before what is beyond it, ray " << i;
    }
    EXPECT_GT(hits, kWidth * kHeight / 2);
    EXPECT_LE(grazed, 8);
}

INSTANTIATE_TEST_SUITE_P(OfScene, TraceShader, ::testing::Values("cornell", "gallery", "office"));

}  // namespace vlf::gl::test
