// The estimated error of bakes against the true one, over all texels: a table of
// docs/benchmarks.md.
//
//     estimate_table SCENE [draft | standard | high][,ERROR%] ...
//
// The truth is a bake of the same texels with 8193 lines and 64 shadow rays, whose own error the
// last column of its line tells. Texels are those of "standard". SCENE is a name known to `vlf
// scene` or a file.

#include "scene_named.h"
#include "solved_room.h"
#include "vlf/base/error.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

using namespace vlf;
using bench::SolvedRoom;

namespace {

BakeParams withTexelsOfStandard(BakeParams p) {
    p.texelBudget = presetParams("standard").texelBudget;
    return p;
}

BakeParams paramsOf(const std::string& text) {
    const std::size_t comma = text.find(',');
    BakeParams p = presetParams(text.substr(0, comma));
    if (comma != std::string::npos) p = refiningParams(p, std::stod(text.substr(comma + 1)) / 100);
    return withTexelsOfStandard(p);
}

BakeParams truthParams() {
    BakeParams p = withTexelsOfStandard(presetParams("standard"));
    p.directions = 8193;
    p.directSamples = 64;
    p.tolerance = 1e-4;
    p.seed = 77;
    return p;
}

double squared(const Vec3& v) {
    return glm::dot(v, v);
}

void compare(const std::string& name, const SolvedRoom& s, const SolvedRoom& truth) {
    if (s.state.irradiance.size() != truth.state.irradiance.size())
        throw InputError("the truth has other texels");
    double direct = 0, indirect = 0, all = 0, light = 0;
    for (std::size_t i = 0; i < s.state.irradiance.size(); ++i) {
        if (maxComponent(s.state.reflectance[i]) <= 0) continue;
        const double area = s.state.unwrap.texelArea(i);
        const Vec3 d = s.state.directIrradiance[i] - truth.state.directIrradiance[i];
        const Vec3 e = s.state.irradiance[i] - truth.state.irradiance[i];
        direct += area * squared(d);
        indirect += area * squared(e - d);
        all += area * squared(e);
        light += area * squared(truth.state.irradiance[i]);
    }
    const auto percent = [&](double sum) { return 100 * std::sqrt(sum / light); };
    const double estimate = 100 * s.error.ofTexels();
    std::printf("| %s | %.2f | %.2f / %.2f | %.2f / %.2f | %.2f / %.2f | %.2f |\n", name.c_str(),
                s.seconds, 100 * s.error.direct, percent(direct), 100 * s.error.indirect,
                percent(indirect), estimate, percent(all), estimate / percent(all));
    std::fflush(stdout);
}

void run(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "cornell";
    const Scene scene = sceneNamed(name);
    const SolvedRoom truth(scene, truthParams());
    std::printf("%s: the truth's own error is about %.2f %%\n", name.c_str(),
                100 * truth.error.ofTexels());
    std::printf("| bake | CPU s | direct: estimated / true, %% | indirect | all | ratio |\n");
    for (int i = 2; i < argc; ++i) compare(argv[i], SolvedRoom(scene, paramsOf(argv[i])), truth);
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
