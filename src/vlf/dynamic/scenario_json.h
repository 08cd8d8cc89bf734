#pragma once
// The objects of a scenario as JSON: for the files that hold some. Needs nlohmann_json.

#include "vlf/dynamic/scenario.h"
#include "vlf/scene/import/json_element.h"

#include <string>

namespace vlf {

/// An array of objects, docs/scenario.md, without their models. File names are relative to
/// `folder`; `defaults` has the settings that an object does not state. Throws InputError naming
/// the element.
Scenario readObjects(const JsonElement& array, const std::string& folder,
                     const ObjectSettings& defaults);

/// Throws InputError, naming the element of `array`, if an object's file cannot be used.
void loadModels(const JsonElement& array, Scenario& scenario, ModelLibrary& library,
                std::vector<std::string>& warnings);

/// The array as text, its lines indented by two spaces; file names relative to `folder`.
std::string objectsToText(const Scenario& scenario, const std::string& folder);

}  // namespace vlf
