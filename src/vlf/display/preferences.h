#pragma once
// What the walkthrough window remembers from one time to the next, as a JSON file.

#include "vlf/display/camera_pose.h"
#include "vlf/display/navigation.h"
#include "vlf/display/window.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vlf {

struct Bookmark {
    std::string name;
    CameraPose pose;

    bool operator==(const Bookmark&) const = default;
};

/// Of one field file.
struct RoomPreferences {
    std::optional<CameraPose> pose;  ///< where the walk ended
    std::vector<Bookmark> bookmarks;

    bool operator==(const RoomPreferences&) const = default;
};

struct Preferences {
    std::optional<WindowPlace> window;
    float speedFactor = 1;
    Movement movement = Movement::fly;
    std::map<std::string, RoomPreferences> rooms;  ///< by the full name of the field file

    bool operator==(const Preferences&) const = default;
};

/// $XDG_CONFIG_HOME/vlf/view.json, or ~/.config/vlf/view.json; empty if there is no home.
std::string preferencesPath();

/// No such file: the defaults. Throws FileError if it cannot be read, and InputError that names the
/// element if it is damaged or a number is out of range.
Preferences readPreferences(const std::string& path);

/// Makes the file's folder, too. Throws FileError; the old file is then left as it was.
void writePreferences(const std::string& path, const Preferences& preferences);

}  // namespace vlf
