#include "vlf/display/preferences.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vlf {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr int kLargestWindow = 1 << 15;  // units of the desktop
constexpr float kFarthest = 1e9f;        // metres

/// An element of the file, which knows its place in it for messages.
class Element {
  public:
    Element(const ordered_json& value, SourceLocation where)
        : value_(value), where_(std::move(where)) {}

    [[noreturn]] void fail(const std::string& message) const { throw InputError(where_, message); }

    Element member(const std::string& name) const {
        if (!has(name)) fail("has no \"" + name + "\"");
        return within(value_.at(name), (where_.element.empty() ? "" : ".") + name);
    }
    bool has(const std::string& name) const {
        if (!value_.is_object()) fail("must be an object");
        return value_.contains(name);
    }
    std::vector<Element> elements() const {
        if (!value_.is_array()) fail("must be an array");
        std::vector<Element> all;
        for (std::size_t i = 0; i < value_.size(); ++i)
            all.push_back(within(value_[i], fmt::format("[{}]", i)));
        return all;
    }
    float number(float least, float most) const {
        const double number = value_.is_number() ? value_.get<double>() : std::nan("");
        if (!(number >= least && number <= most))
            fail("must be a number from " + ordered_json(least).dump() + " to " +
                 ordered_json(most).dump());
        return static_cast<float>(number);
    }
    int whole(int least, int most) const {
        return static_cast<int>(number(static_cast<float>(least), static_cast<float>(most)));
    }
    std::string text() const {
        if (!value_.is_string()) fail("must be a string");
        return value_.get<std::string>();
    }
    const ordered_json& value() const { return value_; }

  private:
    Element within(const ordered_json& value, const std::string& step) const {
        return {value, {where_.file, 0, where_.element + step}};
    }

    const ordered_json& value_;
    SourceLocation where_;
};

CameraPose readPose(const Element& e) {
    const std::vector<Element> eye = e.member("eye").elements();
    if (eye.size() != 3) e.member("eye").fail("must be three numbers");
    CameraPose pose;
    for (int axis = 0; axis < 3; ++axis) pose.eye[axis] = eye[axis].number(-kFarthest, kFarthest);
    pose.yaw = e.member("yaw").number(-10, 10);
    pose.pitch = e.member("pitch").number(-CameraPose::kMostPitch, CameraPose::kMostPitch);
    pose.verticalFov = e.member("verticalFov").number(0.01f, 179);
    return pose;
}

WindowPlace readPlace(const Element& e) {
    WindowPlace place;
    place.width = e.member("width").whole(1, kLargestWindow);
    place.height = e.member("height").whole(1, kLargestWindow);
    if (e.has("x")) place.x = e.member("x").whole(-kLargestWindow, kLargestWindow);
    if (e.has("y")) place.y = e.member("y").whole(-kLargestWindow, kLargestWindow);
    return place;
}

Movement readMovement(const Element& e) {
    const std::string name = e.text();
    if (name != "walk" && name != "fly") e.fail("must be \"fly\" or \"walk\"");
    return name == "walk" ? Movement::walk : Movement::fly;
}

RoomPreferences readRoom(const Element& e) {
    RoomPreferences room;
    if (e.has("pose")) room.pose = readPose(e.member("pose"));
    if (e.has("bookmarks"))
        for (const Element& bookmark : e.member("bookmarks").elements())
            room.bookmarks.push_back(
                {bookmark.member("name").text(), readPose(bookmark.member("pose"))});
    return room;
}

Preferences readAll(const Element& e) {
    Preferences p;
    if (e.has("window")) p.window = readPlace(e.member("window"));
    if (e.has("speed"))
        p.speedFactor = e.member("speed").number(Navigator::kLeastSpeed, Navigator::kMostSpeed);
    if (e.has("movement")) p.movement = readMovement(e.member("movement"));
    if (e.has("rooms")) {
        const Element rooms = e.member("rooms");
        if (!rooms.value().is_object()) rooms.fail("must be an object");
        for (const auto& [name, value] : rooms.value().items())
            p.rooms[name] = readRoom(rooms.member(name));
    }
    return p;
}

ordered_json toJson(const CameraPose& pose) {
    return {{"eye", {pose.eye.x, pose.eye.y, pose.eye.z}},
            {"yaw", pose.yaw},
            {"pitch", pose.pitch},
            {"verticalFov", pose.verticalFov}};
}

ordered_json toJson(const WindowPlace& place) {
    ordered_json json{{"width", place.width}, {"height", place.height}};
    if (place.x) json["x"] = *place.x;
    if (place.y) json["y"] = *place.y;
    return json;
}

ordered_json toJson(const RoomPreferences& room) {
    ordered_json json = ordered_json::object();
    if (room.pose) json["pose"] = toJson(*room.pose);
    json["bookmarks"] = ordered_json::array();
    for (const Bookmark& bookmark : room.bookmarks)
        json["bookmarks"].push_back({{"name", bookmark.name}, {"pose", toJson(bookmark.pose)}});
    return json;
}

ordered_json toJson(const Preferences& p) {
    ordered_json json = ordered_json::object();
    if (p.window) json["window"] = toJson(*p.window);
    json["speed"] = p.speedFactor;
    json["movement"] = p.movement == Movement::walk ? "walk" : "fly";
    json["rooms"] = ordered_json::object();
    for (const auto& [name, room] : p.rooms) json["rooms"][name] = toJson(room);
    return json;
}

}  // namespace

std::string preferencesPath() {
    // The XDG Base Directory Specification has paths that are not absolute ignored.
    if (const char* folder = std::getenv("XDG_CONFIG_HOME"); folder && *folder == '/')
        return (fs::path(folder) / "vlf" / "view.json").string();
    if (const char* home = std::getenv("HOME"); home && *home)
        return (fs::path(home) / ".config" / "vlf" / "view.json").string();
    return {};
}

Preferences readPreferences(const std::string& path) {
    std::error_code error;
    if (fs::status(path, error).type() == fs::file_type::not_found) return {};
    const std::vector<std::uint8_t> bytes = readFile(path);
    ordered_json root;
    try {
        root = ordered_json::parse(bytes.begin(), bytes.end());
    } catch (const nlohmann::json::exception& e) {
        throw InputError({path, 0, ""}, e.what());
    }
    return readAll(Element(root, {path, 0, ""}));
}

void writePreferences(const std::string& path, const Preferences& preferences) {
    std::error_code error;
    fs::create_directories(fs::path(path).parent_path(), error);
    if (error) throw FileError(path, "cannot make its folder: " + error.message());
    // Names of files need not be UTF-8.
    const std::string text =
        toJson(preferences).dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
    writeFile(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace vlf
