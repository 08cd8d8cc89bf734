// What a dynamic object costs: frame times of the OpenGL renderer without it, with it at rest and
// with it moving, from each camera of a room, in modes field and raytraced: object_table FIELD
// [--object NAME] [--size M] [--count N] [--mirror] [--camera NAME] [--pictures PREFIX]

#include "frame_timing.h"

#include "vlf/dynamic/dynamic_room.h"
#include "vlf/image/image_io.h"
#include "vlf/io/field_file.h"
#include "vlf/render/gl/still.h"
#include "vlf/scene/generate/primitives.h"

#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace {

using namespace vlf;
using namespace vlf::bench;
using Clock = std::chrono::steady_clock;

struct Options {
    std::string field, camera, object = "cube", shading = "gather", pictures, shaders;
    float size = 0.1f;  ///< metres
    int count = 1, width = 1024, height = 768, frames = 40;
    bool mirror = false, noShadow = false;
};

double since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::vector<DynamicObject> makeObjects(const Options& options) {
    Material material;
    material.diffuse = {0.7f, 0.15f, 0.1f};
    if (options.mirror) material.diffuse = Vec3(0.1f), material.mirror = Vec3(0.8f);
    DynamicObject object;
    object.name = options.object;
    object.model = std::make_shared<const ObjectModel>(makePrimitive(options.object, material));
    object.pose.scale = options.size;
    for (const auto& [name, shading] : {std::pair{"flat", Shading::flat},
                                        {"lights", Shading::lights},
                                        {"gather", Shading::gather},
                                        {"prt", Shading::prt}})
        if (options.shading == name) object.settings.shading = shading;
    if (options.noShadow) object.settings.shadow = ShadowKind::none;
    return std::vector<DynamicObject>(static_cast<std::size_t>(options.count), object);
}

/// Where the objects are at a time: before what the camera looks at.
Vec3 placeAt(const Camera& camera, const RayScene& rays, const Options& options, int object,
             int frame) {
    const Vec3 forward = glm::normalize(camera.look - camera.eye);
    const Hit hit = rays.closest({camera.eye, forward});
    const float distance = 0.75f * (hit ? hit.t : glm::distance(camera.eye, camera.look));
    const Vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const float column = static_cast<float>(object % 10) - 0.5f * std::min(options.count - 1, 9);
    const float row = static_cast<float>(object / 10) - 0.5f * ((options.count - 1) / 10);
    const float sway = 0.02f * std::sin(0.7f * static_cast<float>(frame));
    return camera.eye + distance * forward + 1.3f * options.size * column * right +
           (1.3f * options.size * row + sway) * camera.up;
}

struct Times {
    std::vector<double> light, upload, draw;

    double median() const {
        return percentile(light, 0.5) + percentile(upload, 0.5) + percentile(draw, 0.5);
    }
};

void print(const Camera& camera, const char* mode, const char* state, const Times& times,
           double base) {
    std::printf("%-10s %-9s %-8s light %6.2f upload %5.2f draw %6.2f ms: %6.1f fps, %+6.1f %%\n",
                camera.name.c_str(), mode, state, percentile(times.light, 0.5),
                percentile(times.upload, 0.5), percentile(times.draw, 0.5), 1000 / times.median(),
                100 * (times.median() / base - 1));
}

void measure(const Options& options, const BakedRoom& room, const RayScene& rays,
             const Camera& camera) {
    Renderer empty(room.scene, room.field), with(room.scene, room.field, {options.shaders});
    DynamicRoom objects(room.scene, rays, room.field);
    for (DynamicObject& object : makeObjects(options)) objects.add(object);
    const Target target(options.width, options.height);
    const View view = viewOf(camera, options.width, options.height, empty.nearest());
    for (const auto& [mode, name] :
         {std::pair{DisplayMode::field, "field"}, {DisplayMode::raytraced, "raytraced"}}) {
        RenderSettings settings;
        settings.mode = mode;
        if (mode == DisplayMode::field && !empty.canLookUp()) continue;
        Times without, rest, moving;
        // In turns, so that whatever else the machine does weighs on all alike.
        for (int frame = -3; frame < options.frames; ++frame) {
            Times one;
            const double base = frameTime(empty, view, settings, target);
            for (int i = 0; i < options.count; ++i) {
                Pose pose = objects.object(static_cast<std::size_t>(i)).pose;
                pose.translation = placeAt(camera, rays, options, i, frame);
                objects.setPose(static_cast<std::size_t>(i), pose);
            }
            const Clock::time_point start = Clock::now();
            objects.update();
            const double light = since(start);
            const Clock::time_point lit = Clock::now();
            with.updateObjects(objects);
            const double upload = since(lit);
            const double draw = frameTime(with, view, settings, target);
            const double again = frameTime(with, view, settings, target);
            if (frame < 0) continue;
            for (auto [times, l, u, d] : {std::tuple{&without, 0.0, 0.0, base},
                                          {&moving, light, upload, draw},
                                          {&rest, 0.0, 0.0, again}})
                times->light.push_back(l), times->upload.push_back(u), times->draw.push_back(d);
        }
        print(camera, name, "without", without, without.median());
        print(camera, name, "rest", rest, without.median());
        print(camera, name, "moving", moving, without.median());
        if (options.pictures.empty()) continue;
        StillParams still;
        still.camera = camera;
        still.width = options.width;
        still.height = options.height;
        still.mode = mode;
        Progress progress;
        const Image image = renderStill(with, still, progress);
        writePng(options.pictures + camera.name + "-" + name + ".png",
                 toneMap(image, autoExposure(image), ToneCurve::filmic));
    }
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("What a dynamic object costs");
    app.add_option("field", options.field, "Field file (.vlf)")->required();
    app.add_option("--camera", options.camera, "One camera (else all)");
    app.add_option("--object", options.object, "A primitive");
    app.add_option("--size", options.size, "Metres");
    app.add_option("--count", options.count, "How many");
    app.add_option("--shading", options.shading, "flat, lights, gather or prt");
    app.add_flag("--mirror", options.mirror, "Mirror objects");
    app.add_flag("--no-shadow", options.noShadow, "Objects do not change the room's light");
    app.add_option("--width", options.width);
    app.add_option("--height", options.height);
    app.add_option("--frames", options.frames);
    app.add_option("--pictures", options.pictures, "Prefix of pictures");
    app.add_option("--shaders", options.shaders, "Folder of shaders for the room with objects");
    CLI11_PARSE(app, argc, argv);
    const BakedRoom room = readField(options.field);
    const RayScene rays(room.scene);
    const gl::HeadlessContext context;
    std::vector<Camera> cameras = room.scene.cameras;
    if (cameras.empty()) cameras.push_back(defaultCamera(room.scene));
    for (const Camera& camera : cameras)
        if (options.camera.empty() || camera.name == options.camera)
            measure(options, room, rays, camera);
    return 0;
}
