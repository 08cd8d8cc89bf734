// Direct light against form factors integrated numerically, straight and by way of mirrors.

#include "vlf/propagate/direct_light.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

using DVec3 = glm::dvec3;

/// Parallelogram origin + s u + t v that emits `radiance` to the side of cross(u, v).
struct Lamp {
    Vec3 origin, u, v;
    float radiance;
};

/// Unoccluded irradiance at p with normal n, by the midpoint rule in double precision.
double irradianceFrom(const Lamp& lamp, const Vec3& p, const Vec3& n) {
    constexpr int kSteps = 24;
    const DVec3 areaVector = glm::cross(DVec3(lamp.u), DVec3(lamp.v)) / double(kSteps * kSteps);
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const DVec3 y = DVec3(lamp.origin) + DVec3(lamp.u) * ((i + 0.5) / kSteps) +
                            DVec3(lamp.v) * ((j + 0.5) / kSteps);
            const DVec3 d = y - DVec3(p);
            const double receiver = glm::dot(DVec3(n), d), emitter = -glm::dot(areaVector, d);
            if (receiver > 0 && emitter > 0)
                sum += receiver * emitter / std::pow(glm::dot(d, d), 2);
        }
    return lamp.radiance * sum;
}

Lamp mirroredInX(Lamp lamp) {
    for (Vec3* v : {&lamp.origin, &lamp.u, &lamp.v}) v->x = -v->x;
    std::swap(lamp.u, lamp.v);
    return lamp;
}

void addLamp(SceneBuilder& b, const Lamp& lamp) {
    b.quad(lamp.origin, lamp.u, lamp.v, b.material("lamp", Vec3(0), Vec3(lamp.radiance)));
}

struct Lit {
    Lit(const Scene& sceneToLight, float texelSize, int samples)
        : scene(sceneToLight), rays(scene), unwrap(vlf::unwrap(scene, rays, {texelSize})) {
        Progress progress;
        DirectLight light;
        findDirectLight(scene, rays, unwrap, findLightSources(scene, unwrap), {samples, 1}, light,
                        progress);
        for (const DirectEstimate& e : light.estimates) irradiance.push_back(e.value);
    }

    /// Largest error of a texel of triangle 0's front, relative to the mean, against `expected`
    /// (p) averaged over the texel's points.
    template <class Expected>
    double largestError(Expected expected) const {
        double sum = 0, worst = 0;
        int count = 0;
        for (std::size_t i = 0; i < unwrap.texels.size(); ++i) {
            if (unwrap.texelChart[i] != unwrap.triangleCharts[0].front) continue;
            double truth = 0;
            for (const SurfacePoint& p : unwrap.points.of(i))
                truth += expected(positionAt(scene, p.triangle, p.barycentric));
            truth /= static_cast<double>(unwrap.points.of(i).size());
            worst = std::max(worst, std::abs(irradiance[i].x - truth));
            sum += truth;
            ++count;
        }
        EXPECT_GT(count, 100);
        return worst / (sum / count);
    }

    Scene scene;
    RayScene rays;
    Unwrap unwrap;
    std::vector<Vec3> irradiance;
};

constexpr Vec3 kUp{0, 1, 0};
constexpr Lamp kCeilingLamp{{1.3f, 2, 1.4f}, {1, 0, 0}, {0, 0, 0.7f}, 3};

}  // namespace

TEST(DirectLight, OfAnUnoccludedLampIsItsFormFactor) {
    SceneBuilder b;
    b.quad(Vec3(0), {0, 0, 4}, {4, 0, 0}, b.material("floor", Vec3(0.5f)));
    addLamp(b, kCeilingLamp);
    const Lit lit(b.scene(), 0.2f, 16);
    EXPECT_LT(lit.largestError([](const Vec3& p) { return irradianceFrom(kCeilingLamp, p, kUp); }),
              2e-3);
}

TEST(DirectLight, DoesNotMindNormalsThatPointBehindTheSurface) {
    SceneBuilder b;
    b.quad(Vec3(0), {0, 0, 4}, {4, 0, 0}, b.material("floor", Vec3(0.5f)));
    addLamp(b, kCeilingLamp);
    Scene scene = b.scene();
    for (Vec3& normal : scene.normals) normal = -normal;
    const Lit lit(scene, 0.2f, 16);
    EXPECT_LT(lit.largestError([](const Vec3& p) { return irradianceFrom(kCeilingLamp, p, kUp); }),
              2e-3);
}

TEST(DirectLight, AgreesWithTheClosedFormBelowACorner) {
    SceneBuilder b;
    b.quad({-0.01f, 0, -0.01f}, {0, 0, 0.02f}, {0.02f, 0, 0}, b.material("floor", Vec3(0.5f)));
    addLamp(b, {{0, 2, 0}, {1.5f, 0, 0}, {0, 0, 1}, 3});
    const Lit lit(b.scene(), 0.02f, 16);
    EXPECT_NEAR(lit.irradiance[0].x, 3 * kPi * pointToRectangleFormFactor(1.5, 1, 2), 1e-3);
}

TEST(DirectLight, OfALampThatFacesAwayIsNone) {
    SceneBuilder b;
    b.quad(Vec3(0), {0, 0, 4}, {4, 0, 0}, b.material("floor", Vec3(0.5f)));
    addLamp(b, {{1, 2, 1}, {0, 0, 1}, {1, 0, 0}, 3});
    const Lit lit(b.scene(), 0.2f, 16);
    for (const Vec3& e : lit.irradiance) EXPECT_EQ(e, Vec3(0));
}

TEST(DirectLight, InTheUmbraIsNone) {
    // The screen just below the lamp leaves only what lies far to the side in the light.
    SceneBuilder b;
    b.quad({-10, 0, -10}, {0, 0, 24}, {24, 0, 0}, b.material("floor", Vec3(0.5f)));
    addLamp(b, kCeilingLamp);
    b.quad({1, 1.9f, 1}, {0, 0, 1.6f}, {1.6f, 0, 0}, b.material("screen", Vec3(0.5f)));
    const Lit lit(b.scene(), 0.5f, 64);
    int dark = 0, bright = 0;
    for (std::size_t i = 0; i < lit.unwrap.texels.size(); ++i) {
        const SurfacePoint& point = lit.unwrap.points.of(i)[0];
        const Vec3 p = positionAt(lit.scene, point.triangle, point.barycentric);
        if (lit.unwrap.texelChart[i] != lit.unwrap.triangleCharts[0].front) continue;
        bright += maxComponent(lit.irradiance[i]) > 0;
        if (glm::distance(p, Vec3(1.8f, 0, 1.75f)) > 4.5f) continue;
        ++dark;
        EXPECT_EQ(lit.irradiance[i], Vec3(0)) << p.x << " " << p.z;
    }
    EXPECT_GT(dark, 200);
    EXPECT_GT(bright, 200);
}

TEST(DirectLight, OfTwoLampsAddsUp) {
    const Lamp other{{3, 1, 0.5f}, {0, 0, 1}, {0, 0.5f, 0}, 8};  // on a wall, facing -x
    SceneBuilder b;
    b.quad(Vec3(0), {0, 0, 4}, {2.5f, 0, 0}, b.material("floor", Vec3(0.5f)));
    addLamp(b, kCeilingLamp);
    addLamp(b, other);
    const Lit lit(b.scene(), 0.2f, 64);
    EXPECT_LT(lit.largestError([&](const Vec3& p) {
        return irradianceFrom(kCeilingLamp, p, kUp) + irradianceFrom(other, p, kUp);
    }),
              5e-3);
}

TEST(DirectLight, OfManyLampsIsTheirSumWithoutARayForEach) {
    // The ceiling lamp in 20 x 20 pieces, of which half a dozen rays meet as many.
    SceneBuilder b;
    b.quad(Vec3(0), {0, 0, 4}, {4, 0, 0}, b.material("floor", Vec3(0.5f)));
    constexpr int kSide = 20;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            Lamp piece = kCeilingLamp;
            piece.u /= 2.0f * kSide;
            piece.v /= 2.0f * kSide;
            piece.origin += 2.0f * static_cast<float>(i) * piece.u;
            piece.origin += 2.0f * static_cast<float>(j) * piece.v;
            addLamp(b, piece);
        }
    Lamp quarter = kCeilingLamp;
    quarter.radiance /= 4;
    const auto expected = [&](const Vec3& p) { return irradianceFrom(quarter, p, kUp); };
    const Lit lit(b.scene(), 0.2f, 6);
    EXPECT_LT(lit.largestError(expected), 0.1);
    double sum = 0, truth = 0;
    for (std::size_t i = 0; i < lit.unwrap.texels.size(); ++i) {
        if (lit.unwrap.texelChart[i] != lit.unwrap.triangleCharts[0].front) continue;
        sum += lit.irradiance[i].x;
        const auto points = lit.unwrap.points.of(i);
        for (const SurfacePoint& p : points)
            truth += expected(positionAt(lit.scene, p.triangle, p.barycentric)) /
                     static_cast<double>(points.size());
    }
    EXPECT_NEAR(sum / truth, 1, 0.01);
}

TEST(DirectLight, OfATexturedLampIsSteadyHoweverClose) {
    // The lamp is a square of 4 m over one of 2 m: within 1 m, part of it is near.
    for (const float height : {0.01f, 0.7f, 1.5f}) {
        const Lamp lamp{{-1, height, -1}, {4, 0, 0}, {0, 0, 4}, 3};
        SceneBuilder b;
        b.quad(Vec3(0), {0, 0, 2}, {2, 0, 0}, b.material("floor", Vec3(0.5f)));
        addLamp(b, lamp);
        Scene scene = b.scene();
        Texture& white = scene.textures.emplace_back();
        white.width = white.height = 1;
        white.linear = {Vec3(1)};
        scene.materials.back().emissionTexture = 0;
        const Lit lit(scene, 0.1f, 64);
        const auto expected = [&](const Vec3& p) {
            return height < 0.1f ? 3.0 * kPi : irradianceFrom(lamp, p, kUp);
        };
        EXPECT_LT(lit.largestError(expected), 0.05) << height << " m";
    }
}

TEST(DirectLight, ByAPlanarMirrorComesFromTheMirrorImage) {
    // A mirror in the plane x = 0; the lamp at x = 1 faces it, so that the floor beyond has light
    // from its image alone.
    const Lamp lamp{{1, 2, -0.3f}, {0, 0, 0.6f}, {0, 0.5f, 0}, 20};
    SceneBuilder b;
    b.quad({1.2f, 0, -1}, {0, 0, 2}, {1.8f, 0, 0}, b.material("floor", Vec3(0.5f)));
    b.quad({0, 0, -3}, {0, 3, 0}, {0, 0, 6}, b.material("mirror", Vec3(0), Vec3(0), Vec3(0.8f)));
    addLamp(b, lamp);
    const Lit lit(b.scene(), 0.1f, 64);
    const Lamp image = mirroredInX(lamp);
    EXPECT_LT(lit.largestError([&](const Vec3& p) { return 0.8 * irradianceFrom(image, p, kUp); }),
              5e-3);
}

TEST(DirectLight, ByTwoMirrorsComesFromTheImageOfTheImage) {
    // Mirrors in the planes x = 0 and z = 0 meet at a right angle: three images.
    const Lamp lamp{{1, 2, 1}, {0, 0, 0.5f}, {0.5f, 0, 0}, 20};  // faces up
    const Lamp down{lamp.origin, lamp.v, lamp.u, lamp.radiance};
    SceneBuilder b;
    b.quad({0.5f, 0, 0.5f}, {0, 0, 2}, {2, 0, 0}, b.material("floor", Vec3(0.5f)));
    const std::uint32_t mirror = b.material("mirror", Vec3(0), Vec3(0), Vec3(0.5f));
    b.quad(Vec3(0), {0, 4, 0}, {0, 0, 4}, mirror);
    b.quad(Vec3(0), {4, 0, 0}, {0, 4, 0}, mirror);
    addLamp(b, down);
    const Lit lit(b.scene(), 0.1f, 256);
    EXPECT_LT(lit.largestError([&](const Vec3& p) {
        const auto from = [&](float x, float z, double reflectance) {
            return reflectance * irradianceFrom(down, {x * p.x, p.y, z * p.z}, kUp);
        };
        return from(1, 1, 1) + from(-1, 1, 0.5) + from(1, -1, 0.5) + from(-1, -1, 0.25);
    }),
              0.03);
}

TEST(DirectLight, CanBeCancelled) {
    const Scene scene = smallCornell();
    const RayScene rays(scene);
    const Unwrap charts = unwrap(scene, rays, {0.02f});
    Progress progress;
    progress.cancel();
    DirectLight light;
    EXPECT_ANY_THROW(findDirectLight(scene, rays, charts, findLightSources(scene, charts), {16, 1},
                                     light, progress));
}

}  // namespace vlf::test
