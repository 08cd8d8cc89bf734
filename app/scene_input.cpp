#include "scene_input.h"

#include "console.h"

#include "vlf/base/error.h"
#include "vlf/scene/import/import.h"

namespace vlf::app {

namespace {

void print(const ImportReport& report, const Globals& globals) {
    for (const std::string& warning : report.warnings) printWarning(globals.quiet, warning);
}

}  // namespace

Scene readScenes(const std::vector<std::string>& paths, const EnvironmentOptions& environment,
                 const Globals& globals) {
    ImportReport report;
    try {
        Scene scene = importScene(paths, report);
        print(report, globals);
        scene.environment = environmentOf(environment);
        return scene;
    } catch (const Error&) {
        print(report, globals);  // they may explain it
        throw;
    }
}

}  // namespace vlf::app
