#include "vlf/display/preferences.h"

#include "vlf/base/error.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace vlf {
namespace {

namespace fs = std::filesystem;

class PreferencesFile : public ::testing::Test {
  protected:
    void SetUp() override {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    void write(const std::string& text) const { std::ofstream(file_) << text; }
    std::string problem() const {
        try {
            readPreferences(file_);
        } catch (const Error& e) {
            return e.what();
        }
        return {};
    }

    // Tests may run at the same time.
    const fs::path folder_ = fs::path(::testing::TempDir()) /
                             (std::string("vlf_preferences_") +
                              ::testing::UnitTest::GetInstance()->current_test_info()->name());
    const std::string file_ = folder_ / "view.json";
};

Preferences example() {
    Preferences p;
    p.window = {800, 600, 20, -30};
    p.speedFactor = 2.5f;
    p.movement = Movement::walk;
    CameraPose pose;
    pose.eye = {0.1f, -2.7f, 3e3f};
    pose.yaw = -3.1f;
    pose.pitch = CameraPose::kMostPitch;
    pose.verticalFov = 61.3f;
    p.rooms["/home/x/room \"1\".vlf"] = {pose, {{"door", pose}, {"", {}}}};
    p.rooms["/b.vlf"] = {};
    return p;
}

TEST_F(PreferencesFile, ComesBackAsItWasWritten) {
    const std::string path = folder_ / "new" / "folders" / "view.json";
    writePreferences(path, example());
    EXPECT_EQ(readPreferences(path), example());
    EXPECT_EQ(std::distance(fs::directory_iterator(fs::path(path).parent_path()), {}), 1)
        << "nothing else is left";
}

TEST_F(PreferencesFile, MissingMeansDefaults) {
    EXPECT_EQ(readPreferences(file_), Preferences());
    write("{}");
    EXPECT_EQ(readPreferences(file_), Preferences());
}

TEST_F(PreferencesFile, DamageIsNamed) {
    for (const auto& [text, named] : std::initializer_list<std::pair<const char*, const char*>>{
             {"", "view.json"},
             {"[1]", "must be an object"},
             {"{\"speed\": ", "parse error"},
             {R"({"speed": "fast"})", "speed: must be a number"},
             {R"({"speed": 1e9})", "speed"},
             {R"({"speed": 1e999})", "view.json"},
             {R"({"movement": "swim"})", "movement"},
             {R"({"window": {"width": 0, "height": 5}})", "window.width"},
             {R"({"window": {"width": 10}})", "height"},
             {R"({"rooms": []})", "rooms"},
             {R"({"rooms": {"a": {"pose": {"eye": [1, 2]}}}})", "three numbers"},
             {R"({"rooms": {"a": {"bookmarks": [{"name": 4}]}}})", "bookmarks[0].name"},
             {R"({"rooms": {"a": {"pose": {"eye": [1, 2, null], "yaw": 0}}}})", "eye[2]"}}) {
        write(text);
        EXPECT_NE(problem().find(named), std::string::npos) << text << " -> " << problem();
    }
}

TEST_F(PreferencesFile, CutOffAnywhereIsAnError) {
    writePreferences(file_, example());
    std::ifstream stream(file_);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    for (std::size_t length = 0; length + 2 < text.size(); ++length) {
        write(text.substr(0, length));
        EXPECT_NE(problem(), "") << length;
    }
}

TEST_F(PreferencesFile, AFolderInItsPlaceIsAnError) {
    fs::create_directories(file_);
    EXPECT_NE(problem().find(file_), std::string::npos);
    EXPECT_THROW(writePreferences(file_, example()), Error);
}

TEST(PreferencesPath, IsInTheFolderForSettings) {
    setenv("HOME", "/home/x", 1);
    setenv("XDG_CONFIG_HOME", "/settings", 1);
    EXPECT_EQ(preferencesPath(), "/settings/vlf/view.json");
    setenv("XDG_CONFIG_HOME", "relative", 1);
    EXPECT_EQ(preferencesPath(), "/home/x/.config/vlf/view.json");
    unsetenv("XDG_CONFIG_HOME");
    EXPECT_EQ(preferencesPath(), "/home/x/.config/vlf/view.json");
    unsetenv("HOME");
    EXPECT_EQ(preferencesPath(), "");
}

}  // namespace
}  // namespace vlf
