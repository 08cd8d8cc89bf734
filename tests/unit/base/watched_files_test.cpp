#include "vlf/base/watched_files.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace vlf {
namespace {

namespace fs = std::filesystem;

class WatchedFilesTest : public testing::Test {
  protected:
    WatchedFilesTest()
        : folder_(fs::path(testing::TempDir()) /
                  (std::string("watched-") +
                   testing::UnitTest::GetInstance()->current_test_info()->name())) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        write("a", "old");
        write("b", "old");
    }
    ~WatchedFilesTest() override { fs::remove_all(folder_); }

    std::string path(const char* name) const { return (folder_ / name).string(); }
    void write(const char* name, const char* text) const { std::ofstream(path(name)) << text; }
    WatchedFiles watch() const { return WatchedFiles({stampOf(path("a")), stampOf(path("b"))}); }

    const fs::path folder_;
};

TEST_F(WatchedFilesTest, AreQuietWhileNothingHappens) {
    WatchedFiles files = watch();
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(files.changed());
}

TEST_F(WatchedFilesTest, AreReportedOnceWhenTheyHaveComeToRest) {
    WatchedFiles files = watch();
    write("a", "longer");
    EXPECT_FALSE(files.changed()) << "it may not be all";
    write("a", "longer still");
    EXPECT_FALSE(files.changed());
    EXPECT_TRUE(files.changed());
    EXPECT_FALSE(files.changed());
}

TEST_F(WatchedFilesTest, ReportAFileThatAnEditorReplacesByOneOfTheSameSizeAndTime) {
    WatchedFiles files = watch();
    write("new", "new");
    fs::last_write_time(path("new"), fs::last_write_time(path("a")));
    fs::rename(path("new"), path("a"));
    files.changed();
    EXPECT_TRUE(files.changed());
}

TEST_F(WatchedFilesTest, ReportFilesThatGoAndComeBack) {
    WatchedFiles files = watch();
    fs::remove(path("b"));
    files.changed();
    EXPECT_TRUE(files.changed());
    write("b", "again");
    files.changed();
    EXPECT_TRUE(files.changed());
}

TEST_F(WatchedFilesTest, ReportChangesSinceTheyWereReadAtTheFirstLook) {
    const FileStamp asRead = stampOf(path("a"));
    write("a", "longer");
    WatchedFiles files({asRead});
    EXPECT_FALSE(files.changed());
    EXPECT_TRUE(files.changed());
}

}  // namespace
}  // namespace vlf
