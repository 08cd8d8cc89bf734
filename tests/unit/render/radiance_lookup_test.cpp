#include "vlf/render/cpu/radiance_lookup.h"

#include "support/analytic_scenes.h"
#include "vlf/image/metrics.h"
#include "vlf/image/tone_map.h"
#include "vlf/math/random.h"
#include "vlf/propagate/bake.h"
#include "vlf/propagate/radiance_bake.h"
#include "vlf/render/cpu/camera_rays.h"
#include "vlf/render/cpu/field_shader.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

constexpr int kWidth = 200, kHeight = 150;

/// A room of 4 x 3 x 4 m of coloured walls with a mirror on the wall z = -2 in which a lamp and two
/// blocks are seen.
Scene roomWithMirror() {
    test::SceneBuilder b;
    const std::uint32_t white = b.material("white", Vec3(0.7f));
    const std::uint32_t red = b.material("red", {0.6f, 0.1f, 0.1f});
    const std::uint32_t blue = b.material("blue", {0.1f, 0.2f, 0.6f});
    const std::uint32_t mirror = b.material("mirror", Vec3(0), Vec3(0), Vec3(0.9f));
    const std::uint32_t lamp = b.material("lamp", Vec3(0), Vec3(15));
    b.box({-2, 0, -2}, {2, 3, 2}, true, white);
    for (int i = 0; i < 4; ++i) b.scene().triangles[i].material = i < 2 ? red : blue;
    for (int i = 8; i < 10; ++i) b.scene().triangles[i].material = mirror;
    b.quad({-0.5f, 2.99f, 0.2f}, {1, 0, 0}, {0, 0, 1}, lamp);
    b.box({-1.2f, 0, 0.2f}, {-0.6f, 1.4f, 0.8f}, false, blue);
    b.box({0.5f, 0, -0.4f}, {1.1f, 0.8f, 0.2f}, false, red);
    b.camera("centre", {0.3f, 1.6f, 1.7f}, {0, 1.3f, -2}, 60);
    b.camera("slanted", {-1.7f, 1.2f, 1}, {0.6f, 1.4f, -2}, 60);
    return b.scene();
}

BakeParams cheapParams(int lines, int cells) {
    BakeParams params = presetParams("draft");
    params.texelBudget = 8000;
    params.directions = 33;
    params.cells = 128;
    params.radianceDirections = lines;
    params.radianceCells = cells;
    return params;
}

LightField bakeRoom(const Scene& scene, int lines, int cells) {
    Progress progress;
    return bake(scene, cheapParams(lines, cells), progress);
}

std::vector<Ray> cameraRays(const Camera& camera) {
    const CameraRays view(camera, kWidth, kHeight);
    std::vector<Ray> rays;
    for (int i = 0; i < kWidth * kHeight; ++i)
        rays.push_back(
            view.ray(static_cast<float>(i % kWidth) + 0.5f, static_cast<float>(i / kWidth) + 0.5f));
    return rays;
}

/// What a camera sees through the given shader, in exposed units.
Image picture(const FieldShader& shader, const std::vector<Ray>& rays) {
    Image image(kWidth, kHeight);
    shader.radiance(rays, image.pixels);
    return image;
}

std::vector<std::uint8_t> mirrorPixels(const Scene& scene, const RayScene& tracer,
                                       const std::vector<Ray>& rays) {
    std::vector<std::uint8_t> mask;
    for (const Ray& ray : rays) {
        const Hit hit = tracer.closest(ray);
        mask.push_back(hit && scene.material(hit.triangle).isMirror());
    }
    return mask;
}

/// PSNR on mirror pixels against the traced reflections of the same field, at the traced picture's
/// automatic exposure.
double lookupQuality(const Scene& scene, const LightField& field, const Camera& camera,
                     LookupKind kind) {
    const RayScene tracer(scene);
    const std::vector<Ray> rays = cameraRays(camera);
    Image traced = picture(FieldShader(scene, tracer, field), rays);
    Image looked = picture(FieldShader(scene, tracer, field, MirrorMethod::lookedUp, kind), rays);
    const float scale = std::exp2(autoExposure(traced));
    for (Image* image : {&traced, &looked})
        for (Vec3& p : image->pixels) p *= scale;
    return peakSignalToNoise(looked, traced, mirrorPixels(scene, tracer, rays));
}

/// The field of evenly lit walls of the room with a mirror.
struct EvenRoom {
    EvenRoom() {
        for (Material& m : scene.materials) {
            if (m.isEmitter()) m.emission = Vec3(1e-6f);
            if (!m.isMirror()) m.diffuse = Vec3(0.5f);
        }
        field = bakeRoom(scene, 0, 64);
        for (Vec3& e : field.atlas.irradiance) e = Vec3(kPi);
        Progress progress;
        field.radiance =
            bakeRadiance(scene, RayScene(scene), field, {.lines = 33, .cells = 48}, progress);
    }

    std::uint32_t mirrorChart() const { return field.radiance.rows[0].chart; }

    Scene scene = roomWithMirror();
    LightField field;
};

constexpr LookupKind kKinds[] = {LookupKind::plain, LookupKind::depthCorrected};

TEST(MirrorLookup, AnEvenlyLitRoomIsEvenInItsMirror) {
    const EvenRoom room;
    const MirrorLookup lookup(room.field.frame, room.field.radiance);
    RandomStream random(1, 0);
    for (int i = 0; i < 3000; ++i) {
        const Vec3 eye(4 * random.next() - 2, 3 * random.next(), 3.9f * random.next() - 1.9f);
        const MirrorPoint point{
            room.mirrorChart(), {4 * random.next() - 2, 3 * random.next(), -2}, {0, 0, 1}};
        for (const LookupKind kind : kKinds) {
            const Vec3 seen =
                lookup.mirrorRadiance(point, glm::normalize(eye - point.position), kind);
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(seen[c], 0.9f * 0.5f, 1e-3f) << i;
        }
    }
}

TEST(MirrorLookup, OfASurfaceWithoutRadianceFieldIsBlack) {
    const EvenRoom room;
    const MirrorLookup lookup(room.field.frame, room.field.radiance);
    for (const LookupKind kind : kKinds) {
        EXPECT_EQ(
            lookup.mirrorRadiance({room.mirrorChart() + 1, {0, 1, -2}, {0, 0, 1}}, {0, 0, 1}, kind),
            Vec3(0));
        // Behind the mirror.
        EXPECT_EQ(
            lookup.mirrorRadiance({room.mirrorChart(), {0, 1, -2}, {0, 0, 1}}, {0, 0, -1}, kind),
            Vec3(0));
    }
}

TEST(MirrorLookup, AlongADirectionOfTheSetIsWhatThatSubfieldStores) {
    const Scene scene = roomWithMirror();
    const LightField field = bakeRoom(scene, 33, 64);
    const MirrorLookup lookup(field.frame, field.radiance);
    const DirectionSet directions(33);
    const std::uint32_t chart = field.radiance.rows[0].chart;
    int checked = 0;
    for (std::uint32_t d = 0; d < 66; ++d) {
        const Vec3& toEye = directions.direction(d);
        if (toEye.z < 0.2f) continue;
        const ParallelSubfield s = makeSubfield(field.frame, directions.direction(d % 33), 64);
        for (int i = 0; i < 10; ++i) {
            const Vec3 near(-1.5f + 0.3f * static_cast<float>(i), 1.5f, -2);
            const Vec2 cell = glm::floor(s.cellCoordinates(near));
            const Vec2 shift = (cell + 0.5f - s.cellCoordinates(near)) / glm::dot(s.xAxis, s.xAxis);
            Vec3 p = near + shift.x * s.xAxis + shift.y * s.yAxis;
            p -= toEye * ((p.z + 2) / toEye.z);
            const RadianceElement* e =
                field.radiance.element(field.radiance.rowsOf(d, chart), static_cast<int>(cell.x),
                                       static_cast<int>(cell.y));
            ASSERT_NE(e, nullptr);
            const Vec3 stored = unpackRgb9e5(e->rgb9e5());
            const Vec3 seen =
                lookup.mirrorRadiance({chart, p, {0, 0, 1}}, toEye, LookupKind::plain);
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(seen[c], stored[c], 0.02f * stored[c] + 1e-3f);
            ++checked;
        }
    }
    EXPECT_GT(checked, 100);
}

TEST(MirrorLookup, ComesCloseToTracedReflectionsAndCloserWithDepth) {
    const Scene scene = roomWithMirror();
    const LightField field = bakeRoom(scene, 513, 128);
    for (const Camera& camera : scene.cameras) {
        const double plain = lookupQuality(scene, field, camera, LookupKind::plain);
        const double corrected = lookupQuality(scene, field, camera, LookupKind::depthCorrected);
        EXPECT_GT(plain, 20) << camera.name;
        EXPECT_GT(corrected, 29) << camera.name;
        EXPECT_GT(corrected, plain + 7) << camera.name;
    }
}

TEST(MirrorLookup, GainsFromFinerCells) {
    const Scene scene = roomWithMirror();
    const Camera& camera = scene.cameras[0];
    const auto quality = [&](int cells) {
        return lookupQuality(scene, bakeRoom(scene, 129, cells), camera,
                             LookupKind::depthCorrected);
    };
    EXPECT_GT(quality(128), quality(48) + 2);
}

}  // namespace
}  // namespace vlf
