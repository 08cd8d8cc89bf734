#include "vlf/math/frame.h"

#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

void expectRightHandedOrthonormal(const Frame& f) {
    EXPECT_NEAR(glm::length(f.tangent), 1, 1e-5f);
    EXPECT_NEAR(glm::length(f.bitangent), 1, 1e-5f);
    EXPECT_NEAR(glm::dot(f.tangent, f.bitangent), 0, 1e-5f);
    EXPECT_LT(glm::distance(glm::cross(f.tangent, f.bitangent), f.normal), 1e-5f);
}

TEST(Frame, IsRightHandedAndOrthonormalAroundAnyNormal) {
    RandomStream random(1, 0);
    for (int i = 0; i < 10000; ++i)
        expectRightHandedOrthonormal(frameFromNormal(sampleUniformSphere(random.next2())));
    for (const Vec3& n : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, -1, 0),
                          Vec3(1, 0, -0.0f), Vec3(0, 1e-20f, -1)})
        expectRightHandedOrthonormal(frameFromNormal(n));
}

TEST(Frame, ToLocalUndoesToWorld) {
    RandomStream random(2, 0);
    for (int i = 0; i < 1000; ++i) {
        const Frame frame = frameFromNormal(sampleUniformSphere(random.next2()));
        const Vec3 v = sampleUniformSphere(random.next2());
        EXPECT_LT(glm::distance(frame.toLocal(frame.toWorld(v)), v), 1e-5f);
    }
}

TEST(Frame, ThirdAxisIsTheNormal) {
    const Vec3 n = glm::normalize(Vec3(1, 2, -3));
    EXPECT_LT(glm::distance(frameFromNormal(n).toWorld({0, 0, 1}), n), 1e-6f);
}

}  // namespace
}  // namespace vlf
