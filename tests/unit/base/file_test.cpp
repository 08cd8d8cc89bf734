#include "vlf/base/file.h"

#include "vlf/base/error.h"

#include <filesystem>
#include <iterator>

#include <gtest/gtest.h>
#include <unistd.h>

namespace vlf {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
  protected:
    FileTest()
        : folder_(fs::path(testing::TempDir()) /
                  testing::UnitTest::GetInstance()->current_test_info()->name()) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~FileTest() override { fs::remove_all(folder_); }

    std::string path(const char* name) const { return (folder_ / name).string(); }
    auto fileCount() const { return std::distance(fs::directory_iterator(folder_), {}); }

    const fs::path folder_;
    const std::vector<std::uint8_t> oldBytes_{1, 2, 3}, newBytes_{0, 255, 10, 13, 0};
};

TEST_F(FileTest, ReadsBackWhatWasWritten) {
    writeFile(path("a"), newBytes_);
    EXPECT_EQ(readFile(path("a")), newBytes_);
    writeFile(path("empty"), {});
    EXPECT_TRUE(readFile(path("empty")).empty());
}

TEST_F(FileTest, ReplacesAnOldFileAndLeavesNothingElse) {
    writeFile(path("a"), oldBytes_);
    writeFile(path("a"), newBytes_);
    EXPECT_EQ(readFile(path("a")), newBytes_);
    EXPECT_EQ(fileCount(), 1);
}

TEST_F(FileTest, WrittenPieceByPieceAppearsWhenItIsCommitted) {
    writeFile(path("a"), oldBytes_);
    OutputFile file(path("a"));
    file.append(newBytes_);
    file.append(oldBytes_);
    EXPECT_EQ(file.size(), newBytes_.size() + oldBytes_.size());
    file.writeStart(std::vector<std::uint8_t>{9, 8});
    file.append(oldBytes_);
    EXPECT_EQ(readFile(path("a")), oldBytes_);
    file.commit();
    EXPECT_EQ(readFile(path("a")),
              (std::vector<std::uint8_t>{9, 8, 10, 13, 0, 1, 2, 3, 1, 2, 3}));
    EXPECT_EQ(fileCount(), 1);
}

TEST_F(FileTest, WrittenPieceByPieceAndGivenUpLeavesTheOldOne) {
    writeFile(path("a"), oldBytes_);
    OutputFile(path("a")).append(newBytes_);
    EXPECT_EQ(readFile(path("a")), oldBytes_);
    EXPECT_EQ(fileCount(), 1);
}

TEST_F(FileTest, APendingFileAppearsWhenItIsCommitted) {
    writeFile(path("a"), oldBytes_);
    PendingFile file(path("a"));
    writeFile(file.name(), newBytes_);
    EXPECT_EQ(readFile(path("a")), oldBytes_);
    file.commit();
    EXPECT_EQ(readFile(path("a")), newBytes_);
    EXPECT_EQ(fileCount(), 1);
}

TEST_F(FileTest, APendingFileThatIsGivenUpLeavesTheOldOne) {
    writeFile(path("a"), oldBytes_);
    {
        PendingFile file(path("a"));
        writeFile(file.name(), newBytes_);
        EXPECT_EQ(fileCount(), 2);
    }
    EXPECT_EQ(readFile(path("a")), oldBytes_);
    EXPECT_EQ(fileCount(), 1);
    EXPECT_THROW(PendingFile(path("never")).commit(), FileError);
    EXPECT_THROW(PendingFile("/dev/null"), FileError);
}

TEST_F(FileTest, WhatKilledProcessesLeftIsRemovedAndNothingElse) {
    for (const char* name : {"a", "a.tmp-12-0", "a.tmp-7-31", "a.tmp-12-0.png", "a.tmp-notes",
                             "aa.tmp-12-0", "a.checkpoint.tmp-12-0"})
        writeFile(path(name), oldBytes_);
    fs::create_symlink(path("a"), path("link"));
    removeLeftovers(path("link"));
    EXPECT_EQ(fileCount(), 6);
    for (const char* gone : {"a.tmp-12-0", "a.tmp-7-31"}) EXPECT_FALSE(fs::exists(path(gone)));
    EXPECT_NO_THROW(removeLeftovers(path("missing/a")));
    PendingFile pending(path("a"));
    writeFile(pending.name(), newBytes_);
    removeLeftovers(path("a"));
    EXPECT_FALSE(fs::exists(pending.name())) << "leftovers are not named as pending files are";
}

TEST_F(FileTest, SaysWhichFileCannotBeRead) {
    try {
        readFile(path("missing"));
        FAIL() << "nothing was thrown";
    } catch (const FileError& e) {
        EXPECT_NE(std::string(e.what()).find(path("missing")), std::string::npos) << e.what();
    }
    EXPECT_THROW(readFile(folder_.string()), FileError);
}

TEST_F(FileTest, FailsToWriteIntoAMissingFolder) {
    EXPECT_THROW(writeFile(path("missing/a"), newBytes_), FileError);
    EXPECT_EQ(fileCount(), 0);
}

TEST_F(FileTest, KnowsBeforehandWhatCannotBeWritten) {
    EXPECT_NO_THROW(requireWritable(path("a")));
    EXPECT_NO_THROW(requireWritable("a-file-of-the-working-folder"));
    EXPECT_NO_THROW(requireWritable("/dev/null"));
    EXPECT_THROW(requireWritable(path("missing/a")), FileError);
    EXPECT_THROW(requireWritable(folder_.string()), FileError);
    EXPECT_EQ(fileCount(), 0);
}

TEST_F(FileTest, KnowsBeforehandThatAFolderIsReadOnly) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
    fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_THROW(requireWritable(path("a")), FileError);
    fs::permissions(folder_, fs::perms::owner_all);
}

TEST_F(FileTest, WritesToADeviceDirectly) {
    EXPECT_NO_THROW(writeFile("/dev/null", newBytes_));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(FileTest, SaysThatADeviceIsFull) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    EXPECT_THROW(writeFile("/dev/full", newBytes_), FileError);
}

}  // namespace
}  // namespace vlf
