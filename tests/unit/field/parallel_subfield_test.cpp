#include "vlf/field/parallel_subfield.h"

#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

constexpr int kCells = 64;
const FieldFrame kFrame{{3, -2, 5}, 2.5f};

struct RandomSubfield {
    ParallelSubfield subfield;
    Vec3 point;  ///< in the frame's sphere

    explicit RandomSubfield(std::uint64_t key) {
        RandomStream random(1, key);
        const Vec3 direction = sampleUniformSphere(random.next2());
        const float roll = 2 * kPi * random.next();
        subfield = makeSubfield(kFrame, direction, kCells, roll, random.next2());
        point = kFrame.centre + kFrame.radius * random.next() * sampleUniformSphere(random.next2());
    }
};

TEST(ParallelSubfield, GridCoversTheSphereWithAnyRollAndJitter) {
    for (int i = 0; i < 10000; ++i) {
        const RandomSubfield r(i);
        const Vec2 cell = r.subfield.cellCoordinates(r.point);
        for (int k = 0; k < 2; ++k) {
            EXPECT_GE(cell[k], -1e-4f);
            EXPECT_LE(cell[k], kCells + 1e-4f);
        }
    }
}

TEST(ParallelSubfield, MovingAlongTheDirectionChangesDepthOnly) {
    for (int i = 0; i < 1000; ++i) {
        const RandomSubfield r(i);
        const Vec3 moved = r.point + 0.75f * r.subfield.direction;
        const Vec2 shift = r.subfield.cellCoordinates(moved) - r.subfield.cellCoordinates(r.point);
        EXPECT_NEAR(glm::length(shift), 0, 1e-3f);
        EXPECT_NEAR(r.subfield.depth(moved) - r.subfield.depth(r.point), 0.75f, 1e-5f);
    }
}

TEST(ParallelSubfield, CellsAreSquareAndEvenlySpaced) {
    const float cellsPerMetre = (kCells - 1) / (2 * kFrame.radius);
    for (int i = 0; i < 100; ++i) {
        const ParallelSubfield s = RandomSubfield(i).subfield;
        EXPECT_NEAR(glm::length(s.xAxis), cellsPerMetre, 1e-4f);
        EXPECT_NEAR(glm::length(s.yAxis), cellsPerMetre, 1e-4f);
        EXPECT_NEAR(glm::dot(s.xAxis, s.yAxis), 0, 1e-3f);
        EXPECT_GT(glm::dot(glm::cross(s.xAxis, s.yAxis), s.direction), 0);
    }
}

TEST(ParallelSubfield, DepthIsZeroWhereTheDirectionEntersTheSphere) {
    const Vec3 direction = glm::normalize(Vec3(1, 2, -2));
    const ParallelSubfield s = makeSubfield(kFrame, direction, kCells);
    EXPECT_NEAR(s.depth(kFrame.centre - kFrame.radius * direction), 0, 1e-5f);
    EXPECT_NEAR(s.depth(kFrame.centre + kFrame.radius * direction), 2 * kFrame.radius, 1e-5f);
}

}  // namespace
}  // namespace vlf
