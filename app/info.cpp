// vlf info: what is inside a field file.

#include "commands.h"
#include "picture_output.h"

#include "vlf/io/field_file.h"
#include "vlf/render/gl/gpu_memory.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

namespace vlf::app {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string file, json;
    bool gpu = false;
};

Json toJson(const Vec3& v) {
    return {v.x, v.y, v.z};
}

/// Stored bytes of a chunk for each of `count` things in it; 0 if there are none.
double bytesPer(const FieldFileInfo& info, const std::string& chunk, std::uint64_t count) {
    const auto found = std::find_if(info.chunks.begin(), info.chunks.end(),
                                    [&](const ChunkInfo& c) { return c.name == chunk; });
    if (count == 0 || found == info.chunks.end()) return 0;
    return static_cast<double>(found->storedBytes) / static_cast<double>(count);
}

double bytesPerTexel(const FieldFileInfo& info) {
    return bytesPer(info, "irradiance", info.counts.texels());
}

/// A radiance field of the file.
struct StoredRadiance {
    const char *title, *chunk;
    const RadianceCounts& counts;
};

std::array<StoredRadiance, 2> radianceFields(const FieldFileInfo& info) {
    return {{{"radiance field", "radiance", info.counts.radiance},
             {"gloss", "gloss", info.counts.gloss}}};
}

ChunkInfo totalOf(const FieldFileInfo& info) {
    ChunkInfo total{"total", 0, 0, 0};
    for (const ChunkInfo& c : info.chunks) {
        total.storedBytes += c.storedBytes;
        total.memoryBytes += c.memoryBytes;
        total.blocks += c.blocks;
    }
    return total;
}

Json toJson(const StoredRadiance& r, const FieldFileInfo& info) {
    const RadianceCounts& c = r.counts;
    return {{"lines", c.lines},
            {"cells", c.cells},
            {"tileSize", c.tileSize},
            {"maxDistance", c.maxDistance},
            {"tileRows", c.tileRows},
            {"elements", c.elements},
            {"filledElements", c.filled},
            {"bytesPerElement", bytesPer(info, r.chunk, c.filled)}};
}

Json toJson(const FieldCounts& c) {
    return {{"triangles", c.triangles},
            {"vertices", c.vertices},
            {"meshes", c.meshes},
            {"materials", c.materials},
            {"textures", c.textures},
            {"texturePixels", c.texturePixels},
            {"cameras", c.cameras},
            {"charts", c.charts},
            {"texels", c.texels()},
            {"atlasWidth", c.atlasWidth},
            {"atlasHeight", c.atlasHeight}};
}

Json toJson(const BakeRecord& r) {
    return {{"programVersion", r.programVersion},
            {"instructionSet", r.instructionSet},
            {"sceneHash", r.sceneHash},
            {"preset", r.preset},
            {"seed", r.seed},
            {"directions", r.directions},
            {"cells", r.cells},
            {"radianceDirections", r.radianceDirections},
            {"radianceCells", r.radianceCells},
            {"glossDirections", r.glossDirections},
            {"glossCells", r.glossCells},
            {"tileSize", r.tileSize},
            {"texelSize", r.texelSize},
            {"directSamples", r.directSamples},
            {"bounces", r.bounces},
            {"residual", r.residual},
            {"texelError", r.texelError},
            {"interpolatedError", r.interpolatedError},
            {"energy",
             {{"emitted", toJson(r.energy.emitted)},
              {"absorbed", toJson(r.energy.absorbed)},
              {"unshot", toJson(r.energy.unshot)},
              {"escaped", toJson(r.energy.escaped)}}}};
}

const char* nameOf(PunctualKind kind) {
    switch (kind) {
        case PunctualKind::point:
            return "point";
        case PunctualKind::spot:
            return "spot";
        default:
            return "directional";
    }
}

Json toJson(const PunctualLight& l) {
    Json json = {{"name", l.name}, {"kind", nameOf(l.kind)}, {"intensity", toJson(l.intensity)}};
    if (l.kind != PunctualKind::directional) json["position"] = toJson(l.position);
    if (l.kind != PunctualKind::point) json["direction"] = toJson(l.direction);
    if (l.kind == PunctualKind::spot)
        json["cones"] = {glm::degrees(l.innerCone), glm::degrees(l.outerCone)};
    return json;
}

/// Null if there is none.
Json toJson(const EnvironmentInfo& e) {
    if (!(maxComponent(e.radiance) > 0)) return nullptr;
    return {{"name", e.name},
            {"radiance", toJson(e.radiance)},
            {"turn", e.turn},
            {"width", e.width},
            {"height", e.height}};
}

double bytesPerGpuElement(const GpuMemory& memory) {
    if (memory.radianceElements == 0) return 0;
    return static_cast<double>(memory.radiance) / static_cast<double>(memory.radianceElements);
}

Json toJson(const GpuMemory& memory) {
    return {{"geometry", memory.geometry},
            {"atlas", memory.atlas},
            {"radiance", memory.radiance},
            {"textures", memory.textures},
            {"total", memory.total()},
            {"radianceElements", memory.radianceElements},
            {"bytesPerElement", bytesPerGpuElement(memory)}};
}

Json toJson(const Options& options, const FieldFileInfo& info) {
    Json cameras = Json::array(), meshes = Json::array(), chunks = Json::array();
    Json lights = Json::array();
    for (const PunctualLight& l : info.lights) lights.push_back(toJson(l));
    for (const Camera& c : info.cameras)
        cameras.push_back({{"name", c.name},
                           {"eye", toJson(c.eye)},
                           {"look", toJson(c.look)},
                           {"up", toJson(c.up)},
                           {"verticalFov", c.verticalFov}});
    for (const Mesh& m : info.meshes)
        meshes.push_back({{"name", m.name}, {"triangles", m.triangleCount}});
    for (const ChunkInfo& c : info.chunks)
        chunks.push_back({{"name", c.name},
                          {"storedBytes", c.storedBytes},
                          {"memoryBytes", c.memoryBytes},
                          {"blocks", c.blocks}});
    return {{"file", options.file},
            {"formatVersion", info.formatVersion},
            {"fileBytes", info.fileBytes},
            {"memoryBytes", totalOf(info).memoryBytes},
            {"bytesPerTexel", bytesPerTexel(info)},
            {"radianceField", toJson(radianceFields(info)[0], info)},
            {"gloss", toJson(radianceFields(info)[1], info)},
            {"counts", toJson(info.counts)},
            {"frame", {{"centre", toJson(info.frame.centre)}, {"radius", info.frame.radius}}},
            {"bake", toJson(info.record)},
            {"cameras", cameras},
            {"lights", lights},
            {"environment", toJson(info.environment)},
            {"meshes", meshes},
            {"chunks", chunks}};
}

/// 999 B, 1.0 kB, ... in powers of 1000.
std::string readableBytes(std::uint64_t bytes) {
    if (bytes < 1000) return fmt::format("{} B", bytes);
    double value = static_cast<double>(bytes);
    for (const char* unit : {"kB", "MB", "GB"}) {
        value /= 1000;
        if (value < 999.95) return fmt::format("{:.1f} {}", value, unit);
    }
    return fmt::format("{:.1f} TB", value / 1000);
}

template <class T>
void printLine(const char* name, const T& value) {
    fmt::print("  {:<20} {}\n", name, value);
}

std::string readable(const EnvironmentInfo& e) {
    const Vec3& r = e.radiance;
    if (!(maxComponent(r) > 0)) return "none";
    const std::string radiance = fmt::format("{:.4g} {:.4g} {:.4g}", r.x, r.y, r.z);
    if (e.width == 0) return radiance + " W/(m² sr) all around";
    return fmt::format("{} ({} x {} pixels) x {}, turned by {:.4g} degrees", e.name, e.width,
                       e.height, radiance, e.turn);
}

void printScene(const FieldFileInfo& info) {
    const FieldCounts& c = info.counts;
    fmt::print("\nscene\n");
    printLine("triangles", c.triangles);
    printLine("vertices", c.vertices);
    printLine("meshes", c.meshes);
    printLine("materials", c.materials);
    printLine("textures", fmt::format("{} ({} pixels)", c.textures, c.texturePixels));
    printLine("sphere",
              fmt::format("centre {:.4g} {:.4g} {:.4g}, radius {:.4g} m", info.frame.centre.x,
                          info.frame.centre.y, info.frame.centre.z, info.frame.radius));
    for (const PunctualLight& l : info.lights)
        printLine("light", fmt::format("{} ({}, {:.4g} {:.4g} {:.4g} {})", l.name, nameOf(l.kind),
                                       l.intensity.x, l.intensity.y, l.intensity.z,
                                       l.kind == PunctualKind::directional ? "W/m²" : "W/sr"));
    printLine("environment", readable(info.environment));
    for (const Camera& camera : info.cameras)
        printLine("camera",
                  fmt::format("{} (at {:.4g} {:.4g} {:.4g}, {:.4g} degrees high)", camera.name,
                              camera.eye.x, camera.eye.y, camera.eye.z, camera.verticalFov));
}

void printLight(const FieldFileInfo& info) {
    const FieldCounts& c = info.counts;
    fmt::print("\nlight\n");
    printLine("charts", c.charts);
    printLine("texels", fmt::format("{} x {}, {:.2f} bytes each on disk", c.atlasWidth,
                                    c.atlasHeight, bytesPerTexel(info)));
    for (const auto& [title, chunk, radiance] : radianceFields(info)) {
        if (radiance.lines == 0) {
            printLine(title, "none");
            continue;
        }
        printLine(title, fmt::format("{} lines x {} x {} cells, tiles of {} x {}", radiance.lines,
                                     radiance.cells, radiance.cells, radiance.tileSize,
                                     radiance.tileSize));
        printLine("elements", fmt::format("{} filled of {}, {:.2f} bytes each on disk",
                                          radiance.filled, radiance.elements,
                                          bytesPer(info, chunk, radiance.filled)));
        printLine("longest distance", fmt::format("{:.4g} m", radiance.maxDistance));
    }
}

void printBake(const BakeRecord& r) {
    fmt::print("\nbake\n");
    printLine("program", fmt::format("vlf {}", r.programVersion));
    printLine("instruction set", r.instructionSet);
    printLine("scene hash", r.sceneHash);
    printLine("preset", r.preset);
    printLine("seed", r.seed);
    printLine("directions", r.directions);
    printLine("cells", r.cells);
    printLine("radiance directions", r.radianceDirections);
    printLine("radiance cells", r.radianceCells);
    printLine("gloss directions", r.glossDirections);
    printLine("gloss cells", r.glossCells);
    printLine("tile size", r.tileSize);
    printLine("texel size", fmt::format("{:.4g} m", r.texelSize));
    printLine("direct samples", r.directSamples);
    printLine("bounces", r.bounces);
    printLine("residual", fmt::format("{:.3g}", r.residual));
    printLine("estimated error",
              fmt::format("{:.2g} % of the texels, {:.2g} % with what lies between",
                          100 * r.texelError, 100 * r.interpolatedError));
}

void printEnergy(const EnergyReport& energy) {
    fmt::print("\nenergy, W            {:>12} {:>12} {:>12}\n", "red", "green", "blue");
    const auto row = [](const char* name, const Vec3& w) {
        fmt::print("  {:<18} {:>12.5g} {:>12.5g} {:>12.5g}\n", name, w.x, w.y, w.z);
    };
    row("emitted", energy.emitted);
    row("absorbed", energy.absorbed);
    row("unshot", energy.unshot);
    row("escaped", energy.escaped);
}

void printChunks(const FieldFileInfo& info) {
    fmt::print("\nchunk                {:>12} {:>12} {:>12}\n", "on disk", "in memory", "blocks");
    const auto row = [](const ChunkInfo& c) {
        fmt::print("  {:<18} {:>12} {:>12} {:>12}\n", c.name, readableBytes(c.storedBytes),
                   readableBytes(c.memoryBytes), c.blocks);
    };
    for (const ChunkInfo& c : info.chunks) row(c);
    row(totalOf(info));
}

void printGpuMemory(const GpuMemory& memory) {
    fmt::print("\nmemory of the GPU\n");
    printLine("geometry", readableBytes(memory.geometry));
    printLine("atlas", readableBytes(memory.atlas));
    printLine("radiance", memory.radianceElements == 0
                              ? std::string("none")
                              : fmt::format("{}, {:.2f} bytes each of {} elements",
                                            readableBytes(memory.radiance),
                                            bytesPerGpuElement(memory), memory.radianceElements));
    printLine("textures", readableBytes(memory.textures));
    printLine("total", readableBytes(memory.total()));
}

void printReport(const Options& options, const FieldFileInfo& info) {
    fmt::print("{}: field file of format version {}, {}\n", options.file, info.formatVersion,
               readableBytes(info.fileBytes));
    printScene(info);
    printLight(info);
    printBake(info.record);
    printEnergy(info.record.energy);
    printChunks(info);
}

std::optional<GpuMemory> gpuMemory(const Options& options) {
    if (!options.gpu) return std::nullopt;
    const BakedRoom room = readField(options.file);
    return gpuMemoryOf(room.scene, room.field);
}

void run(const Options& options) {
    const FieldFileInfo info = readFieldInfo(options.file);
    const std::optional<GpuMemory> memory = gpuMemory(options);
    Json report = toJson(options, info);
    if (memory) report["gpuMemory"] = toJson(*memory);
    if (options.json == "-") {
        fmt::print("{}\n", report.dump(2, ' ', false, Json::error_handler_t::replace));
        return;
    }
    if (!options.json.empty()) writeJson(options.json, report);
    printReport(options, info);
    if (memory) printGpuMemory(*memory);
}

}  // namespace

void addInfo(CLI::App& app, const Globals&) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("info", "Tell what is inside a field file");
    command->add_option("file", options->file, "Field file (.vlf)")->required();
    command->add_option("--json", options->json,
                        "Write everything to this file, or to standard output alone (-)");
    command->add_flag("--gpu", options->gpu,
                      "Tell, too, what the room takes of the GPU's memory: reads all of the file");
    command->footer(
        "Without --gpu reads the table of chunks and the small chunks only, however large the "
        "file.\n\n"
        "Examples:\n"
        "  vlf info room.vlf\n"
        "  vlf info room.vlf --json - | jq .bake");
    command->callback([options] { run(*options); });
}

}  // namespace vlf::app
