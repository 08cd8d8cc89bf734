#pragma once
// Reading the scene files of a command line.

#include "commands.h"

#include "vlf/scene/scene.h"

#include <string>
#include <vector>

namespace vlf::app {

/// The files merged; what the importers remark goes to standard error. Throws as importScene.
Scene readScenes(const std::vector<std::string>& paths, const Globals& globals);

}  // namespace vlf::app
