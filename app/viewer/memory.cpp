#include "memory.h"

#include "console.h"

#include "vlf/base/error.h"

#include <filesystem>
#include <system_error>
#include <utility>

namespace vlf::app {

namespace {

/// One name for one file, whatever folder it is called from.
std::string fullName(const std::string& file) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::canonical(file, error);
    return error ? file : path.string();
}

}  // namespace

Memory::Memory(std::string path, const std::string& field, bool quiet)
    : path_(std::move(path)), room_(fullName(field)), quiet_(quiet) {
    if (path_.empty()) return;
    try {
        preferences_ = readPreferences(path_);
    } catch (const Error& e) {
        printWarning(quiet_, std::string(e.what()) +
                                 "; nothing is remembered until it is mended or deleted");
        path_.clear();
    }
}

RoomPreferences Memory::room() const {
    const auto found = preferences_.rooms.find(room_);
    return found == preferences_.rooms.end() ? RoomPreferences() : found->second;
}

void Memory::save(const Window& window, const Walkthrough& walk) {
    if (path_.empty()) return;
    try {
        preferences_ = readPreferences(path_);  // another window may have written since
        preferences_.window = window.place();
        preferences_.speedFactor = walk.navigator().speedFactor();
        preferences_.movement = walk.navigator().movement();
        preferences_.rooms[room_] = {walk.navigator().pose(), walk.bookmarks()};
        writePreferences(path_, preferences_);
    } catch (const Error& e) {
        printWarning(quiet_, e.what());
    }
}

}  // namespace vlf::app
