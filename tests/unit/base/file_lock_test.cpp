#include "vlf/base/file_lock.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"

#include <csignal>
#include <filesystem>
#include <memory>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vlf {
namespace {

namespace fs = std::filesystem;

class FileLockTest : public testing::Test {
  protected:
    FileLockTest()
        : folder_(fs::path(testing::TempDir()) /
                  testing::UnitTest::GetInstance()->current_test_info()->name()) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~FileLockTest() override { fs::remove_all(folder_); }

    std::string path() const { return (folder_ / "room.lock").string(); }
    std::string refusal() const {
        try {
            FileLock(path(), "room");
        } catch (const FileError& e) {
            return e.what();
        }
        return "";
    }

    const fs::path folder_;
};

TEST_F(FileLockTest, IsHeldByOneAtATime) {
    auto lock = std::make_unique<FileLock>(path(), "room");
    EXPECT_EQ(refusal(), "room: another program is making this file (process " +
                             std::to_string(::getpid()) + "); wait for it, or choose another name");
    EXPECT_NE(refusal(), "") << "the attempt has broken the lock";
    lock.reset();
    EXPECT_FALSE(fs::exists(path()));
    EXPECT_EQ(refusal(), "");
    EXPECT_FALSE(fs::exists(path()));
}

TEST_F(FileLockTest, OfAProcessThatWasKilledDoesNotBlock) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const FileLock lock(path(), "room");
        if (::write(ready[1], "x", 1) == 1) ::pause();
        ::_exit(1);
    }
    char byte = 0;
    ASSERT_EQ(::read(ready[0], &byte, 1), 1);
    EXPECT_NE(refusal().find("process " + std::to_string(child)), std::string::npos) << refusal();
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_TRUE(fs::exists(path()));
    EXPECT_EQ(refusal(), "");
    ::close(ready[0]);
    ::close(ready[1]);
}

TEST_F(FileLockTest, SaysWhyItCannotBeMade) {
    try {
        FileLock((folder_ / "missing" / "room.lock").string(), "room");
        FAIL() << "no exception";
    } catch (const FileError& e) {
        EXPECT_NE(std::string(e.what()).find("No such file"), std::string::npos) << e.what();
    }
}

}  // namespace
}  // namespace vlf
