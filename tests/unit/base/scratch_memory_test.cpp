#include "vlf/base/scratch_memory.h"

#include "vlf/base/error.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

namespace vlf {
namespace {

namespace fs = std::filesystem;

using Numbers = std::vector<std::uint32_t, ScratchAllocator<std::uint32_t>>;

constexpr std::size_t kMany = std::size_t{16} << 20;  // 64 MiB

std::size_t residentBytes() {
    std::size_t size = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> size >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

class ScratchMemory : public testing::Test {
  protected:
    ScratchMemory() { fs::create_directories(folder_); }
    ~ScratchMemory() override { fs::remove_all(folder_); }

    Numbers numbers(std::size_t largest) const {
        return Numbers(ScratchAllocator<std::uint32_t>({folder_.string(), largest}));
    }
    void releaseAll(const Numbers& n) const {
        n.get_allocator().release(n.capacity(), n.data(), n.size());
    }

    const fs::path folder_ =
        fs::path(testing::TempDir()) /
        (std::string("scratch-memory-") +
         testing::UnitTest::GetInstance()->current_test_info()->name());  // others run beside it
};

TEST_F(ScratchMemory, OfAFileIsGivenBackAndKeepsItsContent) {
    Numbers n = numbers(1000);
    n.resize(kMany);
    EXPECT_TRUE(std::all_of(n.begin(), n.end(), [](std::uint32_t v) { return v == 0; }));
    for (std::uint32_t i = 0; i < kMany; ++i) n[i] = i;
    const std::size_t before = residentBytes();
    releaseAll(n);
    EXPECT_LT(residentBytes() + 3 * kMany, before);
    std::size_t wrong = 0;
    for (std::uint32_t i = 0; i < kMany; ++i) wrong += n[i] != i;
    EXPECT_EQ(wrong, 0u);
}

TEST_F(ScratchMemory, TakesNoneBeforeItIsWrittenTo) {
    const std::size_t before = residentBytes();
    Numbers n = numbers(1000);
    n.resize(kMany);
    EXPECT_LT(residentBytes(), before + kMany / 4);
}

TEST_F(ScratchMemory, UpToTheSizeIsOrdinary) {
    Numbers n = numbers(4000);
    n.resize(1000);
    std::fill(n.begin(), n.end(), 7u);
    releaseAll(n);
    EXPECT_TRUE(std::all_of(n.begin(), n.end(), [](std::uint32_t v) { return v == 7; }));
}

TEST_F(ScratchMemory, GoesWithTheVectorThatIsMoved) {
    Numbers n = numbers(1000);
    n.resize(kMany);
    n[5] = 3;
    const std::uint32_t* const data = n.data();
    Numbers other;
    other = std::move(n);
    EXPECT_EQ(other.data(), data);
    EXPECT_EQ(other[5], 3u);
    EXPECT_EQ(other.get_allocator().place()->folder, folder_.string());
}

TEST_F(ScratchMemory, LeavesNothingInTheFolder) {
    Numbers n = numbers(1000);
    n.resize(kMany);
    EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(ScratchMemory, WithoutItsFolderIsAFileError) {
    fs::remove_all(folder_);
    EXPECT_THROW(numbers(1000).resize(kMany), FileError);
}

}  // namespace
}  // namespace vlf
