#pragma once
// What the importers put into their report.

#include "vlf/base/error.h"
#include "vlf/scene/import/import.h"

#include <algorithm>

namespace vlf {

/// Most remarks of a report: nobody reads more, and each is compared with all before it.
inline constexpr std::size_t kMostWarnings = 1000;

/// Adds "where: message" to the report, once; of more than kMostWarnings the rest is left out.
inline void warn(ImportReport& report, const SourceLocation& where, const std::string& message) {
    auto& all = report.warnings;
    if (all.size() > kMostWarnings) return;
    std::string line = all.size() < kMostWarnings ? toString(where) + ": " + message
                                                  : where.file + ": further remarks are left out";
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
