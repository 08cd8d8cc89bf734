// popping_table ROOM.vlf [--size METRES] [--fps N] [--seconds S]
//
// Whether light pops while an object moves: a cube goes once around the room, and irradiance is
// compared from frame to frame at every texel of the room from where it hides no part of an emitter
// and that is farther from it than it is large; relative to the texel's own irradiance, or to a
// fifth of the mean where that is more.

#include "vlf/dynamic/dynamic_room.h"
#include "vlf/dynamic/soft_shadow.h"
#include "vlf/io/field_file.h"
#include "vlf/scene/generate/primitives.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace {

using namespace vlf;

struct Options {
    std::string file;
    float size = 0.2f, seconds = 60, fps = 60;
};

void run(const Options& o) {
    const BakedRoom baked = readField(o.file);
    const RayScene rays(baked.scene);
    const RoomTexels texels = makeRoomTexels(baked.scene, rays, baked.field);
    DynamicRoom room(baked.scene, rays, baked.field);
    Material white;
    white.diffuse = Vec3(0.8f);
    DynamicObject cube;
    cube.model = std::make_shared<ObjectModel>(makePrimitive("cube", white));
    cube.pose.scale = o.size;
    room.add(cube);
    const Bounds bounds = boundsOf(baked.scene);
    const Vec3 centre = bounds.centre() + Vec3(0, 0.2f * bounds.size().y, 0);  // above what stands
    const float radius = 0.25f * std::min(bounds.size().x, bounds.size().z);
    const auto frames = static_cast<int>(o.seconds * o.fps);
    std::vector<float> before, worstOf(texels.unwrap.texels.size(), 0);
    std::vector<float> all;
    std::vector<std::uint8_t> shadowedBefore;
    double worst = 0, sum = 0;
    for (const std::uint32_t t : texels.unwrap.texels)
        sum += luminance(baked.field.atlas.irradiance[t]);
    const auto mean = static_cast<float>(sum / static_cast<double>(texels.unwrap.texels.size()));
    for (int f = 0; f < frames; ++f) {
        const float turn = 2 * kPi * static_cast<float>(f) / static_cast<float>(frames);
        Pose pose = cube.pose;
        pose.rotation = glm::angleAxis(3 * turn, glm::normalize(Vec3(1, 2, 3)));
        pose.translation = centre + radius * Vec3(std::cos(turn), 0, std::sin(turn));
        room.setPose(0, pose);
        room.update();
        std::vector<float> now;
        for (const std::uint32_t t : texels.unwrap.texels)
            now.push_back(luminance(room.irradiance().irradiance[t]));
        const ShadowCaster caster = casterOf(*cube.model, pose);
        const Sphere& sphere = caster.sphere;
        std::vector<std::uint8_t> shadowed(now.size(), 0);
        for (const std::uint32_t i : texelsInShadow(baked.scene, rays, texels, {&caster, 1}))
            shadowed[i] = 1;
        for (std::size_t i = 0; i < now.size(); ++i) {
            const LightReceiver r = texelReceiver(baked.scene, texels.unwrap, i);
            if (glm::distance(r.centre, sphere.centre) < 3 * sphere.radius) shadowed[i] = 1;
        }
        float frameWorst = 0;
        for (std::size_t i = 0; i < now.size() && !before.empty(); ++i) {
            const float own = luminance(baked.field.atlas.irradiance[texels.unwrap.texels[i]]);
            if (shadowed[i] || shadowedBefore[i]) continue;
            const float step = std::abs(now[i] - before[i]) / std::max(own, 0.2f * mean);
            worstOf[i] = std::max(worstOf[i], step);
            frameWorst = std::max(frameWorst, step);
        }
        if (!before.empty()) all.push_back(frameWorst);
        worst = std::max<double>(worst, frameWorst);
        before = std::move(now);
        shadowedBefore = std::move(shadowed);
    }
    std::sort(all.begin(), all.end());
    std::sort(worstOf.begin(), worstOf.end());
    std::printf("largest step of any texel in any of %d frames: %.3f %%\n", frames, 100 * worst);
    std::printf("largest step in a frame, median over frames:   %.3f %%\n",
                100 * static_cast<double>(all[all.size() / 2]));
    std::printf("largest step of a texel, median over texels:   %.3f %%, 99th percentile %.3f %%\n",
                100 * static_cast<double>(worstOf[worstOf.size() / 2]),
                100 * static_cast<double>(worstOf[worstOf.size() * 99 / 100]));
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Whether light pops while an object moves");
    app.add_option("field", options.file, "Field file")->required();
    app.add_option("--size", options.size, "Of the cube, metres");
    app.add_option("--seconds", options.seconds, "For a turn");
    app.add_option("--fps", options.fps, "Frames a second");
    CLI11_PARSE(app, argc, argv);
    try {
        run(options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
