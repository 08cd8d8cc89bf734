#pragma once
// What the importers put into their report.

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

/// Adds a file that is about to be read, or that is missing, to the report, once.
inline void noteFile(ImportReport& report, const std::string& path) {
    FileStamp stamp = stampOf(path);
    const auto isSame = [&](const FileStamp& other) { return other.path == path; };
    if (std::none_of(report.files.begin(), report.files.end(), isSame))
        report.files.push_back(std::move(stamp));
}

}  // namespace vlf
