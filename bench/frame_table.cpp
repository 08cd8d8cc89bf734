// Frame times of the OpenGL renderer in each mode against a plain textured rasterisation of the
// same views and against the same room without its mirrors, and of the calls in which mode
// progressive comes to rest: frame_table FIELD [--camera NAME] [--width W] [--height H] [--frames
// N] [--budget MS]

#include "frame_timing.h"

#include "vlf/io/field_file.h"
#include "vlf/render/gl/progressive.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace {

using namespace vlf;
using namespace vlf::bench;

struct Options {
    std::string field, camera;
    int width = 1024, height = 768, frames = 60;
    double budget = 33;  ///< milliseconds of a call in mode progressive
};

struct Way {
    const char* name;
    Renderer& renderer;
    RenderSettings settings;
    std::vector<double> milliseconds;
};

void drawFrames(const Options& options, const Camera& camera, std::vector<Way>& ways) {
    const Target target(options.width, options.height);
    const View view =
        viewOf(camera, options.width, options.height, ways.front().renderer.nearest());
    // In turns, so that whatever else the machine does weighs on all alike.
    for (int frame = -3; frame < options.frames; ++frame)
        for (Way& way : ways) {
            const double time = frameTime(way.renderer, view, way.settings, target);
            if (frame >= 0) way.milliseconds.push_back(time);
        }
}

/// How long the calls take in which a still view fills in.
void measureRest(const Options& options, Renderer& renderer, const Camera& camera) {
    using Clock = std::chrono::steady_clock;
    using Milliseconds = std::chrono::duration<double, std::milli>;
    const Target target(options.width, options.height);
    ProgressiveRenderer progressive(renderer);
    const View view = viewOf(camera, options.width, options.height, renderer.nearest());
    std::vector<double> calls;
    double firstSample = 0;
    const Clock::time_point begin = Clock::now();
    // The first call shows mode field.
    for (int call = 0; call <= options.frames * 4; ++call) {
        const Clock::time_point start = Clock::now();
        progressive.draw(view, {}, target.framebuffer.id(), 1e-3 * options.budget);
        glFinish();
        if (call > 0) calls.push_back(Milliseconds(Clock::now() - start).count());
        if (progressive.samples() > 0 && firstSample == 0)
            firstSample = Milliseconds(Clock::now() - begin).count();
    }
    std::printf(
        "%-12s %-18s median %.1f, p99 %.1f, longest %.1f ms a call; first sample %.0f ms, "
        "%d samples after %zu calls\n",
        camera.name.c_str(), "progressive", percentile(calls, 0.5), percentile(calls, 0.99),
        percentile(calls, 1), firstSample, progressive.samples(), calls.size());
}

void measure(const Options& options, const BakedRoom& room, const Camera& camera) {
    const BakedRoom plainRoom = withoutMirrors(room);
    Renderer renderer(room.scene, room.field), walls(plainRoom.scene, plainRoom.field);
    Renderer textured(plainRoom.scene, plainRoom.field, {VLF_PLAIN_SHADERS});
    RenderSettings plainLookup, traced;
    plainLookup.lookup = LookupKind::plain;
    traced.mode = DisplayMode::raytraced;
    RenderSettings wireframe, diagram[4];
    wireframe.mode = DisplayMode::wireframe;
    for (int kind = 0; kind < 4; ++kind) {
        diagram[kind].mode = DisplayMode::diagram;
        diagram[kind].diagram.kind = static_cast<DiagramKind>(kind);
        diagram[kind].diagramCamera = camera;
    }
    std::vector<Way> ways{
        {"plain rasterisation", textured, {}, {}},   {"mirrors as walls", walls, {}, {}},
        {"field, plain", renderer, plainLookup, {}}, {"field, depth", renderer, {}, {}},
        {"raytraced", renderer, traced, {}},         {"wireframe", renderer, wireframe, {}},
        {"directions", renderer, diagram[0], {}},    {"subfield", renderer, diagram[1], {}},
        {"tile", renderer, diagram[2], {}},          {"chart", renderer, diagram[3], {}}};
    drawFrames(options, camera, ways);
    const double base = percentile(ways[0].milliseconds, 0.5);
    for (const Way& way : ways) {
        const double median = percentile(way.milliseconds, 0.5);
        std::printf("%-12s %-20s %7.2f ms %6.1f fps %5.2fx  p99/median %.2f\n", camera.name.c_str(),
                    way.name, median, 1000 / median, median / base,
                    percentile(way.milliseconds, 0.99) / median);
    }
    measureRest(options, renderer, camera);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Frame times of the OpenGL renderer");
    app.add_option("field", options.field, "Field file (.vlf)")->required();
    app.add_option("--camera", options.camera, "One camera (else all)");
    app.add_option("--width", options.width);
    app.add_option("--height", options.height);
    app.add_option("--frames", options.frames);
    app.add_option("--budget", options.budget, "Milliseconds of a call in mode progressive");
    CLI11_PARSE(app, argc, argv);
    const BakedRoom room = readField(options.field);
    const gl::HeadlessContext context;
    std::vector<Camera> cameras = room.scene.cameras;
    if (cameras.empty()) cameras.push_back(defaultCamera(room.scene));
    for (const Camera& camera : cameras)
        if (options.camera.empty() || camera.name == options.camera) measure(options, room, camera);
    return 0;
}
