#pragma once
// Scenarios as files, docs/scenario.md.

#include "vlf/dynamic/scenario.h"

#include <string>
#include <string_view>
#include <vector>

namespace vlf {

/// The objects in the text of a file, without their models; files they name are relative to the
/// folder of `name`. `defaults` has the settings that an object does not state. Throws InputError
/// that names file and element and what is wrong with it.
Scenario parseScenario(std::string_view text, const std::string& name,
                       const ObjectSettings& defaults = {});

/// The text of a file at `name`; parsing it gives an equal scenario, rotations to seven digits.
std::string toText(const Scenario& scenario, const std::string& name);

/// With models. What importers remark is added to `warnings`. Throws InputError as parseScenario
/// and for objects whose file cannot be used, and FileError.
Scenario readScenario(const std::string& file, const ObjectSettings& defaults,
                      ModelLibrary& library, std::vector<std::string>& warnings);

/// Throws FileError; what was there before is then left.
void writeScenario(const std::string& file, const Scenario& scenario);

}  // namespace vlf
