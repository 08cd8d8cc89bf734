#pragma once
// What lies over the picture to be read only.

#include "vlf/display/frame_statistics.h"
#include "vlf/render/gl/renderer.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vlf::app {

/// Work at parts of a frame, in order.
using PassTimes = std::vector<std::pair<std::string, std::optional<double>>>;  ///< milliseconds

/// One line at the bottom; `opacity` in [0, 1].
void drawMessage(const std::string& text, float opacity);

/// One line in the lower left corner: what is under way.
void drawStatus(const std::string& text);

/// Something the user must know until it is mended.
void drawProblem(const std::string& text);

/// The table of keys, in the middle.
void drawHelp();

/// In the upper right corner.
void drawStatistics(const FrameStatistics& frames, const PassTimes& passes,
                    const GpuMemory& memory);

}  // namespace vlf::app
