#include "object_options.h"

#include "console.h"
#include "number_within.h"

#include "vlf/base/error.h"
#include "vlf/dynamic/object_names.h"
#include "vlf/dynamic/scenario_file.h"
#include "vlf/scene/generate/primitives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace vlf::app {

namespace {

constexpr double kFarthest = 1e6;  // metres
constexpr float kSizeInRoom = 0.1f;

struct Paint {
    const char* name;
    Vec3 diffuse{0}, mirror{0}, emission{0};
};

/// White, red and green are the walls of the Cornell box.
constexpr std::array kPaints{Paint{"white", {0.725f, 0.71f, 0.68f}},
                             Paint{"grey", Vec3(0.5f)},
                             Paint{"black", Vec3(0.04f)},
                             Paint{"red", {0.63f, 0.065f, 0.05f}},
                             Paint{"green", {0.14f, 0.45f, 0.091f}},
                             Paint{"blue", {0.08f, 0.12f, 0.55f}},
                             Paint{"yellow", {0.75f, 0.6f, 0.08f}},
                             Paint{"mirror", Vec3(0), Vec3(0.9f)},
                             Paint{"glossy", Vec3(0.4f), Vec3(0.4f)},
                             Paint{"lamp", Vec3(0.8f), Vec3(0), Vec3(10)}};

/// The parts of --object.
struct Spelling {
    std::string shape;
    std::vector<std::string> details;  ///< behind colons, of a primitive
    std::optional<Vec3> place;
};

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

std::optional<float> number(const std::string& text, double least, double most) {
    double value = 0;
    if (text.empty() || !CLI::detail::lexical_cast(text, value)) return {};
    if (!(value >= least && value <= most)) return {};
    return static_cast<float>(value);
}

std::optional<Vec3> threeNumbers(const std::string& text, double least, double most) {
    const std::vector<std::string> parts = split(text, ',');
    if (parts.size() != 3) return {};
    Vec3 v;
    for (int i = 0; i < 3; ++i) {
        const auto part = number(parts[static_cast<std::size_t>(i)], least, most);
        if (!part) return {};
        v[i] = *part;
    }
    return v;
}

bool isPrimitive(const std::string& name) {
    const std::vector<std::string>& names = primitiveNames();
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// A place is what three numbers behind the last @ are; file names may hold an @ as well.
Spelling spellingOf(std::string text) {
    Spelling spelling;
    const std::size_t at = text.rfind('@');
    if (at != std::string::npos)
        spelling.place = threeNumbers(text.substr(at + 1), -kFarthest, kFarthest);
    if (spelling.place) text.resize(at);
    std::vector<std::string> parts = split(text, ':');
    if (isPrimitive(parts.front())) {
        spelling.shape = parts.front();
        spelling.details.assign(parts.begin() + 1, parts.end());
    } else {
        spelling.shape = text;
    }
    return spelling;
}

std::string paintNames() {
    std::string names;
    for (const Paint& paint : kPaints)
        names += (names.empty() ? "" : ", ") + std::string(paint.name);
    return names;
}

/// False: the text is no material.
bool setMaterial(const std::string& text, ObjectSource& source) {
    source.mirror = source.emission = Vec3(0);
    if (const auto diffuse = threeNumbers(text, 0, 1)) {
        source.diffuse = *diffuse;
        return true;
    }
    for (const Paint& paint : kPaints) {
        if (text != paint.name) continue;
        source.diffuse = paint.diffuse;
        source.mirror = paint.mirror;
        source.emission = paint.emission;
        return true;
    }
    return false;
}

/// What is wrong with the text of --object; empty: nothing. Puts size and material where they
/// belong.
std::string applyDetails(const Spelling& spelling, float& size, ObjectSource& source) {
    bool sized = false, painted = false;
    for (const std::string& detail : spelling.details) {
        if (const auto metres = number(detail, 1e-6, 1e6); metres && !sized) {
            size = *metres;
            sized = true;
        } else if (!painted && setMaterial(detail, source)) {
            painted = true;
        } else {
            return fmt::format(
                "'{}' is neither a size in metres nor a material: {}, or reflectances R,G,B from 0 "
                "to 1; as in cube:0.3:red@1,0.15,2",
                detail, paintNames());
        }
    }
    return {};
}

std::string objectProblem(const std::string& text) {
    const Spelling spelling = spellingOf(text);
    float size = 0;
    ObjectSource source;
    if (const std::string problem = applyDetails(spelling, size, source); !problem.empty())
        return problem;
    const std::string extension = std::filesystem::path(spelling.shape).extension().string();
    if (isPrimitive(spelling.shape) || extension == ".obj" || extension == ".gltf" ||
        extension == ".glb")
        return {};
    return fmt::format(
        "'{}' is neither a scene file (.obj, .gltf, .glb) nor one of {}, with @X,Y,Z behind it for "
        "its place",
        text, fmt::join(primitiveNames(), ", "));
}

template <typename Names>
std::string choices(const Names& names) {
    std::string text;
    for (const auto& named : names) text += (text.empty() ? "" : "|") + std::string(named.name);
    return text;
}

template <typename Value, typename Names>
void addNamed(CLI::App& command, const char* option, Value& value, const Names& names,
              const char* meaning) {
    std::map<std::string, Value> values;
    for (const auto& named : names) values[named.name] = named.value;
    command.add_option(option, value, meaning)
        ->transform(CLI::CheckedTransformer(values))
        ->option_text(fmt::format("{} [{}]", choices(names), nameAmong(names, value)));
}

}  // namespace

void addObjectOptions(CLI::App& command, ObjectOptions& options) {
    command.add_option("--object", options.objects, "Put this into the room; see below")
        ->check(objectProblem, "object")
        ->allow_extra_args(false)
        ->type_name("OBJECT")
        ->group("Objects");
    command
        .add_option("--scenario", options.scenario,
                    "Put the objects of this file into the room (.json)")
        ->type_name("FILE")
        ->group("Objects");
    addNamed(command, "--shading", options.defaults.shading, kShadingNames,
             "How objects are lit, unless the scenario says");
    addNamed(command, "--shadow", options.defaults.shadow, kShadowNames,
             "What of their shadow and light the room gets");
    for (const char* name : {"--shading", "--shadow"}) command.get_option(name)->group("Objects");
}

CLI::Option* addMomentOption(CLI::App& command, ObjectOptions& options) {
    return command.add_option("--moment", options.moment, "Of the scenario, for stills [0]")
        ->check(numberWithin(0, 86400))
        ->type_name("SECONDS")
        ->group("Objects")
        ->needs("--scenario");
}

std::string objectHelp() {
    return fmt::format(
        "Objects:\n"
        "  --object SHAPE[:SIZE][:MATERIAL][@X,Y,Z]\n"
        "  --object FILE[@X,Y,Z]\n"
        "    SHAPE     {}\n"
        "    SIZE      from side to side, in metres [a tenth of the room]\n"
        "    MATERIAL  {}; or\n"
        "              diffuse reflectances R,G,B from 0 to 1 [white]\n"
        "    FILE      .obj, .gltf or .glb, in metres\n"
        "    X,Y,Z     of the middle of a shape, or the origin of a file [middle of the room]\n"
        "  --object cube                                       white, in the middle\n"
        "  --object cube:0.1:red@1,0.05,2                      10 cm, on the floor\n"
        "  --object sphere:mirror --object chair.glb@1,0,2     two\n",
        fmt::join(primitiveNames(), ", "), paintNames());
}

float suitableSize(const Scene& room) {
    const Vec3 size = boundsOf(room).size();
    const float most = maxComponent(size);
    float least = most;
    for (int axis = 0; axis < 3; ++axis)
        if (size[axis] > 0.01f * most) least = std::min(least, size[axis]);
    return kSizeInRoom * least;
}

ScenarioObject parseObject(const std::string& text, const Scene& room,
                           const ObjectSettings& settings, const Vec3& fallback) {
    if (const std::string problem = objectProblem(text); !problem.empty())
        throw InputError(problem);
    const Spelling spelling = spellingOf(text);
    ScenarioObject object;
    object.object.settings = settings;
    object.object.pose.translation = spelling.place.value_or(fallback);
    if (isPrimitive(spelling.shape)) {
        object.source.primitive = object.object.name = spelling.shape;
        object.object.pose.scale = suitableSize(room);
        setMaterial("white", object.source);
        applyDetails(spelling, object.object.pose.scale, object.source);
    } else {
        object.source.file = spelling.shape;
        object.object.name = std::filesystem::path(spelling.shape).stem().string();
    }
    return object;
}

Scenario readObjects(const ObjectOptions& options, const Scene& room, ModelLibrary& library,
                     const Globals& globals) {
    Scenario scenario;
    std::vector<std::string> warnings;
    if (!options.scenario.empty())
        scenario = readScenario(options.scenario, options.defaults, library, warnings);
    for (const std::string& text : options.objects) {
        ScenarioObject object = parseObject(text, room, options.defaults, boundsOf(room).centre());
        object.object.name = unusedName(scenario, object.object.name);
        scenario.objects.push_back(std::move(object));
        try {
            loadModels(scenario, library, warnings);
        } catch (const Error& e) {
            throw InputError(fmt::format("--object {}: {}", text, e.what()));
        }
    }
    for (const std::string& warning : warnings) printWarning(globals.quiet, warning);
    return scenario;
}

Walk readWalk(const std::string& file, const ObjectOptions& options, ModelLibrary& library,
              const Globals& globals) {
    std::vector<std::string> warnings;
    Walk walk = vlf::readWalk(file, library, warnings);
    for (const std::string& warning : warnings) printWarning(globals.quiet, warning);
    if (options.any() && !walk.objects.objects.empty())
        throw InputError(file +
                         ": holds objects of its own; leave out --object and --scenario, or follow "
                         "a path without \"objects\"");
    return walk;
}

}  // namespace vlf::app
