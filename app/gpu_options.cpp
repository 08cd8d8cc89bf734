#include "gpu_options.h"

#include "console.h"

namespace vlf::app {

void addGpuOptions(CLI::App& command, RendererOptions& options) {
    command
        .add_option("--gpu-memory", options.maxMemory,
                    "OpenGL: show mirrors coarser rather than take more memory of the GPU than "
                    "this; bytes, or with k, M, G (powers of 1000)")
        ->transform(CLI::AsSizeValue(true))
        ->check(CLI::PositiveNumber)
        ->type_name("SIZE");
}

void printNotices(bool quiet, const Renderer& renderer) {
    for (const std::string& notice : renderer.notices()) printWarning(quiet, notice);
}

}  // namespace vlf::app
