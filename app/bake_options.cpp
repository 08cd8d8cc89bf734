#include "bake_options.h"

#include <algorithm>
#include <optional>
#include <string>

namespace vlf::app {

namespace {

std::string checkBounces(const std::string& text) {
    if (text == "auto") return {};
    const bool digits = !text.empty() && text.size() < 5 &&
                        text.find_first_not_of("0123456789") == std::string::npos;
    return digits && std::stoi(text) > 0 ? std::string() : "must be 'auto' or a number above 0";
}

/// "1%" or "0.01" as a number; none if it is neither or not within (0, 1].
std::optional<double> parseShare(std::string text) {
    const bool percent = text.ends_with('%');
    if (percent) text.pop_back();
    double value = 0;
    if (!CLI::detail::lexical_cast(text, value)) return {};
    if (percent) value /= 100;
    return value > 0 && value <= 1 ? std::optional(value) : std::nullopt;
}

std::string shareProblem(const std::string& text) {
    return parseShare(text) ? "" : "must be a share above 0, as in 1% or 0.01";
}

void addRefinementOptions(CLI::Option_group& group, QualityOptions& o) {
    group
        .add_option_function<std::string>(
            "--error", [&o](const std::string& text) { o.error = *parseShare(text); },
            "Refine until the estimated error of the texels is this, as in 1%")
        ->check(shareProblem)
        ->type_name("E");
    group.add_option("--seconds", o.seconds, "Refine as long as this allows")
        ->check(CLI::PositiveNumber);
    group
        .add_option("--refinements", o.refinements,
                    "Refine in so many steps: repeats a bake with --seconds")
        ->check(CLI::Range(1, 100000));
}

}  // namespace

CLI::Option_group* addQualityOptions(CLI::App& command, QualityOptions& o) {
    CLI::Option_group* group =
        command.add_option_group("Quality", "A preset, and single settings that override it");
    group->add_option("--preset", o.preset, "draft, standard or high")
        ->capture_default_str()
        ->check(CLI::IsMember({"draft", "standard", "high"}));
    group->add_option("--directions", o.directions, "Lines of the direction set")
        ->check(CLI::IsMember({129, 513, 2049, 8193}));
    group->add_option("--cells", o.cells, "Rays along one side of a bundle")
        ->check(CLI::Range(16, 8192));
    group->add_option("--texel", o.texel, "Texel size in metres (default: from a budget of texels)")
        ->check(CLI::PositiveNumber);
    group->add_option("--direct-samples", o.samples, "Shadow rays per texel outside penumbrae")
        ->check(CLI::Range(1, 4096));
    group->add_option("--bounces", o.bounces, "auto: until the light has come to rest; or a number")
        ->capture_default_str()
        ->check(checkBounces);
    group
        ->add_option("--radiance-directions", o.radianceDirections,
                     "Lines of the mirrors' radiance field (0: none)")
        ->check(CLI::IsMember({0, 129, 513, 2049, 8193}));
    group->add_option("--radiance-cells", o.radianceCells, "Its cells along one side")
        ->check(CLI::Range(16, 4096));
    group
        ->add_option("--gloss-directions", o.glossDirections,
                     "Lines of the radiance field of rough mirrors (0: none)")
        ->check(CLI::IsMember({0, 129, 513, 2049, 8193}));
    group->add_option("--gloss-cells", o.glossCells, "Its cells along one side")
        ->check(CLI::Range(16, 4096));
    group->add_option("--gloss-samples", o.glossSamples, "Rays per cell of it")
        ->check(CLI::Range(1, 4096));
    group->add_option("--tile", o.tile, "Tiles of both, cells along one side")
        ->check(CLI::IsMember({4, 8, 16, 32, 64}));
    addRefinementOptions(*group, o);
    return group;
}

BakeParams bakeParams(const QualityOptions& o, const Globals& globals) {
    BakeParams p = withSettings(o, presetParams(o.preset));
    p.seed = globals.seed;
    return p;
}

BakeParams withSettings(const QualityOptions& o, BakeParams p) {
    if (o.error > 0 || o.seconds > 0 || o.refinements > 0) p = refiningParams(p, o.error);
    p.seconds = o.seconds;
    p.refinements = o.refinements;
    if (o.directions > 0) p.directions = o.directions;
    if (o.cells > 0) p.cells = o.cells;
    if (o.tile > 0) p.tileSize = o.tile;
    if (o.samples > 0) p.directSamples = o.samples;
    if (o.radianceDirections >= 0) p.radianceDirections = o.radianceDirections;
    if (o.radianceCells > 0) p.radianceCells = o.radianceCells;
    if (o.glossDirections >= 0) p.glossDirections = o.glossDirections;
    if (o.glossCells > 0) p.glossCells = o.glossCells;
    if (o.glossSamples > 0) p.gloss = {o.glossSamples, std::max(1, o.glossSamples / 4)};
    if (o.texel > 0) p.texelSize = o.texel;
    if (o.bounces != "auto") p.maxBounces = std::stoi(o.bounces);
    return p;
}

}  // namespace vlf::app
