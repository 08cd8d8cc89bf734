#pragma once
// Checkpoints of unfinished work: named values and arrays in a chunk file, with what they belong
// to. Layout: docs/file-format.md.

#include "vlf/base/file.h"
#include "vlf/io/chunk_file.h"
#include "vlf/io/grid_chunk.h"

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace vlf {

/// One thing that has to be the same for the work to go on, in words for people, e.g. "--cells",
/// "256".
struct CheckpointTrait {
    std::string name, value;
};
using CheckpointIdentity = std::vector<CheckpointTrait>;

/// The chunk of the identity; no value may have its name.
inline constexpr const char* kIdentityChunk = "checkpoint";

/// A trivially copyable T as integers, as large as its alignment allows.
template <class T>
struct PlainCodec {
    static_assert(std::is_trivially_copyable_v<T>);
    using Word =
        std::conditional_t<alignof(T) == 1, std::uint8_t,
                           std::conditional_t<alignof(T) == 2, std::uint16_t, std::uint32_t>>;
    using Codec = GridCodec<Word, sizeof(T) / sizeof(Word)>;

    static auto encode(const T& item) { return std::bit_cast<typename Codec::Element>(item); }
    static T decode(const typename Codec::Element& code) { return std::bit_cast<T>(code); }
};

/// Collects values under names of 1 to 16 characters of ASCII, each used once.
class CheckpointWriter {
  public:
    /// Of the file `path`, which appears once it is committed. Throws FileError; an old file is
    /// then left as it was.
    CheckpointWriter(const std::string& path, const CheckpointIdentity& identity);

    template <class T, class A>
    void operator()(const std::string& name, const std::vector<T, A>& values) {
        using Plain = PlainCodec<T>;
        addGrid<typename Plain::Codec>(file_, name, values, 1, Plain::encode);
    }
    template <class T>
    void operator()(const std::string& name, const T& value) {
        (*this)(name, std::vector<T>{value});
    }

    /// Completes the file, once. Throws FileError.
    void commit();

  private:
    OutputFile output_;
    ChunkFileWriter file_;
};

/// Reads them back. All throws InputError, naming the file, for what is damaged or missing.
class CheckpointReader {
  public:
    /// Throws FileError if the file cannot be read, InputError if it is no checkpoint.
    explicit CheckpointReader(const std::string& path);

    /// Throws InputError that tells what differs, unless the checkpoint has this identity.
    void require(const CheckpointIdentity& identity) const;

    template <class T, class A>
    void operator()(const std::string& name, std::vector<T, A>& values) const {
        using Plain = PlainCodec<T>;
        const std::uint64_t count = file_.chunk(name).memoryBytes() / sizeof(T);
        readGrid<typename Plain::Codec>(file_, name, values, {1, count}, Plain::decode);
    }
    template <class T>
    void operator()(const std::string& name, T& value) const {
        std::vector<T> values;
        (*this)(name, values);
        if (values.size() != 1)
            throw InputError(file_.where(file_.chunk(name)), "is not one value: damaged");
        value = values.front();
    }

  private:
    ChunkFileReader file_;
};

}  // namespace vlf
