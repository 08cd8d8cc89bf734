// Claims about whole rooms: no leaks, no light lost, caustics where they belong.

#include "solved_scene.h"

#include "vlf/scene/generate/generate.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vlf::test {

TEST(SealedRoom, StaysDark) {
    const SolvedScene s(generateScene("sealed"), quickParams(20000));
    const double lit = s.meanIrradiance([&](std::size_t i) { return s.centre(i).x < 3.99f; });
    const double dark = s.meanIrradiance([&](std::size_t i) { return s.centre(i).x > 4.01f; });
    EXPECT_GT(lit, 1);
    EXPECT_LE(dark, 1e-4 * lit) << "dark " << dark << ", lit " << lit;
}

TEST(SealedRoom, IsDarkInTheAtlasToo) {
    // The shared floor and ceiling are one chart each: what is drawn near the wall must not leak.
    const SolvedScene s(generateScene("sealed"), quickParams(20000));
    const float lit =
        static_cast<float>(s.meanIrradiance([&](std::size_t i) { return s.centre(i).x < 3.99f; }));
    const Unwrap& u = s.state.unwrap;
    float worst = 0;
    for (std::size_t i = 0; i < u.texels.size(); ++i)
        if (s.centre(i).x > 4.01f + u.texelSize)
            worst = std::max(worst, luminance(s.field.atlas.irradiance[u.texels[i]]));
    EXPECT_LT(worst, 1e-3f * lit);
}

TEST(SealedRoom, ShowsNoDarkLineAlongTheWallThatDarkIsBehind) {
    const SolvedScene s(generateScene("sealed"), quickParams(20000));
    const auto shownAt = [&](const Vec3& onFloor) {
        const Hit hit = s.state.rays.closest({onFloor + Vec3(0, 0.01f, 0), {0, -1, 0}});
        const Chart& chart = s.field.charts[s.field.triangleCharts[hit.triangle].front];
        return luminance(s.field.atlas.sample(chart, chart.texelCoordinates(onFloor)));
    };
    for (const float z : {0.5f, 1.3f, 2.1f, 3.2f}) {
        const float before = shownAt({3.99f - 2 * s.state.unwrap.texelSize, 0, z});
        EXPECT_NEAR(shownAt({3.985f, 0, z}) / before, 1, 0.15) << "z " << z;
    }
}

TEST(EnergyBalance, ClosedRoomsLoseNothing) {
    for (const char* name : {"two-rooms", "mirror-room"}) {
        BakeParams p = quickParams(15000);
        p.tolerance = 1e-3;
        const SolvedScene s(generateScene(name), p);
        const EnergyReport& e = s.field.record.energy;
        for (int c = 0; c < 3; ++c)
            EXPECT_LE(std::abs(e.escaped[c]), 0.01f * e.emitted[c])
                << name << " channel " << c << ": " << 100 * e.escaped[c] / e.emitted[c] << " %";
    }
}

TEST(Caustic, LiesOnTheWallTheMirrorFaces) {
    const SolvedScene s(generateScene("caustic"), quickParams(30000));
    // The lamp at (1, 1.8) shines down on a mirror 0.55 m high that is tilted by 35 degrees: the
    // beam meets the wall x = 4.2 where it has risen by tan 20 degrees.
    const double length = 4.2 - 1, y = 0.55 + length * std::tan(20 * kPi / 180), z = 1.8;
    const auto onWall = [&](std::size_t i) { return s.centre(i).x > 4.19f; };
    const auto inPatch = [&](std::size_t i) {
        const Vec3 p = s.centre(i);
        return onWall(i) && std::hypot(p.y - y, p.z - z) < 0.2;
    };
    const auto outside = [&](std::size_t i) {
        const Vec3 p = s.centre(i);
        return onWall(i) && std::hypot(p.y - y, p.z - z) > 1.2;
    };
    EXPECT_GT(s.meanIrradiance(inPatch), 5 * s.meanIrradiance(outside));
}

}  // namespace vlf::test
