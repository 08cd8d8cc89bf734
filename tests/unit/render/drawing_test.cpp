// Wireframes and diagrams, and the lines they are made of.

#include "baked_scene.h"
#include "support/analytic_scenes.h"
#include "vlf/base/error.h"
#include "vlf/render/cpu/camera_rays.h"
#include "vlf/render/cpu/line_layer.h"
#include "vlf/render/drawing/mesh_edges.h"
#include "vlf/render/cpu/projection.h"
#include "vlf/render/cpu/wireframe.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace vlf {
namespace {

using namespace test;

const Camera kCamera{"test", {1, 2, 3}, {0, 1, -4}, {0, 1, 0}, 60};

TEST(Projection, IsTheInverseOfTheCameraRays) {
    const CameraRays rays(kCamera, 64, 48);
    const Projection projection(kCamera, 64, 48);
    for (const Vec2& at : {Vec2(32, 24), Vec2(0, 0), Vec2(60.5f, 3.25f)}) {
        const Ray ray = rays.ray(at.x, at.y);
        const auto point = projection.project(ray.origin + 7.0f * ray.direction);
        ASSERT_TRUE(point);
        EXPECT_LT(glm::distance(point->position, at), 1e-3f);
        EXPECT_LT(glm::distance(projection.unproject(at, point->depth),
                                ray.origin + 7.0f * ray.direction),
                  1e-4f);
        EXPECT_FALSE(projection.project(ray.origin - ray.direction));
    }
}

TEST(Projection, CutsSegmentsToThePicture) {
    const Camera camera{"test", Vec3(0), {0, 0, -1}, {0, 1, 0}, 90};
    const Projection projection(camera, 100, 100);
    EXPECT_FALSE(projection.project({-1, 0, 1}, {1, 0, 2}));
    EXPECT_FALSE(projection.project({5, 0, -1}, {5, 3, -1}));
    const auto across = projection.project({-50, 0, -1}, {50, 0, -1});
    ASSERT_TRUE(across);
    EXPECT_NEAR(across->from.position.x, -4, 0.01);
    EXPECT_NEAR(across->to.position.x, 104, 0.01);
    const auto throughTheEye = projection.project({0.5f, 0, -1}, {0.5f, 0, 10});
    ASSERT_TRUE(throughTheEye);
    EXPECT_NEAR(throughTheEye->from.position.x, 75, 0.01);
    EXPECT_LE(throughTheEye->to.position.x, 104.01);
}

TEST(Projection, DepthAlongASegmentIsThatOfItsPoints) {
    const Camera camera{"test", Vec3(0), {0, 0, -1}, {0, 1, 0}, 90};
    const Projection projection(camera, 100, 100);
    const Vec3 a(-0.5f, 0.1f, -1), b(1, 0.4f, -4);
    const auto segment = projection.project(a, b);
    ASSERT_TRUE(segment);
    const Vec3 p = projection.unproject(segment->at(0.5f), segment->depthAt(0.5f));
    const float t = (p.x - a.x) / (b.x - a.x);
    EXPECT_LT(glm::distance(p, glm::mix(a, b, t)), 1e-4f);
    EXPECT_GT(t, 0);
    EXPECT_LT(t, 0.5f);
}

double inkOf(const LineLayer& layer, int size) {
    Image image(size, size);
    layer.drawOn(image, Vec3(1));
    double sum = 0;
    for (const Vec3& p : image.pixels) sum += p.x;
    return sum;
}

TEST(LineLayer, InkIsLengthTimesThickness) {
    for (const Vec2& to : {Vec2(80.2f, 20.3f), Vec2(20.3f, 85), Vec2(70, 71), Vec2(75, 40)}) {
        const Vec2 from(20.3f, 20.3f);
        LineLayer layer(100, 100);
        layer.line(from, to, 1.5f, 1);
        EXPECT_NEAR(inkOf(layer, 100), 1.5 * glm::distance(from, to), 4) << to.x << " " << to.y;
    }
}

TEST(LineLayer, StrokesDoNotAddUpWhereTheyMeet) {
    LineLayer whole(60, 60), pieces(60, 60);
    whole.line({5, 7}, {55, 40}, 1.2f, 0.6f);
    for (int i = 0; i < 10; ++i)
        pieces.line(glm::mix(Vec2(5, 7), Vec2(55, 40), i / 10.0f),
                    glm::mix(Vec2(5, 7), Vec2(55, 40), (i + 1) / 10.0f), 1.2f, 0.6f);
    EXPECT_NEAR(inkOf(pieces, 60), inkOf(whole, 60), 0.01);
}

TEST(LineLayer, LinesOutsideLeaveNoInk) {
    LineLayer layer(20, 20);
    layer.line({-50, -3}, {100, -3}, 1.2f, 1);
    layer.dot({1e12f, -1e12f}, 5, 1);
    EXPECT_EQ(inkOf(layer, 20), 0);
}

int creaseCount(const std::vector<MeshEdge>& edges) {
    return static_cast<int>(
        std::count_if(edges.begin(), edges.end(), [](const MeshEdge& e) { return e.crease; }));
}

TEST(MeshEdges, BoxHasTwelveCreasesAndSixDiagonals) {
    SceneBuilder b;
    b.box(Vec3(0), Vec3(1, 2, 3), false, b.material("box", Vec3(0.5f)));
    const std::vector<MeshEdge> edges = meshEdges(b.scene());
    EXPECT_EQ(edges.size(), 18u);
    EXPECT_EQ(creaseCount(edges), 12);
}

TEST(MeshEdges, SmoothSphereHasNoCreaseButAContour) {
    SceneBuilder b;
    b.sphere(Vec3(0), 1, 2, false, b.material("ball", Vec3(0.5f)));
    const std::vector<MeshEdge> edges = meshEdges(b.scene());
    EXPECT_EQ(edges.size(), b.scene().triangles.size() * 3 / 2);
    EXPECT_EQ(creaseCount(edges), 0);
    const auto contours = std::count_if(edges.begin(), edges.end(), [](const MeshEdge& e) {
        return e.isContour({10, 3, 5});
    });
    EXPECT_GT(contours, 10);
    EXPECT_LT(contours, 60);
}

TEST(MeshEdges, MaterialsMeetInACrease) {
    SceneBuilder b;
    b.quad(Vec3(0), {1, 0, 0}, {0, 1, 0}, b.material("left", Vec3(0.5f)));
    b.quad({1, 0, 0}, {1, 0, 0}, {0, 1, 0}, b.material("right", Vec3(0.5f)));
    EXPECT_EQ(creaseCount(meshEdges(b.scene())), 7);
}

/// Part of the pixels whose luminance lies in [lower, upper).
double fraction(const Image& image, float lower, float upper) {
    const auto n = std::count_if(image.pixels.begin(), image.pixels.end(), [&](const Vec3& p) {
        return luminance(p) >= lower && luminance(p) < upper;
    });
    return static_cast<double>(n) / static_cast<double>(image.pixels.size());
}

TEST(Wireframe, IsThinLinesOnPaper) {
    const Image image =
        render(evenlyLit(smallCornell(), Vec3(1)), 320, 240, DisplayMode::wireframe);
    EXPECT_GT(fraction(image, 0, 0.5f), 0.005);
    EXPECT_LT(fraction(image, 0, 0.5f), 0.08);
    EXPECT_GT(fraction(image, luminance(kPaper) - 1e-4f, 1), 0.85);
}

/// A square far behind a larger one, seen frontally.
BakedScene hiddenSquare() {
    SceneBuilder b;
    const std::uint32_t grey = b.material("grey", Vec3(0.5f));
    b.quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, grey);
    b.quad({-0.5f, -0.5f, -1}, {1, 0, 0}, {0, 1, 0}, grey);
    b.camera("front", {0, 0, 3}, {0, 0, 0}, 50);
    return evenlyLit(b.scene(), Vec3(1));
}

TEST(Wireframe, HiddenLinesAreFaint) {
    const BakedScene scene = hiddenSquare();
    const Image image = render(scene, 200, 200, DisplayMode::wireframe);
    const Projection projection(scene.scene.cameras.front(), 200, 200);
    const auto darkestNear = [&](const Vec3& p) {
        const Vec2 at = projection.project(p)->position;
        float darkest = 1;
        for (int y = static_cast<int>(at.y) - 2; y <= at.y + 2; ++y)
            for (int x = static_cast<int>(at.x) - 2; x <= at.x + 2; ++x)
                darkest = std::min(darkest, luminance(image.at(x, y)));
        return darkest;
    };
    const float paper = luminance(kPaper);
    EXPECT_LT(darkestNear({1, 0.4f, 0}), 0.4f * paper);
    EXPECT_GT(darkestNear({0.5f, 0.2f, -1}), 0.8f * paper);
    EXPECT_LT(darkestNear({0.5f, 0.2f, -1}), 0.99f * paper);
    EXPECT_EQ(darkestNear({0.7f, 0.8f, 0}), paper);
}

TEST(Wireframe, NormalsAreDrawnOnDemand) {
    const BakedScene room = evenlyLit(smallCornell(), Vec3(1));
    StillParams params = stillParams(room.scene.cameras.front(), 200, 200, DisplayMode::wireframe);
    const auto orange = [&] {
        const Image image = render(room, params);
        return std::count_if(image.pixels.begin(), image.pixels.end(),
                             [](const Vec3& p) { return p.x > 2 * p.z; });
    };
    EXPECT_EQ(orange(), 0);
    params.normals = true;
    EXPECT_GT(orange(), 50);
}

Image diagram(const BakedScene& scene, const DiagramParams& diagram) {
    StillParams params = stillParams(scene.scene.cameras.front(), 160, 120, DisplayMode::diagram);
    params.diagram = diagram;
    return render(scene, params);
}

std::size_t pixelsThatDiffer(const Image& a, const Image& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i];
    return count;
}

TEST(Diagram, EveryKindShowsSomethingElse) {
    const BakedScene room = evenlyLit(smallCornell(), Vec3(1));
    std::vector<Image> images;
    for (const DiagramKind kind :
         {DiagramKind::directions, DiagramKind::subfield, DiagramKind::tile, DiagramKind::chart}) {
        images.push_back(diagram(room, {kind, {}, {}, {}, {}}));
        for (const Vec3& p : images.back().pixels) {
            ASSERT_TRUE(isFinite(p));
            ASSERT_GE(std::min({p.x, p.y, p.z}), 0);
            ASSERT_LE(maxComponent(p), 1.001f);
        }
        EXPECT_LT(fraction(images.back(), 0, 0.02f), 0.8);
        for (std::size_t i = 0; i + 1 < images.size(); ++i)
            EXPECT_GT(pixelsThatDiffer(images[i], images.back()), 1000u);
    }
}

TEST(Diagram, SphereOfDirectionsFillsItsPartOfThePicture) {
    const BakedScene room = evenlyLit(smallCornell(), Vec3(1));
    const Image image = diagram(room, {DiagramKind::directions, {}, {}, {}, {}});
    // Three quarters of the height: a disc of 90 pixels in 160 x 120.
    EXPECT_NEAR(fraction(image, 0.3f, 1), kPi * 45 * 45 / (160 * 120), 0.15);
}

TEST(Diagram, ChartColoursOneChartOnly) {
    const BakedScene room = evenlyLit(smallCornell(), Vec3(1));
    // The back wall, mesh 2, is seen in the middle.
    const std::uint32_t back = room.field.triangleCharts[room.scene.meshes[2].firstTriangle].front;
    const std::uint32_t red = room.field.triangleCharts[room.scene.meshes[3].firstTriangle].front;
    const Image middle = diagram(room, {DiagramKind::chart, {}, {}, {}, {}});
    EXPECT_EQ(pixelsThatDiffer(middle, diagram(room, {DiagramKind::chart, {}, {}, {}, back})), 0u);
    const Image other = diagram(room, {DiagramKind::chart, {}, {}, {}, red});
    // Uniform irradiance is the brightest there is: pale yellow.
    EXPECT_GT(luminance(middle.at(80, 55)), 4 * luminance(other.at(80, 55)));
}

TEST(Diagram, RefusesWhatTheFieldDoesNotHave) {
    BakedScene room = evenlyLit(smallCornell(), Vec3(1));
    const std::uint32_t charts = static_cast<std::uint32_t>(room.field.charts.size());
    EXPECT_THROW(diagram(room, {DiagramKind::chart, {}, {}, {}, charts}), InputError);
    EXPECT_NO_THROW(diagram(room, {DiagramKind::tile, 257, 7, 7, {}}));
    EXPECT_THROW(diagram(room, {DiagramKind::tile, 258, 7, 7, {}}), InputError);
    EXPECT_THROW(diagram(room, {DiagramKind::tile, 0, 8, 7, {}}), InputError);
    EXPECT_THROW(diagram(room, {DiagramKind::subfield, 0, 7, 8, {}}), InputError);
    room.field.record.cells = 1 << 30;
    EXPECT_THROW(diagram(room, {DiagramKind::subfield, {}, {}, {}, {}}), InputError);
    room.field.record = {};
    EXPECT_THROW(diagram(room, {DiagramKind::directions, {}, {}, {}, {}}), InputError);
    EXPECT_THROW(diagram(room, {DiagramKind::tile, {}, {}, {}, {}}), InputError);
}

}  // namespace
}  // namespace vlf
