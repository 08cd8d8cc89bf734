#pragma once
// Objects in the room, asked for on the command line.

#include "commands.h"

#include "vlf/display/camera_path_file.h"
#include "vlf/dynamic/scenario.h"

#include <optional>
#include <string>
#include <vector>

namespace vlf::app {

struct ObjectOptions {
    std::vector<std::string> objects;  ///< see objectHelp
    std::string scenario;              ///< file; empty: none
    ObjectSettings defaults;           ///< of objects, where the scenario does not state them
    double moment = 0;                 ///< of the scenario, s, that a still shows

    bool any() const { return !objects.empty() || !scenario.empty(); }
};

/// Declares --object, --scenario, --shading and --shadow. `options` must outlive the parsing.
void addObjectOptions(CLI::App& command, ObjectOptions& options);

/// Declares --moment, which needs --scenario. To be called after addObjectOptions.
CLI::Option* addMomentOption(CLI::App& command, ObjectOptions& options);

/// How --object is written, for the foot of the help.
std::string objectHelp();

/// The objects of the scenario, then the others, with their models. `room` gives sizes and places
/// that are not stated. Throws InputError naming option or file, and FileError.
Scenario readObjects(const ObjectOptions& options, const Scene& room, ModelLibrary& library,
                     const Globals& globals);

/// The walk in a file. Throws as vlf::readWalk, and InputError if it holds objects although the
/// options ask for some.
Walk readWalk(const std::string& file, const ObjectOptions& options, ModelLibrary& library,
              const Globals& globals);

/// One object written as for --object, without its model; at `fallback` if no place is stated.
/// Throws InputError.
ScenarioObject parseObject(const std::string& text, const Scene& room,
                           const ObjectSettings& settings, const Vec3& fallback);

/// A size, metres, that suits a primitive in this room.
float suitableSize(const Scene& room);

}  // namespace vlf::app
