// Plates whose exchange is known in closed form.

#include "solved_scene.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

namespace vlf::test {

TEST(FormFactor, OfParallelPlates) {
    for (const float side : {0.5f, 1.0f, 4.0f}) {
        const SolvedScene s(parallelPlates(side, 1, 2), quickParams(4000));
        const double expected = 2 * kPi * parallelFormFactor(side);
        EXPECT_NEAR(s.meanIrradianceOfChart(0) / expected, 1, 0.005) << "side " << side;
    }
}

TEST(FormFactor, OfPerpendicularPlates) {
    const SolvedScene s(perpendicularPlates(2), quickParams(4000));
    const double expected = 2 * kPi * perpendicularFormFactor();
    EXPECT_NEAR(s.meanIrradianceOfChart(0) / expected, 1, 0.005);
}

TEST(FormFactor, OfPlatesThatSeeEachOtherByBundlesAlone) {
    // A grey wall lit by a lamp at its foot hands light to the floor: the floor's indirect light
    // is the form factor of the wall when the wall's radiance is even. A lamp far away makes it so.
    SceneBuilder b;
    const std::uint32_t black = b.material("black", Vec3(0)), grey = b.material("grey", Vec3(0.5f));
    const std::uint32_t lamp = b.material("lamp", Vec3(0), Vec3(1000));
    b.quad(Vec3(0), {0, 0, 1}, {1, 0, 0}, black);
    b.quad(Vec3(0), {1, 0, 0}, {0, 1, 0}, grey);
    b.quad({0, 0, 60}, {0, 5, 0}, {5, 0, 0}, lamp);
    BakeParams p = quickParams(0);
    p.texelSize = 0.05f;
    p.cells = 2048;
    p.directions = 2049;
    p.coarseCells = 1024;
    p.maxBounces = 1;
    const SolvedScene s(b.scene(), p);
    const Unwrap& u = s.state.unwrap;
    const double wall = s.meanIrradianceOfChart(2);
    double indirect = 0;
    int count = 0;
    for (std::size_t i = 0; i < u.texels.size(); ++i)
        if (u.texelChart[i] == u.triangleCharts[0].front) {
            indirect += s.state.irradiance[i].x - s.state.directIrradiance[i].x;
            ++count;
        }
    EXPECT_NEAR(indirect / count / (0.5 * wall * perpendicularFormFactor()), 1, 0.02);
}

}  // namespace vlf::test
