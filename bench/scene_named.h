#pragma once
// The scene that a table is about, by its name on the command line.

#include "vlf/scene/generate/generate.h"
#include "vlf/scene/import/import.h"

#include <string>

namespace vlf {

/// A name known to `vlf scene`, or a file, which has a dot in it.
inline Scene sceneNamed(const std::string& name) {
    ImportReport report;
    return name.find('.') != std::string::npos ? importScene({name}, report) : generateScene(name);
}

}  // namespace vlf
