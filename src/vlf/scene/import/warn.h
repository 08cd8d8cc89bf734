#pragma once
// Warnings of the importers.

#include "vlf/base/error.h"
#include "vlf/scene/import/import.h"

#include <algorithm>

namespace vlf {

/// Adds "where: message" to the report, once.
inline void warn(ImportReport& report, const SourceLocation& where, const std::string& message) {
    std::string line = toString(where) + ": " + message;
    auto& all = report.warnings;
    if (std::find(all.begin(), all.end(), line) == all.end()) all.push_back(std::move(line));
}

}  // namespace vlf
