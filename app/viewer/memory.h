#pragma once
// What `vlf view` remembers of a field file from one time to the next.

#include "walkthrough.h"

#include "vlf/display/preferences.h"
#include "vlf/display/window.h"

#include <string>

namespace vlf::app {

class Memory {
  public:
    /// Reads `path`; empty: remembers nothing. A file that cannot be used is a warning: nothing is
    /// remembered, and the file is left as it is.
    Memory(std::string path, const std::string& field, bool quiet);

    const Preferences& preferences() const { return preferences_; }
    RoomPreferences room() const;

    /// Writes how things are now, beside what the file holds of other rooms. A failure is a
    /// warning.
    void save(const Window& window, const Walkthrough& walk);

  private:
    std::string path_, room_;
    bool quiet_;
    Preferences preferences_;
};

}  // namespace vlf::app
