// Direct light against form factors integrated numerically, straight and by way of mirrors.

#include "vlf/propagate/direct_light.h"

#include "support/analytic_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
        for (const DirectEstimate& e : light.estimates) {
            irradiance.push_back(e.value);
            squareError += e.squareError();
        }
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
    double squareError = 0;  ///< estimated, over all texels
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

namespace {

Scene floorUnder(const PunctualLight& light, float scale = 1) {
    SceneBuilder b;
    b.quad({-scale, 0, -scale}, {0, 0, 2 * scale}, {2 * scale, 0, 0},
           b.material("floor", Vec3(0.5f)));
    b.scene().lights = {light};
    return b.scene();
}

PunctualLight pointAt(const Vec3& position, float intensity) {
    PunctualLight light;
    light.position = position;
    light.intensity = Vec3(intensity);
    return light;
}

/// I cosθ / d².
double pointIrradiance(const PunctualLight& light, const Vec3& p, const Vec3& n) {
    const DVec3 d = DVec3(light.position) - DVec3(p);
    return light.intensity.x * std::max(0.0, glm::dot(DVec3(n), d)) / std::pow(glm::length(d), 3);
}

}  // namespace

TEST(DirectLight, OfAPointFallsWithTheSquareOfTheDistanceAndTheCosineAtAnyScale) {
    for (const float scale : {1e-3f, 1.0f, 1e3f}) {
        const PunctualLight light = pointAt(scale * Vec3(0.3f, 0.8f, -0.2f), 5 * scale * scale);
        const Lit lit(floorUnder(light, scale), 0.05f * scale, 16);
        EXPECT_LT(lit.largestError([&](const Vec3& p) { return pointIrradiance(light, p, kUp); }),
                  1e-3)
            << scale;
    }
}

TEST(DirectLight, OfASpotIsThatWithinItsCones) {
    PunctualLight light = pointAt({0.1f, 1, 0.2f}, 4);
    light.kind = PunctualKind::spot;
    light.direction = glm::normalize(Vec3(0.2f, -1, 0));
    light.innerCone = 0.25f;
    light.outerCone = 0.55f;
    const Lit lit(floorUnder(light), 0.05f, 16);
    EXPECT_LT(lit.largestError([&](const Vec3& p) {
        const DVec3 way = glm::normalize(DVec3(p) - DVec3(light.position));
        const double outer = std::cos(0.55), width = std::cos(0.25) - outer;
        const double t =
            std::clamp((glm::dot(way, DVec3(light.direction)) - outer) / width, 0.0, 1.0);
        return t * t * pointIrradiance(light, p, kUp);
    }),
              2e-3);
}

TEST(DirectLight, OfADirectionalLightIsTheSameAllOverAndHasAHardShadow) {
    PunctualLight light = pointAt(Vec3(0), 3);
    light.kind = PunctualKind::directional;
    light.direction = glm::normalize(Vec3(0.5f, -1, 0.25f));
    SceneBuilder b;
    b.scene() = floorUnder(light);
    b.quad({-0.4f, 0.5f, -0.3f}, {0.5f, 0, 0}, {0, 0, 0.6f}, b.material("board", Vec3(0.5f)));
    const Lit lit(b.scene(), 0.05f, 64);
    // The board's shadow lies 0.25 along x and 0.125 along z from below it.
    EXPECT_LT(lit.largestError([&](const Vec3& p) {
        const bool shadowed = p.x > -0.15f && p.x < 0.35f && p.z > -0.175f && p.z < 0.425f;
        return shadowed ? 0 : 3 * std::abs(light.direction.y);
    }),
              0.3);  // of a point or two of a texel that the edge crosses
    double sum = 0;
    for (std::size_t i = 0; i < lit.irradiance.size(); ++i)
        if (lit.unwrap.texelChart[i] == lit.unwrap.triangleCharts[0].front)
            sum += lit.irradiance[i].x * lit.unwrap.texelArea(i);
    EXPECT_NEAR(sum / (3 * std::abs(light.direction.y) * (4 - 0.5 * 0.6)), 1, 2e-3);
}

TEST(DirectLight, OfAPointComesByWayOfAMirrorToo) {
    const PunctualLight light = pointAt({0.5f, 0.7f, 0.1f}, 2);
    SceneBuilder b;
    b.quad({0, 0, -1}, {0, 0, 2}, {2, 0, 0}, b.material("floor", Vec3(0.5f)));
    b.quad({0, 0, -4}, {0, 8, 0}, {0, 0, 8}, b.material("mirror", Vec3(0), Vec3(0), Vec3(0.5f)));
    b.scene().lights = {light};
    const Lit lit(b.scene(), 0.1f, 64);
    PunctualLight image = light;
    image.position.x = -light.position.x;
    EXPECT_LT(lit.largestError([&](const Vec3& p) {
        return pointIrradiance(light, p, kUp) + 0.5 * pointIrradiance(image, p, kUp);
    }),
              0.01);
}

TEST(DirectLight, OfADirectionalLightComesByWayOfAMirrorToo) {
    PunctualLight light = pointAt(Vec3(0), 2);
    light.kind = PunctualKind::directional;
    light.direction = glm::normalize(Vec3(-1, -1, 0));
    SceneBuilder b;
    b.quad({0, 0, -1}, {0, 0, 2}, {1, 0, 0}, b.material("floor", Vec3(0.5f)));
    b.quad({0, 0, -4}, {0, 8, 0}, {0, 0, 8}, b.material("mirror", Vec3(0), Vec3(0), Vec3(0.5f)));
    b.scene().lights = {light};
    const Lit lit(b.scene(), 0.1f, 64);
    EXPECT_LT(lit.largestError([&](const Vec3&) { return 1.5 * 2 * std::sqrt(0.5); }), 1e-3);
}

TEST(DirectLight, IsFiniteWhereALightLiesOnASurfaceOrAtATexel) {
    Scene scene = floorUnder(pointAt(Vec3(0), 1));
    const RayScene rays(scene);
    const Unwrap charts = unwrap(scene, rays, {0.1f});
    const SurfacePoint& p = charts.points.of(charts.texels.size() / 3)[0];
    scene.lights.push_back(pointAt(positionAt(scene, p.triangle, p.barycentric), 1));
    scene.lights.push_back(pointAt({0.05f, 1e-7f, 0.05f}, 1));
    for (const Vec3& e : Lit(scene, 0.1f, 16).irradiance) EXPECT_TRUE(isFinite(e));
}

TEST(DirectLight, OfHundredsOfLightsIsTheirSum) {
    Scene scene = floorUnder(pointAt({0, 1, 0}, 0.01f));
    scene.lights.clear();
    for (int i = 0; i < 300; ++i) {
        const auto f = static_cast<float>(i);
        scene.lights.push_back(pointAt({std::sin(f), 0.5f + 0.4f * std::cos(7 * f), std::cos(f)},
                                       0.01f * (1 + static_cast<float>(i % 5))));
    }
    const Lit lit(scene, 0.1f, 256);
    EXPECT_LT(lit.largestError([&](const Vec3& p) {
        double sum = 0;
        for (const PunctualLight& light : scene.lights) sum += pointIrradiance(light, p, kUp);
        return sum;
    }),
              0.05);
}

TEST(DirectLight, OfALightOutsideDoesNotEnterAClosedRoom) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(2), true, b.material("wall", Vec3(0.5f)));
    b.scene().lights = {pointAt({5, 1, 1}, 100)};
    const Lit lit(b.scene(), 0.1f, 16);
    double outside = 0;
    for (std::size_t i = 0; i < lit.irradiance.size(); ++i) {
        const std::uint32_t triangle = lit.unwrap.points.of(i)[0].triangle;
        const bool isFront = lit.unwrap.triangleCharts[triangle].front == lit.unwrap.texelChart[i];
        if (isFront)
            EXPECT_EQ(lit.irradiance[i], Vec3(0));
        else
            outside += lit.irradiance[i].x;
    }
    EXPECT_GT(outside, 0);
}

TEST(DirectLight, KnowsTheErrorOfPenumbraeOfBodiesAndOfPanes) {
    for (const float transmission : {0.0f, 0.5f}) {
        SceneBuilder b;
        b.quad(Vec3(0), {0, 0, 4}, {4, 0, 0}, b.material("floor", Vec3(0.5f)));
        const std::uint32_t pane = b.material("pane", Vec3(0));
        b.scene().materials[pane].transmission = Vec3(transmission);
        b.scene().materials[pane].thin = true;
        b.quad({0.7f, 1, 0.9f}, {1.1f, 0, 0.1f}, {0.2f, 0, 1.3f}, pane);
        addLamp(b, kCeilingLamp);
        const Lit lit(b.scene(), 0.15f, 4), truth(b.scene(), 0.15f, 256);
        double square = 0;
        for (std::size_t i = 0; i < lit.irradiance.size(); ++i) {
            const Vec3 d = lit.irradiance[i] - truth.irradiance[i];
            square += glm::dot(d, d);
        }
        EXPECT_GT(lit.squareError, 0.3 * square) << "transmission " << transmission;
        EXPECT_LT(lit.squareError, 3 * square) << "transmission " << transmission;
    }
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
