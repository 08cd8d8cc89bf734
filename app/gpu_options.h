#pragma once
// The command line of what draws by OpenGL.

#include "vlf/render/gl/renderer.h"

#include <CLI/CLI.hpp>

namespace vlf::app {

/// Declares --gpu-memory. `options` must outlive the parsing.
void addGpuOptions(CLI::App& command, RendererOptions& options);

/// A warning for each of the renderer's notices, unless quiet.
void printNotices(bool quiet, const Renderer& renderer);

}  // namespace vlf::app
