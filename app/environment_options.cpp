#include "environment_options.h"

#include "number_within.h"

#include "vlf/base/error.h"

#include <cstdio>
#include <optional>

namespace vlf::app {

namespace {

constexpr float kBrightest = 1e9f;

/// Three numbers with commas between them.
std::optional<Vec3> parseRadiance(const std::string& text) {
    Vec3 v(0);
    char rest = 0;
    if (std::sscanf(text.c_str(), "%f,%f,%f%c", &v.x, &v.y, &v.z, &rest) != 3) return std::nullopt;
    return v;
}

/// Empty if the text may name an environment, else what is wrong with it (a CLI11 validator).
std::string sourceProblem(const std::string& text) {
    const std::optional<Vec3> radiance = parseRadiance(text);
    if (!radiance) return text.empty() ? "must be a picture or R,G,B" : "";
    const auto fine = [](float x) { return x >= 0 && x <= kBrightest; };
    return fine(radiance->x) && fine(radiance->y) && fine(radiance->z)
               ? ""
               : "must be three radiances from 0 to 1e9 W/(m² sr)";
}

}  // namespace

CLI::Option* addEnvironmentOptions(CLI::App& command, EnvironmentOptions& options) {
    CLI::Option* source =
        command
            .add_option("--environment", options.source,
                        "What surrounds the scene: an equirectangular picture (.hdr, .exr), or one "
                        "radiance all around, in W/(m² sr)")
            ->type_name("FILE|R,G,B")
            ->check(sourceProblem);
    command.add_option("--environment-scale", options.scale, "Multiplies its radiance")
        ->capture_default_str()
        ->needs(source)
        ->check(numberWithin(0, 1e6));
    command
        .add_option("--environment-turn", options.turn,
                    "Turns the picture, in degrees, counter-clockwise seen from above")
        ->capture_default_str()
        ->needs(source)
        ->check(numberWithin(-360, 360));
    return source;
}

Environment environmentOf(const EnvironmentOptions& options) {
    Environment environment;
    if (options.source.empty()) return environment;
    if (const std::optional<Vec3> radiance = parseRadiance(options.source))
        environment.radiance = *radiance;
    else
        environment = readEnvironment(options.source);
    environment.radiance *= options.scale;
    environment.turn = options.turn;
    return environment;
}

}  // namespace vlf::app
