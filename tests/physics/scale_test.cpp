// Irradiance does not depend on the unit of length: rooms of a millimetre and of a hundred
// kilometres are lit like the same room of a metre.

#include "solved_scene.h"

#include "vlf/render/cpu/path_integrator.h"
#include "vlf/scene/generate/generate.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

constexpr float kMillimetre = 0x1p-10f, kHundredKilometres = 0x1p17f;  // exact scales

Scene scaled(Scene scene, float scale) {
    for (Vec3& p : scene.positions) p *= scale;
    for (Camera& camera : scene.cameras) camera.eye *= scale, camera.look *= scale;
    return scene;
}

/// Root mean square of the difference of irradiance, relative.
double difference(const SolvedScene& a, const SolvedScene& b) {
    double squares = 0, all = 0;
    for (std::size_t i = 0; i < a.state.irradiance.size(); ++i) {
        const double area = a.state.unwrap.texelArea(i);
        const Vec3 d = a.state.irradiance[i] - b.state.irradiance[i];
        squares += area * glm::dot(d, d);
        all += area * glm::dot(a.state.irradiance[i], a.state.irradiance[i]);
    }
    return std::sqrt(squares / all);
}

void expectTheSameLightAt(float scale, const Scene& scene) {
    const SolvedScene metre(scene, quickParams(4000)),
        other(scaled(scene, scale), quickParams(4000));
    ASSERT_EQ(metre.state.irradiance.size(), other.state.irradiance.size()) << scale;
    EXPECT_LT(difference(metre, other), 0.01) << scale;
    const float power = luminance(other.field.record.energy.emitted) / (scale * scale);
    EXPECT_NEAR(power / luminance(metre.field.record.energy.emitted), 1, 1e-4) << scale;
}

double meanRadiance(const Scene& scene) {
    const RayScene rays(scene);
    const PathIntegrator paths(scene, rays, {});
    const Camera& camera = scene.cameras.front();
    double sum = 0;
    constexpr int kPaths = 20000;
    for (int i = 0; i < kPaths; ++i) {
        RandomStream random(7, static_cast<std::uint64_t>(i));
        const Vec2 across = random.next2() - 0.5f;
        const Vec3 direction =
            glm::normalize(camera.look - camera.eye) + 0.5f * Vec3(across.x, across.y, 0);
        sum += luminance(paths.radiance({camera.eye, glm::normalize(direction)}, random));
    }
    return sum / kPaths;
}

}  // namespace

TEST(Scale, DoesNotChangeTheLightOfABox) {
    for (const float scale : {kMillimetre, kHundredKilometres})
        expectTheSameLightAt(scale, smallCornell());
}

TEST(Scale, DoesNotChangeTheLightOfARoomWithAMirror) {
    const Scene room = generateScene("mirror-room", {1000});
    for (const float scale : {kMillimetre, kHundredKilometres}) expectTheSameLightAt(scale, room);
}

TEST(Scale, DoesNotChangeWhatAPathTracerSees) {
    const double metre = meanRadiance(smallCornell());
    for (const float scale : {kMillimetre, kHundredKilometres})
        EXPECT_NEAR(meanRadiance(scaled(smallCornell(), scale)) / metre, 1, 0.01) << scale;
}

}  // namespace vlf::test
