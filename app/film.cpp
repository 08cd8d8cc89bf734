#include "film.h"

#include "console.h"
#include "eye_pictures.h"
#include "frame_output.h"
#include "stopwatch.h"

#include "vlf/base/error.h"
#include "vlf/display/camera_path_file.h"
#include "vlf/display/frame_log.h"
#include "vlf/display/time_statistics.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vlf::app {

namespace {

constexpr double kSameMoment = 1e-6;  // frames; rounding of times and rates

/// The work on one of many frames, told as a part of the whole.
class PartProgress : public Progress {
  public:
    PartProgress(Progress& whole, int part, int parts)
        : whole_(whole), part_(part), parts_(parts) {}

    void update(double fraction) override {
        whole_.update((part_ + fraction) / parts_);
        if (whole_.cancelled()) cancel();
    }

  private:
    Progress& whole_;
    int part_, parts_;
};

/// Frame k is at k / fps seconds; a part of a film has the numbers it has in the whole.
struct FrameRange {
    int first = 0, end = 0;

    int count() const { return end - first; }
};

/// Number of the first frame that is not before a moment.
int frameAt(const Moment& moment, double fps) {
    const double frame = moment.isFrame ? moment.value : moment.value * fps;
    return static_cast<int>(std::min(std::ceil(frame - kSameMoment), 1e9));
}

FrameRange framesToShow(const FilmOptions& options, double duration) {
    FrameRange frames{0, std::max(frameAt({duration, false}, options.fps), 1)};
    const int all = frames.end;
    if (options.from) frames.first = frameAt(*options.from, options.fps);
    if (options.to) frames.end = std::min(frames.end, frameAt(*options.to, options.fps));
    if (frames.count() < 1)
        throw InputError(fmt::format("--from and --to leave no frame: the path has {}, {:.3f} s",
                                     all, duration));
    return frames;
}

class FilmMaker {
  public:
    FilmMaker(const RenderOptions& options, RoomRenderer& renderer, CameraPath path)
        : options_(options),
          renderer_(renderer),
          path_(std::move(path)),
          picture_(pictureOptions(options)) {}

    /// Brings small pictures all along the path to middle grey together, so that the light of the
    /// film does not waver, and parts of it fit each other.
    float exposure(Progress& progress) {
        if (writesRadiance(picture_.path) || picture_.exposure != "auto")
            return exposureOf(picture_, {});
        constexpr int kPictures = 12, kWidth = 96;
        std::vector<Image> pictures;
        for (int i = 0; i < kPictures; ++i) {
            const double seconds = path_.duration() * i / (kPictures - 1);
            renderer_.moveTo(seconds);
            StillParams params = still(seconds);
            params.height = std::clamp(kWidth * params.height / params.width, 1, 4 * kWidth);
            params.width = kWidth;
            params.antialias = 1;
            PartProgress part(progress, i, kPictures);
            StillReport report;
            pictures.push_back(renderer_.render(params, part, report));
        }
        return exposureOf(picture_, pictures);
    }

    FrameLog make(const FrameRange& frames, float exposure, FrameOutput& output,
                  Progress& progress) {
        FrameLog log({"objects", "develop", "write"});
        for (int frame = frames.first; frame < frames.end; ++frame) {
            progress.check();
            PartProgress part(progress, frame - frames.first, frames.count());
            log.add(makeFrame(frame, exposure, output, part));
        }
        output.finish();
        return log;
    }

    double duration() const { return path_.duration(); }

  private:
    StillParams still(double seconds) const {
        Camera camera = cameraOf(path_.at(seconds));
        overrideCamera(options_.camera, camera);
        return stillParams(options_, camera);
    }

    FrameRecord makeFrame(int frame, float exposure, FrameOutput& output, Progress& progress) {
        const Stopwatch watch;
        FrameRecord record;
        record.pathSeconds = frame / options_.film.fps;
        record.pose = path_.at(record.pathSeconds);
        renderer_.moveTo(record.pathSeconds);
        const double moved = watch.milliseconds();
        StillReport report;
        std::vector<Image> eyes =
            renderEyes(renderer_, still(record.pathSeconds), options_.stereo, progress, report);
        record.cpuMs = watch.milliseconds();
        const std::vector<Image> pictures =
            develop(picture_, exposure, options_.stereo.layout, std::move(eyes));
        const double developed = watch.milliseconds();
        output.add(frame, pictures);
        record.totalMs = watch.milliseconds();
        record.passMs = {moved, developed - record.cpuMs, record.totalMs - developed};
        return record;
    }

    const RenderOptions& options_;
    RoomRenderer& renderer_;
    CameraPath path_;
    PictureOptions picture_;
};

TimeStatistics statisticsOf(const FrameLog& log, double FrameRecord::* time) {
    std::vector<double> times;
    for (const FrameRecord& frame : log.frames()) times.push_back(frame.*time);
    return vlf::statisticsOf(std::move(times));
}

nlohmann::ordered_json toJson(const TimeStatistics& ms) {
    return {{"median", ms.median},
            {"p95", ms.p95},
            {"p99", ms.p99},
            {"max", ms.max},
            {"p99OverMedian", ms.p99OverMedian()}};
}

}  // namespace

nlohmann::ordered_json renderFilm(const RenderOptions& options, const Globals& globals,
                                  RoomRenderer& renderer, const std::vector<Camera>& cameras) {
    const Stopwatch watch;
    FilmMaker maker(options, renderer,
                    options.film.tour ? tour(cameras) : readCameraPath(options.film.path));
    const FrameRange frames = framesToShow(options.film, maker.duration());
    const std::unique_ptr<FrameOutput> output = openFrameOutput(options, frames.first);
    ConsoleProgress progress(globals.quiet);
    progress.stage("exposure");
    const float exposure = maker.exposure(progress);
    progress.stage("frames");
    const FrameLog log = maker.make(frames, exposure, *output, progress);
    if (!options.film.log.empty()) log.write(options.film.log);

    const double seconds = watch.seconds();
    const TimeStatistics total = statisticsOf(log, &FrameRecord::totalMs);
    if (!globals.quiet)
        fmt::print(
            "{}: {} frames of {}x{} pixels in {:.2f} s; a frame took {:.1f} ms, the slowest "
            "hundredth {:.1f} ms or more\n",
            fmt::join(output->names(), ", "), frames.count(), options.camera.width,
            options.camera.height, seconds, total.median, total.p99);
    return {
        {"outputs", output->names()},
        {"firstFrame", frames.first},
        {"frames", frames.count()},
        {"fps", options.film.fps},
        {"exposure", exposure},
        {"seconds", seconds},
        {"milliseconds",
         {{"render", toJson(statisticsOf(log, &FrameRecord::cpuMs))}, {"total", toJson(total)}}}};
}

}  // namespace vlf::app
