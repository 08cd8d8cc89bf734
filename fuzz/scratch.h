#pragma once
// A folder of this process in memory, where that exists, for functions that read files by name.

#include "fuzz/readers.h"

#include <string>

namespace vlf::fuzz {

/// Name of a file in the folder, which goes when the process ends.
std::string scratchPath(const std::string& name);

/// Writes the file and returns its name.
std::string putFile(const std::string& name, Bytes bytes);

Blob toBlob(const std::string& text);

}  // namespace vlf::fuzz
