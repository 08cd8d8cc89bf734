#include "scene_input.h"

#include "console.h"

#include "vlf/scene/import/import.h"

namespace vlf::app {

Scene readScenes(const std::vector<std::string>& paths, const Globals& globals) {
    ImportReport report;
    Scene scene = importScene(paths, report);
    for (const std::string& warning : report.warnings) printWarning(globals.quiet, warning);
    return scene;
}

}  // namespace vlf::app
