#pragma once
// The environment of a scene on the command line.

#include "vlf/scene/scene.h"

#include <string>

#include <CLI/CLI.hpp>

namespace vlf::app {

struct EnvironmentOptions {
    std::string source;  ///< picture, or radiance as R,G,B; empty: none
    float scale = 1;
    float turn = 0;  ///< degrees
};

/// --environment, --environment-scale and --environment-turn; `options` must outlive the parsing.
/// Returns the first.
CLI::Option* addEnvironmentOptions(CLI::App& command, EnvironmentOptions& options);

/// Black if there is none. Throws as readEnvironment.
Environment environmentOf(const EnvironmentOptions& options);

}  // namespace vlf::app
