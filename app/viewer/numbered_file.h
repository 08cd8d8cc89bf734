#pragma once
// Names of new files.

#include <string>

namespace vlf::app {

/// Makes an empty file STEM-NNNN.EXTENSION of the lowest number from 0001 on that is not taken, in
/// the current folder, and returns its name: it is the caller's, nothing is ever overwritten.
/// Throws FileError.
std::string makeNumberedFile(const std::string& stem, const std::string& extension);

}  // namespace vlf::app
