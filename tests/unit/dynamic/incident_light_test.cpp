#include "vlf/dynamic/incident_light.h"

#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/scene/generate/primitives.h"

#include "support/analytic_scenes.h"
#include "support/baked_example.h"
#include "unit/dynamic/lit_room.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

using test::LitRoom;

const Bounds kUnitBox{Vec3(-0.5f), Vec3(0.5f)};

Pose poseAt(const Vec3& position, float scale) {
    return {position, glm::angleAxis(0.7f, glm::normalize(Vec3(1, 2, 3))), scale};
}

/// 2 m wide, with a lamp of radiance 5, a side of it 0.2 m long, in the middle of the ceiling.
Scene roomWithLamp() {
    test::SceneBuilder builder;
    builder.box(Vec3(-1), Vec3(1), true, builder.material("wall", Vec3(0.5f)));
    builder.quad({-0.1f, 0.99f, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f},
                 builder.material("lamp", Vec3(0), Vec3(5)));
    return builder.scene();
}

Scene emptyRoom() {
    test::SceneBuilder builder;
    builder.box(Vec3(-1), Vec3(1), true, builder.material("wall", Vec3(0.5f)));
    return builder.scene();
}

void expectConstant(const Sh<Vec3>& light, const Vec3& radiance) {
    RandomStream random(1, 0);
    for (int i = 0; i < 20; ++i) {
        const Vec3 n = sampleUniformSphere(random.next2());
        EXPECT_LT(glm::distance(shIrradiance(light, n), kPi * radiance), 1e-4f);
    }
}

TEST(IncidentLight, OfAnEvenlyLitRoomIsConstant) {
    const LitRoom room(emptyRoom(), {1, 2, 3});
    const IncidentLightFinder finder(room.scene, room.rays, room.texels);
    IncidentLightFinder::Scratch scratch(finder);
    IncidentLight light;
    for (const float scale : {0.01f, 0.5f}) {
        finder.find(kUnitBox, poseAt({0.3f, -0.4f, 0.2f}, scale), room.radiance, {}, scratch,
                    light);
        EXPECT_EQ(light.uniform, scale < 0.1f);
        for (int i = 0; i < (light.uniform ? 1 : 8); ++i)
            expectConstant(light.corners[i], {1, 2, 3});
    }
}

TEST(IncidentLight, AnEmitterCountsByItsSolidAngleFromItsDirection) {
    const LitRoom room(roomWithLamp(), Vec3(0));
    const IncidentLightFinder finder(room.scene, room.rays, room.texels);
    IncidentLightFinder::Scratch scratch(finder);
    const Vec3 point(0.2f, -0.5f, 0.1f), way = Vec3(0, 0.99f, 0) - point;
    const Sh<Vec3> light = finder.at(point, room.radiance, scratch);
    const float distance = glm::length(way);
    const float solidAngle = 0.04f * way.y / (distance * distance * distance);
    EXPECT_NEAR(light[0].x, 5 * solidAngle * 0.28209479f, 5e-4f);
    const Vec3 direction = way / distance;
    // The five bands of the cosine lobe reach 31/32 at its middle.
    EXPECT_NEAR(shIrradiance(light, direction).x, 5 * solidAngle * 31 / 32, 1e-3f);
}

TEST(IncidentLight, EmittersMetByDirectionsAloneAreTheSameOnAverage) {
    const LitRoom room(roomWithLamp(), Vec3(0));
    const IncidentLightFinder sampled(room.scene, room.rays, room.texels);
    const IncidentLightFinder met(room.scene, room.rays, room.texels,
                                  {.lines = 8193, .emitters = IncidentEmitters::met});
    IncidentLightFinder::Scratch scratch(sampled);
    const Vec3 point(0.2f, -0.5f, 0.1f);
    const Sh<Vec3> a = sampled.at(point, room.radiance, scratch);
    const Sh<Vec3> b = met.at(point, room.radiance, scratch);
    for (int f = 0; f < kMaxShCount; ++f) EXPECT_NEAR(a[f].x, b[f].x, 0.01f) << f;
}

TEST(IncidentLight, EmittersSeenInMirrorsAreTheSameOnAverage) {
    const LitRoom room(test::mirrorBox(), Vec3(0));
    const IncidentLightFinder sampled(room.scene, room.rays, room.texels, {.emitterPoints = 256});
    const IncidentLightFinder met(room.scene, room.rays, room.texels,
                                  {.lines = 8193, .emitters = IncidentEmitters::met});
    IncidentLightFinder::Scratch scratch(sampled);
    const Vec3 point(-0.3f, 0.2f, 0.1f);
    const Sh<Vec3> a = sampled.at(point, room.radiance, scratch);
    const Sh<Vec3> b = met.at(point, room.radiance, scratch);
    for (int f = 0; f < kMaxShCount; ++f) EXPECT_NEAR(a[f].x, b[f].x, 0.01f) << f;
    EXPECT_LT(shValue(a, Vec3(-1, 0, 0)).x, shValue(a, Vec3(1, 0, 0)).x);
    EXPECT_GT(shValue(a, Vec3(-1, 0, 0)).x, 0.1f);
}

TEST(IncidentLight, EmittersCanBeLeftOut) {
    const LitRoom room(roomWithLamp(), Vec3(0.25f));
    const IncidentLightFinder finder(room.scene, room.rays, room.texels,
                                     {.emitters = IncidentEmitters::none});
    IncidentLightFinder::Scratch scratch(finder);
    expectConstant(finder.at({0.2f, -0.5f, 0.1f}, room.radiance, scratch), Vec3(0.25f));
}

TEST(IncidentLight, IsOfTheObjectsSpace) {
    const LitRoom room(roomWithLamp(), Vec3(0.1f));
    const IncidentLightFinder finder(room.scene, room.rays, room.texels);
    IncidentLightFinder::Scratch scratch(finder);
    IncidentLight light;
    const Pose pose = poseAt({0.1f, 0, 0}, 0.01f);
    finder.find(kUnitBox, pose, room.radiance, {}, scratch, light);
    const Sh<Vec3> world = finder.at(pose.translation, room.radiance, scratch);
    for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
        EXPECT_NEAR(shIrradiance(light.corners[0], pose.inverseDirection(n)).x,
                    shIrradiance(world, n).x, 1e-4f);
}

TEST(IncidentLight, CornersOfALargeObjectHaveLightOfTheirOwn) {
    const LitRoom room(roomWithLamp(), Vec3(0));
    const IncidentLightFinder finder(room.scene, room.rays, room.texels);
    IncidentLightFinder::Scratch scratch(finder);
    IncidentLight light;
    finder.find(kUnitBox, {Vec3(0), Quat(1, 0, 0, 0), 1}, room.radiance, {}, scratch, light);
    ASSERT_FALSE(light.uniform);
    for (std::size_t below = 0; below < 8; ++below)
        EXPECT_GE(light.corners[below | 2][0].x,
                  ((below & 2) == 0 ? 2 : 1) * light.corners[below][0].x);
}

TEST(IncidentLight, CornersBehindAWallAreTakenBeforeIt) {
    const LitRoom room(emptyRoom(), Vec3(1));
    const IncidentLightFinder finder(room.scene, room.rays, room.texels);
    IncidentLightFinder::Scratch scratch(finder);
    IncidentLight light;
    finder.find(kUnitBox, {Vec3(0.8f, 0, 0), Quat(1, 0, 0, 0), 1}, room.radiance, {}, scratch,
                light);
    for (const Sh<Vec3>& corner : light.corners) expectConstant(corner, Vec3(1));
}

TEST(IncidentLight, OtherObjectsHideTheRoomAndSendLightOfTheirOwn) {
    const LitRoom room(roomWithLamp(), Vec3(0));
    const IncidentLightFinder finder(room.scene, room.rays, room.texels);
    // A plate of irradiance 2π and reflectance 0.8 between the lamp and a small cube.
    Material material;
    material.diffuse = Vec3(0.8f);
    const ObjectMesh mesh(makePrimitive("cube", material));
    const std::vector<Vec3> irradiance(mesh.sidedVertexCount(), Vec3(2 * kPi));
    LitObject plate, self;
    plate.mesh = self.mesh = &mesh;
    plate.vertexIrradiance = self.vertexIrradiance = irradiance;
    plate.pose = {Vec3(0, 0.25f, 0), Quat(1, 0, 0, 0), 0.5f};
    self.pose = {Vec3(0, -0.5f, 0), Quat(1, 0, 0, 0), 0.01f};
    const std::array<LitObject, 2> lit{plate, self};
    RayInstances instances;
    instances.place(
        std::array{RayInstance{&mesh.rays, plate.pose}, RayInstance{&mesh.rays, self.pose}});
    IncidentLightFinder::Scratch scratch(finder);
    IncidentLight alone, below;
    finder.find(kUnitBox, self.pose, room.radiance, {}, scratch, alone);
    finder.find(kUnitBox, self.pose, room.radiance, {&instances, lit}, scratch, below);
    EXPECT_GT(alone.corners[0][0].x, 0.01f);
    // The plate's underside, 0.5 m wide, 0.5 m above.
    const float solidAngle = 4 * std::asin(0.2f);
    EXPECT_NEAR(below.corners[0][0].x, 0.28209479f * 1.6f * solidAngle, 0.04f);
    EXPECT_NEAR(shValue(below.corners[0], Vec3(0, -1, 0)).x, 0, 0.2f);
}

TEST(IncidentLight, GivesTheIrradianceOfABakedRoomBetterWithEveryOtherBand) {
    const Scene scene = test::smallCornell();
    const RayScene rays(scene);
    const LightField field = test::bakeDraft(scene, 2000);
    const RoomTexels room = makeRoomTexels(scene, rays, field);
    std::vector<Vec3> radiance(room.unwrap.atlasSize(), Vec3(0));
    for (const std::uint32_t t : room.unwrap.texels)
        radiance[t] = room.reflectance[t] * field.atlas.irradiance[t] / kPi;
    const IncidentLightFinder finder(scene, rays, room);
    IncidentLightFinder::Scratch scratch(finder);
    std::array<double, kMaxShOrder> squares{};
    double sum = 0;
    for (const Vec3& point : {Vec3(0.3f, 0.2f, 0.3f), Vec3(0.2f, 0.6f, 0.5f),
                              Vec3(0.5f, 0.5f, 0.5f), Vec3(0.8f, 0.5f, 0.2f)}) {
        std::vector<Ray> around;
        for (std::uint32_t i = 0; i < 16384; ++i)
            around.push_back({point, sampleUniformSphere(r2Point(i, Vec2(0.5f)))});
        std::vector<Vec3> seen(around.size(), Vec3(0));
        scratch.tracer.trace(around, scratch.sights);
        for (std::size_t k = 0; k < around.size(); ++k)
            if (scratch.sights.texel[k] != kNoTexel) seen[k] = radiance[scratch.sights.texel[k]];
        for (const Sight& s : scratch.sights.others)
            seen[s.ray] += s.throughput * (diffuseRadiance(s, radiance, {}) + s.emission);
        Sh<Vec3> light = finder.at(point, radiance, scratch);
        for (int order = kMaxShOrder; order > 0; --order) {
            RandomStream random(3, 0);
            for (int i = 0; i < 20; ++i) {
                const Vec3 n = sampleUniformSphere(random.next2());
                Vec3 truth(0);
                for (std::size_t k = 0; k < around.size(); ++k)
                    truth += std::max(0.0f, glm::dot(n, around[k].direction)) * seen[k];
                truth *= 4 * kPi / static_cast<float>(around.size());
                const Vec3 d = shIrradiance(light, n) - truth;
                squares[order - 1] += glm::dot(d, d);
                if (order == kMaxShOrder) sum += glm::dot(truth, truth);
            }
            for (int f = shCount(order - 1); f < shCount(order); ++f) light[f] = Vec3(0);
        }
    }
    const auto error = [&](int order) { return std::sqrt(squares[order - 1] / sum); };
    EXPECT_LT(error(2), 0.6 * error(1));
    EXPECT_LT(error(3), 0.3 * error(2));
    EXPECT_LT(error(5), error(3));
    EXPECT_LT(error(5), 0.03);
}

}  // namespace
}  // namespace vlf
