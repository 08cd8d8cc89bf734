#pragma once
// The pictures of one eye, or of two in the arrangement that the options ask for.

#include "room_renderer.h"

#include <string>
#include <vector>

namespace vlf::app {

/// What the eye sees, or the left and the right; `report` is of both.
std::vector<Image> renderEyes(RoomRenderer& renderer, const StillParams& params,
                              const StereoOptions& stereo, Progress& progress, StillReport& report);

/// The exposure the options ask for, the same for all of these pictures.
float exposureOf(const PictureOptions& options, const std::vector<Image>& radiance);

/// The pictures to write, one per name of eyeFiles, tone-mapped unless their file holds radiance.
std::vector<Image> develop(const PictureOptions& options, float exposure, StereoLayout layout,
                           std::vector<Image> eyes);

/// The file, or NAME-left.ext and NAME-right.ext.
std::vector<std::string> eyeFiles(StereoLayout layout, const std::string& path);

}  // namespace vlf::app
