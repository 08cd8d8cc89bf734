// A live bake as a window would see it: when which state of the light arrives, how far it is from
// the last one, and how late the ticks of a 60 Hz loop come meanwhile:
// live_table SCENE... [--preset NAME] [--niceness N] [--threads N]

#include "vlf/base/error.h"
#include "vlf/live/live_bake.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

namespace {

using namespace vlf;
using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr std::chrono::microseconds kTick{16667};
constexpr std::size_t kPoints = 20000;

struct Options {
    std::vector<std::string> scenes;
    std::string preset = "standard";
    LiveOptions live;
};

struct Arrival {
    double seconds;
    LiveUpdate update;
    std::shared_ptr<const BakedRoom> room;  // with the charts of the irradiance
    double missingLight;
};

struct Recording {
    std::vector<Arrival> arrivals;
    double worstStall = 0, worstPoll = 0;  // ms
};

Recording record(const Options& options) {
    Recording recording;
    const Clock::time_point start = Clock::now();
    LiveBake bake(options.scenes, presetParams(options.preset), options.live);
    std::shared_ptr<const BakedRoom> room;
    for (Clock::time_point tick = start;; tick = std::max(tick + kTick, Clock::now())) {
        std::this_thread::sleep_until(tick);
        const Clock::time_point begin = Clock::now();
        std::optional<LiveUpdate> update = bake.poll();
        const LiveStatus status = bake.status();
        const Clock::time_point end = Clock::now();
        recording.worstStall = std::max(recording.worstStall, Milliseconds(end - tick).count());
        recording.worstPoll = std::max(recording.worstPoll, Milliseconds(end - begin).count());
        if (!status.error.empty()) throw Error(status.error);
        if (!update) continue;
        if (update->room) room = update->room;
        const std::chrono::duration<double> since = begin - start;
        recording.arrivals.push_back({since.count(), *update, room, status.missingLight});
        if (update->complete) return recording;
    }
}

/// Milliseconds by which the worst tick is late if this process does nothing else.
double stallWithoutBake(double seconds) {
    double worst = 0;
    const Clock::time_point start = Clock::now();
    for (Clock::time_point tick = start;
         Clock::now() - start < std::chrono::duration<double>(seconds);
         tick = std::max(tick + kTick, Clock::now())) {
        std::this_thread::sleep_until(tick);
        worst = std::max(worst, Milliseconds(Clock::now() - tick).count());
    }
    return worst;
}

struct Point {
    std::uint32_t triangle;
    Vec3 position;
};

/// Spread evenly over the scene's surface.
std::vector<Point> surfacePoints(const Scene& scene) {
    std::vector<double> areas;
    double sum = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        areas.push_back(sum += area(scene, t));
    std::vector<Point> points;
    RandomStream random(1, 0);
    for (std::size_t i = 0; i < kPoints; ++i) {
        const double at = sum * (static_cast<double>(i) + random.next()) / kPoints;
        const auto found = std::upper_bound(areas.begin(), areas.end() - 1, at) - areas.begin();
        const auto triangle = static_cast<std::uint32_t>(found);
        points.push_back(
            {triangle, positionAt(scene, triangle, sampleUniformTriangle(random.next2()))});
    }
    return points;
}

struct Difference {
    double rmse = 0;  // √(Σ(E−E*)² / ΣE*²)
    double mean = 0;  // Σ|E−E*| / ΣE*: not of a few bright spots alone
};

/// Of irradiance against the last arrival's, over both sides of the points.
Difference difference(const std::vector<Point>& points, const Arrival& a, const Arrival& last) {
    double squares = 0, absolute = 0, truthSquares = 0, truths = 0;
    for (const Point& p : points)
        for (const auto side : {&TriangleCharts::front, &TriangleCharts::back}) {
            const std::uint32_t own = a.room->field.triangleCharts[p.triangle].*side;
            const std::uint32_t other = last.room->field.triangleCharts[p.triangle].*side;
            if (own == kNoChart || other == kNoChart) continue;
            const auto sample = [&](const Arrival& from, std::uint32_t chart) {
                const Chart& c = from.room->field.charts[chart];
                return luminance(from.update.irradiance->sample(c, c.texelCoordinates(p.position)));
            };
            const double truth = sample(last, other), d = sample(a, own) - truth;
            squares += d * d;
            absolute += std::abs(d);
            truthSquares += truth * truth;
            truths += truth;
        }
    return {std::sqrt(squares / truthSquares), absolute / truths};
}

const char* nameOf(LiveStage stage) {
    switch (stage) {
        case LiveStage::estimated:
            return "estimated";
        case LiveStage::directLight:
            return "direct light";
        case LiveStage::bounce:
            return "bounce";
        case LiveStage::settled:
            return "settled";
        case LiveStage::finished:
            return "finished";
    }
    return "";
}

void print(const Recording& recording) {
    const Arrival& last = recording.arrivals.back();
    const std::vector<Point> points = surfacePoints(last.room->scene);
    std::printf("%8s  %-9s %-13s %7s %6s %9s %9s %9s\n", "seconds", "preset", "state", "sweeps",
                "charts", "missing", "rel. RMSE", "rel. mean");
    for (const Arrival& a : recording.arrivals) {
        const Difference d = difference(points, a, last);
        std::printf("%8.3f  %-9s %-13s %7d %6s %7.2f %% %7.2f %% %7.2f %%\n", a.seconds,
                    a.update.preset.c_str(), nameOf(a.update.stage), a.update.bounces,
                    a.update.room ? "new" : "", 100 * a.missingLight, 100 * d.rmse, 100 * d.mean);
    }
    std::printf("latest tick %.1f ms (%.1f ms in a while without a bake), longest poll %.3f ms\n",
                recording.worstStall, stallWithoutBake(last.seconds), recording.worstPoll);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("What a live bake delivers when");
    app.add_option("scenes", options.scenes, "Scene files, merged")->required();
    app.add_option("--preset", options.preset, "draft, standard or high");
    app.add_option("--niceness", options.live.niceness);
    app.add_option("--threads", options.live.threads);
    CLI11_PARSE(app, argc, argv);
    try {
        print(record(options));
    } catch (const Error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
    return 0;
}
