// Ten thousand damaged files of every kind the program reads: each is refused with an Error or read
// as something sound, in little time. A crash leaves the file in /dev/shm/vlf-fuzz-PROCESS (or
// in $TMPDIR).

#include "hostile/damage.h"

#include "fuzz/open_field_file.h"
#include "fuzz/readers.h"

#include <string>

#include <gtest/gtest.h>
#include <sys/time.h>

namespace vlf {
namespace {

using fuzz::Blob;
using fuzz::Format;

constexpr int kFilesPerFormat = 1500;
constexpr int kMostSeconds = 10;

/// Ends the process, by a signal, if it takes longer than kMostSeconds of the processor.
void startClock() {
    const itimerval limit{{0, 0}, {kMostSeconds, 0}};
    setitimer(ITIMER_PROF, &limit, nullptr);
}

bool isField(const Format& format) {
    return std::string(format.name) == "field";
}

class HostileInput : public testing::TestWithParam<Format> {
  protected:
    void read(const Blob& file) {
        startClock();
        try {
            ++(GetParam().read(file) ? accepted_ : refused_);
        } catch (const std::exception& e) {
            ADD_FAILURE() << "file " << accepted_ + refused_ << ": " << e.what();
            ++refused_;
        }
    }
    void TearDown() override {
        const itimerval none{};
        setitimer(ITIMER_PROF, &none, nullptr);
        RecordProperty("accepted", accepted_);
        RecordProperty("refused", refused_);
    }

    const std::vector<Blob> seeds_ = GetParam().seeds();
    int accepted_ = 0, refused_ = 0;
};

TEST_P(HostileInput, BeginsWithFilesThatAreAccepted) {
    for (const Blob& seed : seeds_) read(seed);
    EXPECT_EQ(refused_, 0);
}

TEST_P(HostileInput, CutOffAnywhereIsRefusedOrSound) {
    for (const Blob& seed : seeds_)
        for (std::size_t size = 0; size < seed.size(); ++size)
            read({seed.begin(), seed.begin() + static_cast<std::ptrdiff_t>(size)});
    EXPECT_GT(accepted_ + refused_, 100);
}

TEST_P(HostileInput, DamagedByChanceIsRefusedOrSound) {
    test::Damage damage(1);
    for (int i = 0; i < kFilesPerFormat; ++i) {
        const Blob &seed = seeds_[damage.below(seeds_.size())],
                   &other = seeds_[damage.below(seeds_.size())];
        const bool behind = isField(GetParam()) && i % 8 != 0;
        read(behind ? damage.behindChecksums(seed, other) : damage.of(seed, other));
    }
    EXPECT_GT(refused_, kFilesPerFormat / 50);
    EXPECT_GT(accepted_, kFilesPerFormat / 50);
}

INSTANTIATE_TEST_SUITE_P(Formats, HostileInput,
                         testing::ValuesIn(fuzz::formats().begin(), fuzz::formats().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace vlf
