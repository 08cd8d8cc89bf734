// Checkpoints give back what was put in, are refused by what they do not belong to, and are never
// misread when they are damaged.

#include "vlf/io/checkpoint_file.h"

#include "unit/io/temp_folder.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"
#include "vlf/field/radiance_field.h"
#include "vlf/io/field_file.h"
#include "vlf/math/random.h"

#include <array>
#include <cstring>

#include <gtest/gtest.h>

namespace vlf {
namespace {

using test::putBytes;
using test::TempFolder;

enum class Step : std::int32_t { first = 3, second = 7 };

/// One of everything that is kept of a bake.
struct Values {
    Step step = Step::first;
    int count = 0;
    double residual = 0;
    std::uint64_t large = 0;
    std::array<std::uint64_t, 8> sums{};
    std::vector<Vec3> vectors;
    std::vector<std::array<float, 4>> entries;
    std::vector<double> doubles;
    std::vector<std::uint8_t> marks;
    std::vector<RadianceElement> elements;
    std::vector<float> none;

    template <class Visit>
    void visit(Visit& v) {
        v("step", step);
        v("count", count);
        v("residual", residual);
        v("large", large);
        v("sums", sums);
        v("vectors", vectors);
        v("entries", entries);
        v("doubles", doubles);
        v("marks", marks);
        v("elements", elements);
        v("none", none);
    }
};

/// Random bits, with numbers among them that only their bits tell apart.
Values someValues(std::size_t size) {
    RandomStream random(1, size);
    Values v;
    v.step = Step::second;
    v.count = -5;
    v.residual = 0.1;
    v.large = ~0ull - 3;
    for (std::size_t i = 0; i < size; ++i) {
        v.sums[i % 8] += i << 40;
        v.vectors.emplace_back(random.next(), -0.0f, 1e-42f);
        v.entries.push_back({random.next(), 1e30f * random.next(), 0, -random.next()});
        v.doubles.push_back(1 / (1.0 + random.next()));
        v.marks.push_back(random.next() < 0.5f);
        v.elements.emplace_back(static_cast<std::uint32_t>(4e9f * random.next()), i % 65536);
    }
    return v;
}

template <class T, class A>
void expectSameBits(const std::vector<T, A>& a, const std::vector<T, A>& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_TRUE(a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void expectSame(const Values& a, const Values& b) {
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.count, b.count);
    EXPECT_EQ(a.residual, b.residual);
    EXPECT_EQ(a.large, b.large);
    EXPECT_EQ(a.sums, b.sums);
    expectSameBits(a.vectors, b.vectors);
    expectSameBits(a.entries, b.entries);
    expectSameBits(a.doubles, b.doubles);
    expectSameBits(a.marks, b.marks);
    expectSameBits(a.elements, b.elements);
    EXPECT_TRUE(b.none.empty());
}

const CheckpointIdentity kIdentity{{"program version", "1.2"}, {"--cells", "64"}};

class CheckpointFile : public testing::Test {
  protected:
    void write(Values values) {
        CheckpointWriter writer(path, kIdentity);
        values.visit(writer);
        writer.commit();
    }
    Values read() const {
        CheckpointReader reader(path);
        reader.require(kIdentity);
        Values values;
        values.visit(reader);
        return values;
    }
    std::string refusal(const CheckpointIdentity& identity) const {
        try {
            CheckpointReader(path).require(identity);
        } catch (const InputError& e) {
            return e.what();
        }
        return "";
    }
    bool isRefused() const {
        try {
            read();
            return false;
        } catch (const InputError& e) {
            EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
            return true;
        }
    }

    TempFolder folder;
    std::string path = folder.file("room.vlf.checkpoint");
};

TEST_F(CheckpointFile, GivesBackTheBitsThatWerePutIn) {
    for (const std::size_t size : {0, 1, 1000, 200000}) {
        const Values values = someValues(size);
        write(values);
        expectSame(values, read());
    }
    EXPECT_EQ(folder.fileCount(), 1u);
}

TEST_F(CheckpointFile, OfAnotherIdentityIsRefusedWithWhatDiffers) {
    write(someValues(3));
    EXPECT_EQ(refusal(kIdentity), "");
    EXPECT_EQ(
        refusal({{"program version", "1.3"}, {"--cells", "128"}}),
        path + ": is of another bake: program version was 1.2, is 1.3; --cells was 64, is 128");
    EXPECT_EQ(refusal({{"program version", "1.2"}, {"--cells", "64"}, {"--tile", "8"}}),
              path + ": is of another bake: --tile is missing");
    EXPECT_EQ(refusal({{"program version", "1.2"}}), path + ": is of another bake: --cells was 64");
}

TEST_F(CheckpointFile, IsNoFieldFileAndAFieldFileIsNone) {
    write(someValues(3));
    try {
        readField(path);
        FAIL() << "no exception";
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("--resume"), std::string::npos) << e.what();
    }
    MemorySink file;
    ChunkFileWriter other(file);
    other.add("summary", std::vector<std::uint8_t>(3));
    other.finish();
    putBytes(path, file.bytes());
    EXPECT_TRUE(isRefused());
}

TEST_F(CheckpointFile, ThatIsMissingIsAFileError) {
    EXPECT_THROW(CheckpointReader{path}, FileError);
}

TEST_F(CheckpointFile, TruncatedAnywhereIsRefused) {
    write(someValues(20));
    const std::vector<std::uint8_t> bytes = readFile(path);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        putBytes(path, {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)});
        ASSERT_TRUE(isRefused()) << "at " << length << " of " << bytes.size();
    }
}

TEST_F(CheckpointFile, WithABitFlippedAnywhereIsRefused) {
    write(someValues(20));
    const std::vector<std::uint8_t> bytes = readFile(path);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::vector<std::uint8_t> damaged = bytes;
        damaged[i] ^= static_cast<std::uint8_t>(1 << i % 8);
        putBytes(path, damaged);
        ASSERT_TRUE(isRefused()) << "byte " << i << " of " << bytes.size();
    }
}

TEST_F(CheckpointFile, ValuesOfAnotherSizeAreRefused) {
    CheckpointWriter writer(path, kIdentity);
    writer("count", std::vector<int>{1, 2});
    writer("vectors", std::vector<float>{1, 2});
    writer.commit();
    const CheckpointReader reader(path);
    int count = 0;
    EXPECT_THROW(reader("count", count), InputError);
    EXPECT_THROW(reader("another", count), InputError);
    std::vector<Vec3> vectors;
    EXPECT_THROW(reader("vectors", vectors), InputError);
}

}  // namespace
}  // namespace vlf
