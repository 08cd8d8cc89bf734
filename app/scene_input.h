#pragma once
// Reading the scene files of a command line.

#include "commands.h"
#include "environment_options.h"

#include "vlf/scene/scene.h"

#include <string>
#include <vector>

namespace vlf::app {

/// The files merged, in their environment; what the importers remark goes to standard error. Throws
/// as importScene and readEnvironment.
Scene readScenes(const std::vector<std::string>& paths, const EnvironmentOptions& environment,
                 const Globals& globals);

}  // namespace vlf::app
