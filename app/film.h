#pragma once
// Pictures along a path: films and sequences.

#include "commands.h"
#include "room_renderer.h"

#include <nlohmann/json_fwd.hpp>

namespace vlf::app {

/// Renders the frames of the path, each at its own time whatever the machine takes for it, writes
/// them and the log, and prints a line. Returns a report. Throws InputError for a path or a range
/// that shows nothing, FileError, and Cancelled: a film is then as it was before, pictures of a
/// sequence stay.
nlohmann::ordered_json renderFilm(const RenderOptions& options, const Globals& globals,
                                  RoomRenderer& renderer, const std::vector<Camera>& cameras);

}  // namespace vlf::app
