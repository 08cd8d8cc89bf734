// Even texels against adaptive ones: a table of docs/benchmarks.md.
//
//     texel_table SCENE [draft | standard | high][,TEXELS] ...
//
// Each is baked with even texels and with adaptive ones of the same budget. The truth is a bake
// with 16 times the texels of "standard", 8193 lines and more shadow rays; what is shown is held
// against the mean over each of its texels, but for those that something covers closer than a texel
// of the bake is wide, into which nobody looks. CPU seconds have the pilot in them and no radiance
// fields. SCENE is a name known to `vlf scene` or a file.

#include "scene_named.h"
#include "solved_room.h"
#include "vlf/base/parallel.h"
#include "vlf/propagate/fill_atlas.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

using namespace vlf;
using bench::SolvedRoom;

namespace {

constexpr float kClosedOff = 1e-3f;  // of the room's mean light: nobody sees what has less

struct Shown : SolvedRoom {
    Shown(const Scene& room, const BakeParams& params)
        : SolvedRoom(room, params), atlas(fillAtlas(state)) {}

    IrradianceAtlas atlas;
};

BakeParams paramsOf(const std::string& text) {
    const std::size_t comma = text.find(',');
    BakeParams p = presetParams(text.substr(0, comma));
    if (comma != std::string::npos) p.texelBudget = std::stod(text.substr(comma + 1));
    return p;
}

BakeParams truthParams() {
    BakeParams p = presetParams("standard");
    p.texelBudget *= 16;
    p.directions = 8193;
    p.cells = 512;
    p.coarseDirections = 513;
    p.directSamples = 16;
    p.seed = 77;
    return p;
}

double squared(const Vec3& v) {
    return glm::dot(v, v);
}

float meanLight(const SolvedRoom& room) {
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < room.state.irradiance.size(); ++i) {
        sum += room.state.unwrap.texelArea(i) * maxComponent(room.state.irradiance[i]);
        area += room.state.unwrap.texelArea(i);
    }
    return static_cast<float>(sum / area);
}

/// Squares of the error and of the light at a texel of the truth, times its area.
struct Squares {
    double error = 0, light = 0;
};

Squares compare(const Shown& s, const SolvedRoom& truth, float closedOff, std::size_t i) {
    const Unwrap& u = truth.state.unwrap;
    const Unwrap& shownIn = s.state.unwrap;
    if (maxComponent(truth.state.reflectance[i]) <= 0) return {};
    if (maxComponent(truth.state.irradiance[i]) < closedOff) return {};
    const float lift = 1e-4f * s.state.frame.radius;
    Vec3 shown(0);
    float count = 0, covered = 0;
    for (const SurfacePoint& q : u.points.of(i)) {
        const bool front = u.triangleCharts[q.triangle].front == u.texelChart[i];
        const Vec3 p = positionAt(truth.scene, q.triangle, q.barycentric);
        const Vec3 n = (front ? 1.0f : -1.0f) * geometricNormal(truth.scene, q.triangle);
        covered += truth.state.rays.occluded(
            {p + truth.state.rays.epsilon() * n, n, 0, shownIn.texelSize});
        const Hit hit = s.state.rays.closest({p + lift * n, -n, 0, 2 * lift});
        if (!hit) continue;
        const TriangleCharts& charts = shownIn.triangleCharts[hit.triangle];
        const std::uint32_t c =
            glm::dot(geometricNormal(s.scene, hit.triangle), n) > 0 ? charts.front : charts.back;
        if (c == kNoChart) continue;
        shown += s.atlas.sample(shownIn.charts[c], shownIn.charts[c].texelCoordinates(p));
        count += 1;
    }
    if (count == 0 || covered > 0) return {};
    const double area = u.texelArea(i);
    return {area * squared(shown / count - truth.state.irradiance[i]),
            area * squared(truth.state.irradiance[i])};
}

void printRow(const char* name, const Shown& s, const SolvedRoom& truth) {
    std::vector<Squares> squares(truth.state.unwrap.texels.size());
    const float closedOff = kClosedOff * meanLight(truth);
    parallelFor(squares.size(), 256,
                [&](std::size_t i) { squares[i] = compare(s, truth, closedOff, i); });
    Squares sum;
    for (const Squares& q : squares) sum.error += q.error, sum.light += q.light;
    std::printf("| %s | %zu | %zu | %.2f | %.2f %% | %.2f %% |\n", name,
                s.state.unwrap.texels.size(), s.scene.triangles.size(), s.seconds,
                100 * s.error.interpolated(), 100 * std::sqrt(sum.error / sum.light));
    std::fflush(stdout);
}

void run(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "cornell";
    const Scene scene = sceneNamed(name);
    const SolvedRoom truth(scene, truthParams());
    std::printf("%s: the texels of the truth are off by about %.2f %%\n", name.c_str(),
                100 * truth.error.ofTexels());
    std::printf("| bake | texels | triangles | CPU s | between texels: estimated | true |\n");
    std::printf("| --- | ---: | ---: | ---: | ---: | ---: |\n");
    for (int i = 2; i < argc; ++i)
        for (const bool adaptive : {false, true}) {
            BakeParams p = paramsOf(argv[i]);
            p.adaptiveTexels = adaptive;
            const std::string row = std::string(argv[i]) + (adaptive ? ", adaptive" : "");
            printRow(row.c_str(), Shown(scene, p), truth);
        }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(argc, argv);
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
