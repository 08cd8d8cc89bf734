#pragma once
// New files that overwrite nothing.

#include <functional>
#include <string>

namespace vlf::app {

/// Has `write` make a file STEM-NNNN.EXTENSION of the lowest number from 0001 on that is not taken,
/// in the current folder, and returns its name. Throws FileError, and what `write` throws: there is
/// no such file then.
std::string writeNumberedFile(const std::string& stem, const std::string& extension,
                              const std::function<void(const std::string& name)>& write);

}  // namespace vlf::app
