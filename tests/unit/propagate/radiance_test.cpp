#include "vlf/propagate/radiance_bake.h"

#include "support/analytic_scenes.h"
#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/field/direction_set.h"
#include "vlf/math/microfacet.h"
#include "vlf/math/random.h"
#include "vlf/propagate/bake.h"
#include "vlf/propagate/mirror_view.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <utility>

#include <gtest/gtest.h>

namespace vlf {
namespace {

constexpr float kIrradiance = 2;
constexpr float kAlbedo = 0.5f, kMirror = 0.75f;
constexpr float kWallRadiance = kAlbedo * kIrradiance / kPi;
constexpr RadianceParams kParams{.lines = 33, .cells = 40, .tileSize = 8};

/// A room of 2 x 2 x 2 m about the origin of which some walls (in the order -x +x -y +y -z +z) are
/// mirrors; +z shines so faintly that it only matters as a source.
test::SceneBuilder roomWithMirrors(std::initializer_list<int> walls) {
    test::SceneBuilder b;
    const std::uint32_t white = b.material("white", Vec3(kAlbedo));
    const std::uint32_t mirror = b.material("mirror", Vec3(0), Vec3(0), Vec3(kMirror));
    const std::uint32_t lamp = b.material("lamp", Vec3(kAlbedo), Vec3(1e-6f));
    b.box(Vec3(-1), Vec3(1), true, white);
    for (const int i : {10, 11}) b.scene().triangles[i].material = lamp;
    for (const int wall : walls)
        for (const int i : {2 * wall, 2 * wall + 1}) b.scene().triangles[i].material = mirror;
    return b;
}

/// The scene's charts, all of them lit by the same irradiance.
LightField evenlyLit(const Scene& scene) {
    BakeParams params;
    params.texelBudget = 500;
    params.radianceDirections = params.glossDirections = 0;
    Progress progress;
    BakeState state = makeState(scene, params, progress);
    LightField field = finish(state, progress);
    for (Vec3& e : field.atlas.irradiance) e = Vec3(kIrradiance);
    return field;
}

RadianceField bakeRoom(const Scene& scene, const RadianceParams& params = kParams) {
    Progress progress;
    return bakeRadiance(scene, RayScene(scene), evenlyLit(scene), params, progress);
}

FieldFrame frameOf(const Scene& scene) {
    const Sphere sphere = boundingSphere(scene);
    return {sphere.centre, sphere.radius};
}

/// A cell of a direction and what it stores.
struct Stored {
    Vec3 toEye;
    Vec2 centre;  ///< cell coordinates
    ParallelSubfield subfield;
    RadianceElement element;
};

template <class Visit>
void forEachCell(const RadianceField& field, const FieldFrame& frame, const Visit& visit) {
    const DirectionSet directions(field.lines);
    const int m = field.tileSize;
    for (std::uint32_t d = 0; d < 2u * static_cast<unsigned>(field.lines); ++d) {
        const auto line = d % static_cast<unsigned>(field.lines);
        const ParallelSubfield s = makeSubfield(frame, directions.direction(line), field.cells);
        for (const TileRow& row : field.rowsOf(d))
            for (int y = row.tileY * m; y < (row.tileY + 1) * m; ++y)
                for (int x = row.tileX * m; x < (row.tileX + row.tilesWide) * m; ++x)
                    visit(Stored{directions.direction(d), Vec2(x, y) + 0.5f, s,
                                 *field.element({&row, 1}, x, y)});
    }
}

/// Where the ray of a cell meets the wall `axis` = -1.
Vec3 pointOnWall(const Stored& cell, int axis) {
    const ParallelSubfield& s = cell.subfield;
    const Vec2 c = (cell.centre - Vec2(s.xOffset, s.yOffset)) / glm::dot(s.xAxis, s.xAxis);
    const Vec3 p = c.x * s.xAxis + c.y * s.yAxis;
    return p + s.direction * ((-1 - p[axis]) / s.direction[axis]);
}

bool isWithinRoom(const Vec3& p) {
    return maxComponent(glm::abs(p)) < 1.0001f;
}

/// Length of the path of light from p on a wall to the first wall that is no mirror, and how many
/// mirrors there are on it.
struct Path {
    float length = 0;
    int reflections = 1;
};

Path followPath(Vec3 p, Vec3 direction, std::initializer_list<int> mirrorAxes) {
    Path path;
    for (;;) {
        Vec3 time(1e9f);
        for (int a = 0; a < 3; ++a)
            if (std::abs(direction[a]) > 1e-6f)
                time[a] = ((direction[a] > 0 ? 1 : -1) - p[a]) / direction[a];
        const int axis = time.x < time.y ? (time.x < time.z ? 0 : 2) : (time.y < time.z ? 1 : 2);
        p += time[axis] * direction;
        path.length += time[axis];
        const bool mirror =
            std::find(mirrorAxes.begin(), mirrorAxes.end(), axis) != mirrorAxes.end() &&
            direction[axis] < 0;
        if (!mirror) return path;
        direction[axis] = -direction[axis];
        ++path.reflections;
    }
}

TEST(RadianceField, AnEvenlyLitRoomIsEvenInItsRoughMirror) {
    for (const float roughness : {0.05f, 0.3f}) {
        test::SceneBuilder b = roomWithMirrors({0});
        b.scene().materials[1].roughness = roughness;
        RadianceParams params = kParams;
        params.kind = MirrorKind::rough;
        params.gloss = {64, 8};
        EXPECT_TRUE(bakeRoom(b.scene()).empty()) << "it is no perfect one";
        int filled = 0;
        double error = 0;
        forEachCell(bakeRoom(b.scene(), params), frameOf(b.scene()), [&](const Stored& cell) {
            if (cell.element.distance == 0) return;
            ++filled;
            // Rays along the mirror meet other walls, not the mirror: all see the same radiance.
            const float expected = kMirror * ggxAlbedo(roughness, cell.toEye.x) * kWallRadiance;
            error += unpackRgb9e5(cell.element.rgb9e5()).x / expected - 1;
        });
        EXPECT_GT(filled, 1000);
        EXPECT_NEAR(error / filled, 0, 0.01) << roughness;
    }
}

TEST(RadianceField, RoughMirrorsShowSmallLampsWithoutBias) {
    // By points on the lamp and by rays that meet it: each alone would give the same mean.
    test::SceneBuilder b = roomWithMirrors({0});
    b.scene().materials[1].roughness = 0.2f;
    b.quad({0.5f, -0.1f, -0.1f}, {0, 0, 0.2f}, {0, 0.2f, 0},
           b.material("bulb", Vec3(0), Vec3(300)));
    const auto meanOf = [&](const GlossSamples& samples) {
        RadianceParams params = kParams;
        params.kind = MirrorKind::rough;
        params.cells = 24;
        params.gloss = samples;
        double sum = 0;
        int filled = 0;
        forEachCell(bakeRoom(b.scene(), params), frameOf(b.scene()), [&](const Stored& cell) {
            if (cell.element.distance == 0) return;
            sum += unpackRgb9e5(cell.element.rgb9e5()).x;
            ++filled;
        });
        return sum / filled;
    };
    const double truth = meanOf({1024, 0});
    EXPECT_GT(truth, 1.5 * kMirror * kWallRadiance) << "the lamp matters";
    EXPECT_NEAR(meanOf({16, 8}), truth, 0.02 * truth);
}

TEST(RadianceField, AnEvenlyLitRoomIsEvenInItsMirror) {
    const Scene scene = roomWithMirrors({0}).scene();
    int filled = 0;
    forEachCell(bakeRoom(scene), frameOf(scene), [&](const Stored& cell) {
        if (cell.element.distance == 0) return;
        ++filled;
        const Vec3 radiance = unpackRgb9e5(cell.element.rgb9e5());
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(radiance[c], kMirror * kWallRadiance, kWallRadiance / 512);
    });
    EXPECT_GT(filled, 33 * 150);
}

TEST(RadianceField, DistancesInAFlatMirrorAreThoseOfTheReflectedRays) {
    const Scene scene = roomWithMirrors({0}).scene();
    const RadianceField field = bakeRoom(scene);
    int checked = 0;
    forEachCell(field, frameOf(scene), [&](const Stored& cell) {
        if (cell.toEye.x < 0.05f) {
            // At no more than grazing angles there is nothing, at -x the mirror's back.
            ASSERT_TRUE(cell.toEye.x > 0 || cell.element.distance == 0);
            return;
        }
        const Vec3 p = pointOnWall(cell, 0);
        if (!isWithinRoom(p)) return;
        const Path path = followPath(p, cell.toEye * Vec3(1, -1, -1), {});
        ASSERT_NEAR(static_cast<float>(cell.element.distance) / 65535 * field.maxDistance,
                    path.length, field.maxDistance / 65535 + 1e-3f);
        ++checked;
    });
    EXPECT_GT(checked, 33 * 100);
}

TEST(RadianceField, MirrorsInMirrorsUnfoldThePathOfLight) {
    const Scene scene = roomWithMirrors({0, 2}).scene();  // -x and -y: a corner of mirrors
    const RadianceField field = bakeRoom(scene);
    int twice = 0;
    forEachCell(field, frameOf(scene), [&](const Stored& cell) {
        const Vec3 p = pointOnWall(cell, 0);
        const bool onMirrorX = cell.toEye.x > 0.1f && std::abs(cell.toEye.y) > 0.1f &&
                               isWithinRoom(p) && p.y > -0.9f && p.y < 0.9f;
        if (!onMirrorX || cell.element.distance == 0) return;
        const Path path = followPath(p, cell.toEye * Vec3(1, -1, -1), {0, 1});
        const float length = static_cast<float>(cell.element.distance) / 65535 * field.maxDistance;
        // Cells of the other mirror, which lies behind, are told apart by their distance.
        if (std::abs(length - path.length) > 2e-3f) return;
        if (path.reflections < 2) return;
        ++twice;
        ASSERT_NEAR(unpackRgb9e5(cell.element.rgb9e5()).y, kMirror * kMirror * kWallRadiance,
                    kWallRadiance / 512);
    });
    EXPECT_GT(twice, 500);
}

TEST(RadianceField, EveryPointOfAMirrorLiesBetweenFourCells) {
    const Scene scene = roomWithMirrors({0}).scene();
    const RadianceField field = bakeRoom(scene);
    const FieldFrame frame = frameOf(scene);
    const DirectionSet directions(field.lines);
    RandomStream random(1, 0);
    for (std::uint32_t d = 0; d < 66; ++d) {
        if (directions.direction(d).x < 0.01f) continue;
        const auto rows = field.rowsOf(d, field.rows[0].chart);
        const ParallelSubfield s = makeSubfield(frame, directions.direction(d % 33), field.cells);
        for (int i = 0; i < 200; ++i) {
            Vec3 p(-1, 2 * random.next() - 1, 2 * random.next() - 1);
            if (i % 2) p[1 + i / 2 % 2] = i % 4 < 2 ? 1 : -1;  // on an edge
            const Vec2 c = glm::floor(s.cellCoordinates(p) - 0.5f);
            for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
                const int x = static_cast<int>(c.x) + dx, y = static_cast<int>(c.y) + dy;
                if (std::min(x, y) < 0 || std::max(x, y) >= field.cells) continue;
                const RadianceElement* e = field.element(rows, x, y);
                ASSERT_NE(e, nullptr);
                ASSERT_GT(e->distance, 0);
            }
        }
    }
}

TEST(RadianceField, CellsUnderAFrameShowTheFrame) {
    test::SceneBuilder b = roomWithMirrors({});
    const std::uint32_t mirror = b.material("panel", Vec3(0), Vec3(0), Vec3(kMirror));
    const std::uint32_t frame = b.material("frame", Vec3(0.1f));
    b.quad({-0.9f, -0.5f, -0.5f}, {0, 1, 0}, {0, 0, 1}, mirror);  // faces +x
    b.box({-1, 0.5f, -0.9f}, {-0.7f, 0.9f, 0.9f}, false, frame);  // above it
    const Scene scene = b.scene();
    const RadianceField field = bakeRoom(scene, {.lines = 33, .cells = 80, .tileSize = 8});
    int under = 0;
    forEachCell(field, frameOf(scene), [&](const Stored& cell) {
        // Seen from below, the mirror's upper edge shows the frame.
        if (cell.toEye.x < 0.3f || cell.toEye.y > -0.3f || cell.element.distance == 0) return;
        const Vec3 p = pointOnWall(cell, 0) + cell.toEye * (0.1f / cell.toEye.x);
        if (p.y < 0.505f || std::abs(p.z) > 0.45f) return;
        ++under;
        EXPECT_LT(static_cast<float>(cell.element.distance) / 65535 * field.maxDistance, 0.01f);
        EXPECT_NEAR(unpackRgb9e5(cell.element.rgb9e5()).x, kMirror * 0.1f * kIrradiance / kPi,
                    1e-3f);
    });
    EXPECT_GT(under, 20);
}

TEST(RadianceField, ACurvedMirrorShowsTheRoomInFrontOfIt) {
    test::SceneBuilder b = roomWithMirrors({});
    b.sphere(Vec3(0), 0.5f, 3, false, b.material("ball", Vec3(0), Vec3(0), Vec3(kMirror)));
    const Scene scene = b.scene();
    const RadianceField field = bakeRoom(scene);
    double filled = 0, sum = 0;
    forEachCell(field, frameOf(scene), [&](const Stored& cell) {
        if (cell.element.distance == 0) return;
        ASSERT_NEAR(unpackRgb9e5(cell.element.rgb9e5()).x, kMirror * kWallRadiance,
                    kWallRadiance / 256);
        // Images in a convex mirror lie before its focus, half the radius behind it.
        const float d = static_cast<float>(cell.element.distance) / 65535 * field.maxDistance;
        EXPECT_LT(d, 1.05f * 0.25f);
        ++filled;
        sum += d;
    });
    EXPECT_GT(filled, 66 * 50);
    EXPECT_GT(sum / filled, 0.02);
}

TEST(ImageDistance, IsThatOfTheMirrorEquation) {
    EXPECT_FLOAT_EQ(imageDistance(3, 0, 0.5f, 100), 3);
    EXPECT_NEAR(imageDistance(1e6f, 1 / 0.5f, 1, 100), 0.25f, 1e-5f);  // half the radius
    EXPECT_NEAR(imageDistance(1, 1 / 0.5f, 1, 100), 0.2f, 1e-5f);      // 1/d' = 1/d + 2/R
    EXPECT_FLOAT_EQ(imageDistance(1, -4, 1, 100), 100);                // a real image
}

TEST(RadianceField, DoesNotDependOnTheNumberOfThreads) {
    const Scene scene = roomWithMirrors({0, 2}).scene();
    const auto bakeWith = [&](int threads) {
        const ThreadLimit limit(threads);
        return bakeRoom(scene);
    };
    const RadianceField a = bakeWith(1), b = bakeWith(4);
    ASSERT_EQ(a.elements.size(), b.elements.size());
    EXPECT_EQ(a.firstRow, b.firstRow);
    EXPECT_EQ(std::memcmp(a.elements.data(), b.elements.data(),
                          a.elements.size() * sizeof(RadianceElement)),
              0);
}

BakeParams smallBake() {
    BakeParams params = presetParams("draft");
    params.texelBudget = 500;
    params.maxBounces = 1;
    params.cells = 64;
    params.radianceDirections = 33;
    params.radianceCells = 64;
    return params;
}

TEST(RadianceField, InAFileIsTheSame) {
    const Scene scene = test::mirrorBox();
    const BakeParams params = smallBake();
    Progress progress;
    const LightField inMemory = bake(scene, params, progress);
    const LightField inFile = bake(scene, params, progress, nullptr, unobserved,
                                   solutionIn({testing::TempDir(), 100}));
    const RadianceElements &a = inMemory.radiance.elements, &b = inFile.radiance.elements;
    ASSERT_EQ(a.size(), b.size());
    ASSERT_GT(a.size() * sizeof(RadianceElement), 100u);
    EXPECT_EQ(b.get_allocator().place()->largest, 100u);
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(RadianceElement)), 0);
}

TEST(RadianceField, OfARoomWithoutMirrorsIsEmpty) {
    EXPECT_TRUE(bakeRoom(roomWithMirrors({}).scene()).empty());
}

TEST(RadianceField, RefusesParametersItCannotUse) {
    const Scene scene = roomWithMirrors({0}).scene();
    for (const RadianceParams& p : {RadianceParams{100, 64, 8}, RadianceParams{33, 8, 8},
                                    RadianceParams{33, 64, 12}, RadianceParams{33, 64, 0}})
        EXPECT_THROW(bakeRoom(scene, p), InputError);
}

TEST(RadianceField, IsPartOfABakeOfARoomWithMirrors) {
    const Scene scene = test::mirrorBox();
    BakeParams params = smallBake();
    Progress progress;
    BakeReport report;
    const LightField field = bake(scene, params, progress, &report);
    EXPECT_EQ(field.radiance.lines, 33);
    EXPECT_EQ(field.record.radianceDirections, 33);
    EXPECT_EQ(field.record.radianceCells, 64);
    EXPECT_EQ(field.record.tileSize, params.tileSize);
    EXPECT_EQ(report.radianceElements, field.radiance.elements.size());
    EXPECT_EQ(report.stages.back().name, "radiance field");
    params.radianceDirections = 0;
    EXPECT_TRUE(bake(scene, params, progress).radiance.empty());
}

TEST(RadianceField, IsOfTheSizeThatWasForetold) {
    const Scene scene = roomWithMirrors({0, 2}).scene();
    const RadianceField field = bakeRoom(scene);
    EXPECT_EQ(radianceSize(scene, evenlyLit(scene), kParams).elements, field.elements.size());
}

}  // namespace
}  // namespace vlf
