#pragma once
// The project's own example scenes.

#include "vlf/scene/scene.h"

#include <string>
#include <vector>

namespace vlf {

struct SceneRecipe {
    std::string name;     ///< e.g. "cornell"
    std::string summary;  ///< one line for --help
};

/// All names generateScene knows.
const std::vector<SceneRecipe>& sceneRecipes();

struct SceneOptions {
    int triangles = 0;  ///< wanted triangle count of the statue, where there is one; 0: its default
};

/// Builds the scene `name`, with named cameras. Throws InputError for an unknown name or an
/// option out of range.
Scene generateScene(const std::string& name, const SceneOptions& options = {});

}  // namespace vlf
