// Mode diagram by OpenGL.

#include "open_gl.h"
#include "small_rooms.h"
#include "vlf/base/error.h"
#include "vlf/render/drawing/direction_ball.h"
#include "vlf/render/gl/read_framebuffer.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

constexpr DiagramKind kKinds[] = {DiagramKind::directions, DiagramKind::subfield, DiagramKind::tile,
                                  DiagramKind::chart};

StillParams diagramOf(const Camera& camera, DiagramKind kind) {
    StillParams params = stillOf(camera);
    params.mode = DisplayMode::diagram;
    params.diagram.kind = kind;
    return params;
}

std::size_t pixelsThatDiffer(const Image& a, const Image& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        count += maxComponent(glm::abs(a.pixels[i] - b.pixels[i])) > 1e-3f;
    return count;
}

}  // namespace

TEST(DirectionBall, HasEveryTriangleOfTheSetOnce) {
    for (const int lines : {129, 513, 2049}) {
        const DirectionSet set(lines);
        const std::vector<BallVertex> vertices = makeBall(set);
        std::set<std::array<std::uint32_t, 3>> triangles;
        double area = 0;
        for (std::size_t i = 0; i < vertices.size(); i += 3) {
            std::array<std::uint32_t, 3> corner = vertices[i].corner;
            std::sort(corner.begin(), corner.end());
            triangles.insert(corner);
            const Vec3 a = vertices[i].position, b = vertices[i + 1].position,
                       c = vertices[i + 2].position;
            const Vec3 normal = glm::cross(b - a, c - a);
            ASSERT_GT(glm::dot(normal, a), 0) << "counter-clockwise from outside";
            area += 0.5 * glm::length(normal);
        }
        EXPECT_EQ(triangles.size(), 2u * static_cast<unsigned>(set.directionCount()) - 4);
        EXPECT_NEAR(area, 4 * kPi, 0.02) << "no gap, no overlap";
    }
}

TEST(DirectionBall, WeightsAreThoseOfTheSetsOwnTriangles) {
    const DirectionSet set(129);
    for (const BallVertex& v : makeBall(set)) {
        const Vec3 sum = v.weight.x * set.direction(v.corner[0]) +
                         v.weight.y * set.direction(v.corner[1]) +
                         (1 - v.weight.x - v.weight.y) * set.direction(v.corner[2]);
        ASSERT_LT(glm::distance(glm::normalize(sum), v.position), 1e-5f);
    }
}

// The thin lines of the ball differ from themselves by 0.01 if the CPU takes more samples, of which
// it takes fewer where the GPU takes all.
TEST_F(OpenGl, DrawsDiagramsAsTheCpuDoes) {
    for (const DiagramKind kind : kKinds) {
        const StillParams params = diagramOf(mirrorRoom().camera("front"), kind);
        Progress progress;
        Renderer renderer(mirrorRoom().scene, mirrorRoom().field);
        const Image picture = renderStill(renderer, params, progress);
        const Image reference = renderStill(mirrorRoom().scene, mirrorRoom().rays,
                                            mirrorRoom().field, params, progress);
        EXPECT_LT(flip(picture, reference).mean, 0.015) << static_cast<int>(kind);
    }
}

TEST_F(OpenGl, EveryDiagramShowsSomethingElse) {
    Renderer renderer(mirrorRoom().scene, mirrorRoom().field);
    std::vector<Image> images;
    for (const DiagramKind kind : kKinds) {
        Progress progress;
        images.push_back(
            renderStill(renderer, diagramOf(mirrorRoom().camera("front"), kind), progress));
        for (std::size_t i = 0; i + 1 < images.size(); ++i)
            EXPECT_GT(pixelsThatDiffer(images[i], images.back()), 1000u);
    }
}

TEST_F(OpenGl, DrawsTheSelectedTileAndDirection) {
    Renderer renderer(mirrorRoom().scene, mirrorRoom().field);
    StillParams params = diagramOf(mirrorRoom().camera("front"), DiagramKind::tile);
    for (const auto& [direction, tile] : {std::pair{3u, 2u}, {40u, 5u}, {3u, 2u}}) {
        params.diagram.direction = direction;
        params.diagram.tileX = params.diagram.tileY = tile;
        Progress progress;
        const Image reference = renderStill(mirrorRoom().scene, mirrorRoom().rays,
                                            mirrorRoom().field, params, progress);
        EXPECT_LT(flip(renderStill(renderer, params, progress), reference).mean, 0.012);
    }
}

TEST_F(OpenGl, WalksAroundADiagram) {
    Renderer renderer(mirrorRoom().scene, mirrorRoom().field);
    const Target target(160, 120);
    for (const DiagramKind kind : kKinds) {
        RenderSettings settings;
        settings.mode = DisplayMode::diagram;
        settings.diagram.kind = kind;
        settings.diagramCamera = mirrorRoom().camera("front");
        std::vector<Image> images;
        for (const char* camera : {"front", "mirror"}) {
            renderer.draw(viewOf(mirrorRoom().camera(camera), 160, 120, renderer.nearest()),
                          settings, target.framebuffer.id());
            images.push_back(readFramebuffer(target.framebuffer.id(), 160, 120));
        }
        EXPECT_GT(pixelsThatDiffer(images[0], images[1]), 1000u) << static_cast<int>(kind);
    }
}

TEST_F(OpenGl, HangsTheBallWhereItIsTold) {
    Renderer renderer(mirrorRoom().scene, mirrorRoom().field);
    const Camera& camera = mirrorRoom().camera("front");
    const Target target(160, 120);
    RenderSettings settings;
    settings.mode = DisplayMode::diagram;
    const auto picture = [&](const std::optional<Sphere>& ball) {
        settings.ball = ball;
        renderer.draw(viewOf(camera, 160, 120, renderer.nearest()), settings,
                      target.framebuffer.id());
        return readFramebuffer(target.framebuffer.id(), 160, 120);
    };
    const Vec3 forward = glm::normalize(camera.look - camera.eye);
    const Image none = picture(Sphere{camera.eye - forward, 0.1f});
    const Image small = picture(Sphere{camera.eye + forward, 0.1f});
    const double radius = 60 / std::tan(0.5 * camera.verticalFov * kPi / 180) * 0.1;
    EXPECT_NEAR(static_cast<double>(pixelsThatDiffer(none, small)), kPi * radius * radius,
                0.1 * kPi * radius * radius);
    const Image beyondTheWall = picture(Sphere{camera.eye + 100.0f * forward, 1});
    EXPECT_EQ(pixelsThatDiffer(none, beyondTheWall), 0u) << "the room hides it";
    EXPECT_GT(pixelsThatDiffer(none, picture({})), 100u) << "in the middle of the room";
}

TEST_F(OpenGl, RefusesDiagramsOfWhatTheFieldDoesNotHave) {
    Renderer renderer(mirrorRoom().scene, mirrorRoom().field);
    Progress progress;
    StillParams params = diagramOf(mirrorRoom().camera("front"), DiagramKind::chart);
    params.diagram.chart = static_cast<std::uint32_t>(mirrorRoom().field.charts.size());
    EXPECT_THROW(renderStill(renderer, params, progress), InputError);
    params = diagramOf(mirrorRoom().camera("front"), DiagramKind::subfield);
    params.diagram.direction = 2 * static_cast<std::uint32_t>(mirrorRoom().field.record.directions);
    EXPECT_THROW(renderStill(renderer, params, progress), InputError);
    const Target target(64, 48);
    disturbState(target);
    const auto before = state();
    RenderSettings settings;
    settings.mode = DisplayMode::diagram;
    settings.diagram = params.diagram;
    settings.diagramCamera = params.camera;
    EXPECT_THROW(
        renderer.draw(viewOf(params.camera, 64, 48, 0.01f), settings, target.framebuffer.id()),
        InputError);
    EXPECT_EQ(state(), before) << "even then the state is the host's";
}

TEST_F(OpenGl, DrawingsLeaveTheStateOfTheirHostAsItWas) {
    Renderer renderer(mirrorRoom().scene, mirrorRoom().field);
    const Target target(64, 48);
    disturbState(target);
    const auto before = state();
    RenderSettings settings;
    settings.diagramCamera = mirrorRoom().camera("front");
    const auto draw = [&] {
        renderer.draw(viewOf(settings.diagramCamera, 64, 48, 0.01f), settings,
                      target.framebuffer.id());
    };
    settings.mode = DisplayMode::wireframe;
    settings.normals = true;
    draw();
    EXPECT_EQ(state(), before);
    settings.mode = DisplayMode::diagram;
    for (const DiagramKind kind : kKinds) {
        settings.diagram.kind = kind;
        draw();
        EXPECT_EQ(state(), before) << static_cast<int>(kind);
    }
}

TEST_F(OpenGl, CountsTheMemoryOfDrawings) {
    Renderer renderer(mirrorRoom().scene, mirrorRoom().field);
    const std::uint64_t without = renderer.memory().total();
    EXPECT_EQ(renderer.memory().drawings, 0u);
    Progress progress;
    renderStill(renderer, stillOf(mirrorRoom().camera("front")), progress);
    EXPECT_EQ(renderer.memory().drawings, 0u) << "made when first shown";
    renderStill(renderer, diagramOf(mirrorRoom().camera("front"), DiagramKind::subfield), progress);
    EXPECT_GT(renderer.memory().drawings, 8u * 160 * 120);
    EXPECT_EQ(renderer.memory().total(),
              without + renderer.memory().hits + renderer.memory().drawings);
}

}  // namespace vlf::test
