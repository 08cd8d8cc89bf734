#include "vlf/dynamic/object_model.h"
#include "vlf/base/error.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/scene/generate/primitives.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace vlf {
namespace {

TEST(ObjectModel, PrimitivesAreClosedAndOneMetreWide) {
    for (const std::string& name : primitiveNames()) {
        const ObjectModel model(makePrimitive(name, {}));
        EXPECT_TRUE(model.mesh().closed) << name;
        const Vec3 size = boundsOf(model.scene()).size();
        EXPECT_NEAR(maxComponent(size), 1, 1e-4f) << name;
    }
}

TEST(ObjectModel, AMeshWithoutATriangleIsOpen) {
    Scene cube = makePrimitive("cube", {});
    cube.triangles.pop_back();
    EXPECT_FALSE(ObjectModel(cube).mesh().closed);
}

TEST(ObjectModel, IsConvexWhereNoPartHidesAnother) {
    EXPECT_TRUE(ObjectModel(makePrimitive("cube", {})).convex());
    EXPECT_TRUE(ObjectModel(makePrimitive("sphere", {})).convex());
    EXPECT_FALSE(ObjectModel(makePrimitive("knot", {})).convex());
    Scene cube = makePrimitive("cube", {});
    for (Triangle& t : cube.triangles) std::swap(t.vertex[0], t.vertex[1]);
    EXPECT_TRUE(ObjectModel(cube).convex());  // inside out
    cube.triangles.pop_back();
    EXPECT_FALSE(ObjectModel(cube).convex());
}

TEST(ObjectModel, PatchesFaceAnyDirectionAsMuchAsItsSurfaceDoes) {
    const ObjectModel model(makePrimitive("knot", {}));
    double off2 = 0, off = 0;
    constexpr int kDirections = 64;
    for (std::uint32_t k = 0; k < kDirections; ++k) {
        const Vec3 direction = sampleUniformSphere(r2Point(k, Vec2(0.5f)));
        double patches = 0, surface = 0;
        for (const SurfacePatch& p : model.patches())
            patches += model.patchArea() * std::max(0.0f, glm::dot(p.normal, direction));
        for (std::uint32_t t = 0; t < model.scene().triangles.size(); ++t)
            surface += area(model.scene(), t) *
                       std::max(0.0f, glm::dot(geometricNormal(model.scene(), t), direction));
        off += patches / surface - 1;
        off2 += std::pow(patches / surface - 1, 2);
    }
    EXPECT_LT(std::abs(off) / kDirections, 0.03);
    EXPECT_LT(std::sqrt(off2 / kDirections), 0.06);
}

TEST(ObjectModel, SubdivisionKeepsTheSurface) {
    const ObjectModel model(makePrimitive("cube", {}));
    const auto totalArea = [](const Scene& scene) {
        float sum = 0;
        for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) sum += area(scene, t);
        return sum;
    };
    for (int level = 0; level <= ObjectModel::kMaxSubdivision; ++level) {
        const ObjectMesh& mesh = model.mesh(level);
        EXPECT_EQ(mesh.scene.triangles.size(), std::size_t{12} << (2 * level));
        // Both triangles of a face and its four sides: (2^l + 1)^2 vertices a face.
        EXPECT_EQ(mesh.scene.positions.size(), 6u * ((1u << level) + 1) * ((1u << level) + 1));
        EXPECT_NEAR(totalArea(mesh.scene), 6, 1e-4f);
        EXPECT_TRUE(mesh.closed);
    }
}

TEST(ObjectModel, NothingIsNoObject) {
    EXPECT_THROW(ObjectModel(Scene{}), InputError);
}

TEST(ObjectModel, HasPatchesThatTogetherAreAsLargeAsItsSilhouette) {
    for (const std::string name : {"cube", "sphere"}) {
        const ObjectModel model(makePrimitive(name, {}));
        for (const Vec3& eye : {Vec3(0, 0, 1), Vec3(0.6f, 0.8f, 0), Vec3(0.48f, -0.6f, 0.64f)}) {
            const float truth =
                name == "cube" ? std::abs(eye.x) + std::abs(eye.y) + std::abs(eye.z) : 0.25f * kPi;
            for (const std::size_t step : {1u, 2u, 4u}) {
                float silhouette = 0;
                for (std::size_t k = step / 2; k < model.patches().size(); k += step)
                    silhouette += std::max(0.0f, glm::dot(model.patches()[k].normal, eye)) *
                                  model.patchArea() * static_cast<float>(step);
                EXPECT_NEAR(silhouette / truth, 1, 0.1f) << name;
            }
        }
    }
}

}  // namespace
}  // namespace vlf
