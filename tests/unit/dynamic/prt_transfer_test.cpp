#include "vlf/dynamic/prt_transfer.h"
#include "vlf/base/parallel.h"
#include "vlf/dynamic/prt_store.h"
#include "vlf/dynamic/subdivide.h"
#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/scene/generate/primitives.h"

#include "support/analytic_scenes.h"

#include <functional>

#include <gtest/gtest.h>

namespace vlf {
namespace {

/// Constant, and brighter from one side.
Sh<Vec3> constantLight(const Vec3& radiance) {
    return projectSh([&](const Vec3&) { return radiance; });
}
Vec3 gradient(const Vec3& d) {
    return {1 + 0.8f * d.y, 1 + 0.5f * d.x, 1 - 0.6f * d.z};
}

std::vector<Vec3> applied(const PrtTransfer& transfer, const Sh<Vec3>& light) {
    std::vector<Vec3> irradiance(transfer.vertexCount);
    applyTransfer(transfer, light, irradiance);
    return irradiance;
}

/// A metre's box without a lid, of 16 quads a side.
Scene openBox(const Vec3& reflectance, float scale = 1) {
    test::SceneBuilder builder;
    const auto wall = builder.material("wall", reflectance);
    const Vec3 x(scale, 0, 0), y(0, scale, 0), z(0, 0, scale), o(0);
    builder.quad(o, z, x, wall);
    builder.quad(o, y, z, wall);
    builder.quad(x, z, y, wall);
    builder.quad(o, x, y, wall);
    builder.quad(z, y, x, wall);
    return subdivide(subdivide(builder.scene()));
}

/// Irradiance at a vertex by paths, which end outside the object.
class Paths {
  public:
    Paths(const ObjectMesh& mesh, std::function<Vec3(const Vec3&)> light)
        : mesh_(mesh), light_(std::move(light)) {}

    Vec3 irradiance(std::uint32_t triangle, int corner, int count) const {
        const Vec3 normal = geometricNormal(mesh_.scene, triangle);
        const Vec3 inside = positionAt(mesh_.scene, triangle, Vec2(1.0f / 3));
        const Vec3 from = glm::mix(mesh_.scene.position(triangle, corner), inside, 1e-3f);
        Vec3 sum(0);
        for (int i = 0; i < count; ++i) {
            RandomStream random(7, static_cast<std::uint64_t>(i));
            sum += kPi * path(from, normal, random);
        }
        return sum / static_cast<float>(count);
    }

  private:
    /// Radiance over π of a cosine-distributed direction.
    Vec3 path(Vec3 from, Vec3 normal, RandomStream& random) const {
        Vec3 throughput(1);
        for (int bounces = 0; bounces < 30; ++bounces) {
            const Vec3 d = frameFromNormal(normal).toWorld(sampleCosineHemisphere(random.next2()));
            const Ray ray{from + mesh_.rays.epsilon() * normal, d};
            const Hit hit = mesh_.rays.closest(ray);
            if (!hit) return throughput * light_(d);
            throughput *= mesh_.scene.material(hit.triangle).diffuse;
            normal = geometricNormal(mesh_.scene, hit.triangle);
            if (glm::dot(normal, d) > 0) normal = -normal;
            from = ray.origin + hit.t * d;
        }
        return Vec3(0);
    }

    const ObjectMesh& mesh_;
    std::function<Vec3(const Vec3&)> light_;
};

TEST(PrtTransfer, ConvexBodyInConstantLightHasPiTimesItsRadiance) {
    for (const char* name : {"cube", "sphere"}) {
        const ObjectMesh mesh(makePrimitive(name, {}));
        for (const Vec3& e : applied(computeTransfer(mesh, {}), constantLight({1, 2, 3})))
            EXPECT_LT(glm::distance(e, kPi * Vec3(1, 2, 3)), 1e-4f) << name;
    }
}

TEST(PrtTransfer, ConvexBodyTakesTheCosineLobeOfAnyLight) {
    const ObjectMesh mesh(makePrimitive("sphere", {}));
    Sh<Vec3> light;
    RandomStream random(1, 0);
    for (Vec3& l : light) l = Vec3(random.next() - 0.5f);
    light[0] = Vec3(6);
    const std::vector<Vec3> irradiance = applied(computeTransfer(mesh, {}), light);
    for (std::size_t v = 0; v < irradiance.size(); ++v)
        EXPECT_NEAR(irradiance[v].x, shIrradiance(light, mesh.scene.normals[v]).x, 0.04f) << v;
}

TEST(PrtTransfer, LowerOrdersAreTheFirstFunctionsOfHigherOnes) {
    const ObjectMesh mesh(makePrimitive("cube", {}));
    const PrtTransfer full = computeTransfer(mesh, {.order = 5}),
                      low = computeTransfer(mesh, {.order = 3});
    for (std::size_t v = 0; v < full.vertexCount; ++v)
        for (int f = 0; f < shCount(3); ++f)
            EXPECT_EQ(full.coefficient(v, f), low.coefficient(v, f));
}

TEST(PrtTransfer, OpenBoxAgreesWithPathTracing) {
    for (const bool reflections : {false, true}) {
        const ObjectMesh mesh(subdivide(openBox({0.8f, 0.5f, 0.2f})));
        ASSERT_FALSE(mesh.closed);
        const PrtTransfer transfer = computeTransfer(mesh, {.reflections = reflections});
        const ObjectMesh black(subdivide(openBox(Vec3(0))));
        const Paths paths(reflections ? mesh : black, gradient);
        const std::vector<Vec3> irradiance = applied(transfer, projectSh(gradient));
        for (std::uint32_t t = 0; t < mesh.scene.triangles.size(); t += 32) {
            const Vec3 truth = paths.irradiance(t, 0, 4000);
            const Vec3 found = irradiance[mesh.scene.triangles[t].vertex[0]];
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(found[c], truth[c], 0.06f) << t << ' ' << c << ' ' << reflections;
        }
    }
}

TEST(PrtTransfer, BackSidesOfAnOpenMeshAreLitApart) {
    const ObjectMesh mesh(openBox(Vec3(0.5f)));
    const std::vector<Vec3> irradiance = applied(computeTransfer(mesh, {}), constantLight(Vec3(1)));
    const std::size_t vertices = mesh.scene.positions.size();
    ASSERT_EQ(irradiance.size(), 2 * vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        EXPECT_LT(irradiance[v].x, 0.97f * kPi);
        EXPECT_NEAR(irradiance[vertices + v].x, kPi, 1e-4f);
    }
}

TEST(PrtTransfer, WhiteBodiesInConstantLightHaveAllOfIt) {
    Material white;
    white.diffuse = Vec3(1);
    for (Scene scene : {openBox(Vec3(1)), makePrimitive("knot", white)}) {
        const ObjectMesh mesh(std::move(scene));
        for (const Vec3& e : applied(computeTransfer(mesh, {}), constantLight(Vec3(1))))
            EXPECT_NEAR(e.x, kPi, 0.01f * kPi);
    }
}

TEST(PrtTransfer, MirrorsOfTheObjectHandLightOn) {
    // Between perfect mirrors and the open every direction leads to the same radiance.
    test::SceneBuilder builder;
    const auto mirror = builder.material("mirror", Vec3(0), Vec3(0), Vec3(1));
    builder.quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, builder.material("floor", Vec3(0.5f)));
    builder.quad({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, mirror);
    const ObjectMesh mesh(builder.scene());
    const auto floorLight = [&](bool reflections) {
        return applied(computeTransfer(mesh, {.reflections = reflections}),
                       constantLight(Vec3(1)))[0]
            .x;
    };
    EXPECT_NEAR(floorLight(true), kPi, 0.01f);
    EXPECT_LT(floorLight(false), 0.7f * kPi);
}

TEST(PrtTransfer, LightOfTheObjectsOwnIsThereInTheDark) {
    test::SceneBuilder builder;
    builder.quad({-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, builder.material("floor", Vec3(0)));
    builder.quad({-5, 0.01f, -5}, {10, 0, 0}, {0, 0, 10},
                 builder.material("lamp", Vec3(0), Vec3(2)));
    const ObjectMesh mesh(subdivide(builder.scene()));
    const std::vector<Vec3> irradiance = applied(computeTransfer(mesh, {}), Sh<Vec3>{});
    std::size_t lit = 0;
    for (std::size_t v = 0; v < mesh.scene.positions.size(); ++v)
        if (glm::length(Vec2(mesh.scene.positions[v].x, mesh.scene.positions[v].z)) < 0.1f &&
            mesh.scene.positions[v].y == 0) {
            EXPECT_NEAR(irradiance[v].x, 2 * kPi, 0.02f);
            ++lit;
        }
    EXPECT_GT(lit, 0u);
}

TEST(PrtTransfer, DoesNotDependOnScale) {
    const Sh<Vec3> light = projectSh(gradient);
    const auto irradianceAt = [&](float scale) {
        return applied(computeTransfer(ObjectMesh(openBox(Vec3(0.5f), scale)), {}), light);
    };
    const std::vector<Vec3> metres = irradianceAt(1);
    for (const float scale : {1e-3f, 1e3f}) {
        const std::vector<Vec3> scaled = irradianceAt(scale);
        for (std::size_t v = 0; v < metres.size(); ++v)
            EXPECT_LT(glm::distance(scaled[v], metres[v]), 0.01f) << scale;
    }
}

TEST(PrtTransfer, IsTheSameWithAnyNumberOfThreads) {
    const ObjectMesh mesh(openBox(Vec3(0.5f)));
    const PrtTransfer many = computeTransfer(mesh, {});
    const ThreadLimit one(1);
    EXPECT_EQ(computeTransfer(mesh, {}).blocks, many.blocks);
}

TEST(PrtTransfer, LightThatDiffersAtTheCornersIsInterpolated) {
    const ObjectMesh mesh(makePrimitive("cube", {}));
    const PrtTransfer transfer = computeTransfer(mesh, {});
    std::array<Sh<Vec3>, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i] = constantLight(Vec3(i & 1, i >> 1 & 1, i >> 2 & 1));
    std::vector<Vec3> irradiance(transfer.vertexCount);
    applyTransfer(transfer, corners, irradiance);
    for (std::size_t v = 0; v < irradiance.size(); ++v)
        EXPECT_LT(glm::distance(irradiance[v], kPi * (mesh.scene.positions[v] + 0.5f)), 1e-4f);
    corners.fill(projectSh(gradient));
    applyTransfer(transfer, corners, irradiance);
    const std::vector<Vec3> same = applied(transfer, projectSh(gradient));
    for (std::size_t v = 0; v < irradiance.size(); ++v)
        EXPECT_LT(glm::distance(irradiance[v], same[v]), 1e-4f);
}

TEST(PrtTransfer, IrradianceIsNeverNegative) {
    const ObjectMesh mesh(makePrimitive("sphere", {}));
    const Vec3 lamp = glm::normalize(Vec3(1, 2, 3));
    Sh<Vec3> light;
    const Sh<float> basis = shBasis(lamp);
    for (int f = 0; f < kMaxShCount; ++f) light[f] = Vec3(basis[f]);
    for (const Vec3& e : applied(computeTransfer(mesh, {}), light))
        EXPECT_GE(std::min({e.x, e.y, e.z}), 0);
}

TEST(PrtStore, ObjectsOfOneModelShareATransfer) {
    PrtStore store;
    auto model = std::make_shared<const ObjectModel>(makePrimitive("cube", {}));
    const auto first = store.transfer(model, 0, {});
    EXPECT_EQ(store.transfer(model, 0, {}), first);
    EXPECT_NE(store.transfer(model, 1, {}), first);
    EXPECT_NE(store.transfer(model, 0, {.order = 2}), first);
    EXPECT_EQ(store.size(), 3u);
    model = std::make_shared<const ObjectModel>(makePrimitive("cube", {}));
    store.transfer(model, 0, {});
    EXPECT_EQ(store.size(), 1u) << "those of models that are gone are dropped";
}

}  // namespace
}  // namespace vlf
