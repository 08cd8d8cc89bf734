// Frame times along a way through a room, or the same way through several rooms in turns:
// path_table FIELD... [--path CAM.json] [--mode M] [--width W] [--height H] [--frames N] [--rounds
// N]

#include "frame_timing.h"

#include "vlf/display/camera_path_file.h"
#include "vlf/io/field_file.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace {

using namespace vlf;
using namespace vlf::bench;

struct Options {
    std::vector<std::string> fields;
    std::string path;
    DisplayMode mode = DisplayMode::field;
    int width = 1024, height = 768, frames = 200, rounds = 5;
};

/// What is timed along the way.
struct Run {
    std::string name;
    Renderer& renderer;
    RenderSettings settings;
    std::vector<double> milliseconds{};  ///< of each frame the least of all rounds: what else the
                                         ///< machine does can only lengthen it
    std::vector<double> all{};           ///< of all rounds
};

void print(const Run& run, const Run& base) {
    const std::vector<double>& times = run.milliseconds;
    const double median = percentile(times, 0.5);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < times.size(); ++i)
        ratios.push_back(times[i] / base.milliseconds[i]);
    std::printf(
        "%-28s median %6.2f ms %6.1f fps, slowest %6.1f fps, p99/median %.2f (%.2f as measured); "
        "to plain: median %.2fx, worst %.2fx\n",
        run.name.c_str(), median, 1000 / median, 1000 / percentile(times, 1),
        percentile(times, 0.99) / median, percentile(run.all, 0.99) / percentile(run.all, 0.5),
        percentile(ratios, 0.5), percentile(ratios, 1));
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Frame times along a way through a room");
    app.add_option("fields", options.fields, "Field files (.vlf)")->required();
    app.add_option("--path", options.path, "Camera path (else the tour of the first's cameras)");
    const std::map<std::string, DisplayMode> modes{{"field", DisplayMode::field},
                                                   {"raytraced", DisplayMode::raytraced}};
    app.add_option("--mode", options.mode)->transform(CLI::CheckedTransformer(modes));
    app.add_option("--width", options.width);
    app.add_option("--height", options.height);
    app.add_option("--frames", options.frames, "Along the way");
    app.add_option("--rounds", options.rounds, "Times it is gone");
    CLI11_PARSE(app, argc, argv);

    std::vector<BakedRoom> rooms;
    for (const std::string& field : options.fields) rooms.push_back(readField(field));
    const CameraPath path =
        options.path.empty() ? tour(rooms.front().scene.cameras) : readCameraPath(options.path);
    const gl::HeadlessContext context;
    const Target target(options.width, options.height);
    const BakedRoom plainRoom = withoutMirrors(rooms.front());
    Renderer plain(plainRoom.scene, plainRoom.field, {VLF_PLAIN_SHADERS});
    std::vector<std::unique_ptr<Renderer>> renderers;
    std::vector<Run> runs{{"plain rasterisation", plain, {}}};
    RenderSettings settings;
    settings.mode = options.mode;
    for (std::size_t i = 0; i < rooms.size(); ++i) {
        renderers.push_back(std::make_unique<Renderer>(rooms[i].scene, rooms[i].field));
        runs.push_back({options.fields[i], *renderers.back(), settings});
    }
    for (int round = -1; round < options.rounds; ++round)
        for (int frame = 0; frame < options.frames; ++frame) {
            const double seconds = path.duration() * frame / std::max(options.frames - 1, 1);
            const View view =
                viewOf(cameraOf(path.at(seconds)), options.width, options.height, plain.nearest());
            for (Run& run : runs) {
                const double time = frameTime(run.renderer, view, run.settings, target);
                const auto i = static_cast<std::size_t>(frame);
                if (round < 0) continue;
                run.all.push_back(time);
                if (round == 0) run.milliseconds.push_back(time);
                run.milliseconds[i] = std::min(run.milliseconds[i], time);
            }
        }
    for (const Run& run : runs) print(run, runs.front());
    return 0;
}
