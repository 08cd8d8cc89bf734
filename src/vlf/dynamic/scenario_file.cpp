#include "vlf/dynamic/scenario_file.h"

#include "vlf/base/file.h"
#include "vlf/dynamic/scenario_json.h"

#include <filesystem>

namespace vlf {

namespace {

constexpr const char* kFormat = "vlf scenario";
constexpr int kVersion = 1;

std::string folderOf(const std::string& file) {
    return std::filesystem::path(file).parent_path().string();
}

/// The array of objects. `root` must outlive it.
JsonElement objectsOf(const nlohmann::json& root, const std::string& name) {
    const JsonElement file{root, {name, 0, ""}};
    if (!root.is_object() || !root.contains("format") || root["format"] != kFormat)
        file.fail(
            fmt::format("is no scenario: it must hold an object with \"format\": \"{}\"", kFormat));
    if (!root.contains("version")) file.fail("has no \"version\"");
    const nlohmann::json& version = root["version"];
    if (!version.is_number_integer() || version != kVersion)
        file.member("version").fail(
            fmt::format("must be {}; a file of a later version needs a later program", kVersion));
    file.requireMembers({"format", "version", "objects"});
    return file.member("objects");
}

}  // namespace

Scenario parseScenario(std::string_view text, const std::string& name,
                       const ObjectSettings& defaults) {
    const nlohmann::json root = parseJson(text, name);
    return readObjects(objectsOf(root, name), folderOf(name), defaults);
}

std::string toText(const Scenario& scenario, const std::string& name) {
    return fmt::format("{{\n  \"format\": \"{}\",\n  \"version\": {},\n  \"objects\": {}\n}}\n",
                       kFormat, kVersion, objectsToText(scenario, folderOf(name)));
}

Scenario readScenario(const std::string& file, const ObjectSettings& defaults,
                      ModelLibrary& library, std::vector<std::string>& warnings) {
    const std::vector<std::uint8_t> bytes = readFile(file);
    const nlohmann::json root =
        parseJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file);
    const JsonElement objects = objectsOf(root, file);
    Scenario scenario = readObjects(objects, folderOf(file), defaults);
    loadModels(objects, scenario, library, warnings);
    return scenario;
}

void writeScenario(const std::string& file, const Scenario& scenario) {
    const std::string text = toText(scenario, file);
    writeFile(file, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace vlf
