#pragma once
// Errors a user can cause. Programmer errors are asserts and std::logic_error.

#include <stdexcept>
#include <string>

namespace vlf {

/// Where a user's mistake is: a file and, when known, its 1-based line or the element within it.
struct SourceLocation {
    std::string file;
    int line = 0;         ///< 0: not a line-based place
    std::string element;  ///< e.g. "meshes[3].primitives[0]"; empty: none
};

/// Renders "file:line: element" with the parts that are known.
std::string toString(const SourceLocation& where);

/// Base of everything vlf throws for a reason the user can act on. what() is one line that names
/// the place, what is wrong and what to do.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Input that cannot be used: a malformed scene, a damaged field file, an absurd parameter.
class InputError : public Error {
  public:
    explicit InputError(const std::string& message) : Error(message) {}
    InputError(const SourceLocation& where, const std::string& message)
        : Error(toString(where) + ": " + message) {}
};

/// The file system said no (missing folder, full disk, no permission).
class FileError : public Error {
  public:
    FileError(const std::string& path, const std::string& message)
        : Error(path + ": " + message) {}
};

/// The work was cancelled through its Progress.
class Cancelled : public Error {
  public:
    Cancelled() : Error("cancelled") {}
};

}  // namespace vlf
