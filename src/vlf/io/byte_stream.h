#pragma once
// Structs as bytes: little-endian, in the order of their description, without padding.
//
// A struct is described once, by `template <class S> void describe(S& s, Field<S, T> t)`, which
// names its members to the stream; the same description writes and reads it.

#include "vlf/base/error.h"
#include "vlf/math/vector.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace vlf {

static_assert(std::endian::native == std::endian::little, "the field file is little-endian");

/// A T that stream S may change if it reads, and may not if it writes.
template <class S, class T>
using Field = std::conditional_t<S::kReads, T&, const T&>;

/// Appends values to a vector of bytes.
class ByteWriter {
  public:
    static constexpr bool kReads = false;

    template <class... T>
    void operator()(const T&... values) {
        (put(values), ...);
    }
    std::vector<std::uint8_t> take() { return std::move(bytes_); }

  private:
    template <class T>
    void put(const T& value) {
        if constexpr (std::is_same_v<T, bool>) {
            put(static_cast<std::uint8_t>(value));
        } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
            const auto* p = reinterpret_cast<const std::uint8_t*>(&value);
            bytes_.insert(bytes_.end(), p, p + sizeof value);
        } else {
            describe(*this, value);
        }
    }
    void put(const Vec3& v) { (*this)(v.x, v.y, v.z); }
    void put(const std::string& text) {
        put(static_cast<std::uint32_t>(text.size()));
        bytes_.insert(bytes_.end(), text.begin(), text.end());
    }
    template <class T>
    void put(const std::vector<T>& values) {
        put(static_cast<std::uint32_t>(values.size()));
        for (const T& value : values) put(value);
    }

    std::vector<std::uint8_t> bytes_;
};

template <class T>
std::vector<std::uint8_t> bytesOf(const T& value) {
    ByteWriter writer;
    writer(value);
    return writer.take();
}

/// Takes values from the front of `bytes`; throws InputError at `where` if they do not suffice.
class ByteReader {
  public:
    static constexpr bool kReads = true;

    ByteReader(std::span<const std::uint8_t> bytes, SourceLocation where)
        : bytes_(bytes), where_(std::move(where)) {}

    template <class... T>
    void operator()(T&... values) {
        (get(values), ...);
    }

    /// Throws InputError unless every byte was taken.
    void expectEnd() const {
        if (!bytes_.empty()) throw InputError(where_, "longer than its content: damaged file");
    }

  private:
    const std::uint8_t* takeBytes(std::size_t count) {
        if (count > bytes_.size())
            throw InputError(where_, "ends within a value: damaged file, copy or bake it again");
        const std::uint8_t* first = bytes_.data();
        bytes_ = bytes_.subspan(count);
        return first;
    }
    template <class T>
    void get(T& value) {
        if constexpr (std::is_same_v<T, bool>) {
            value = *takeBytes(1) != 0;
        } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
            std::memcpy(&value, takeBytes(sizeof value), sizeof value);
        } else {
            describe(*this, value);
        }
    }
    void get(Vec3& v) { (*this)(v.x, v.y, v.z); }
    void get(std::string& text) {
        std::uint32_t size = 0;
        get(size);
        const auto* characters = reinterpret_cast<const char*>(takeBytes(size));
        text.assign(characters, size);
    }
    template <class T>
    void get(std::vector<T>& values) {
        std::uint32_t size = 0;
        get(size);
        values.clear();
        // Grows as elements arrive: a lying size meets the end of the bytes, not of the memory.
        for (std::uint32_t i = 0; i < size; ++i) get(values.emplace_back());
    }

    std::span<const std::uint8_t> bytes_;
    SourceLocation where_;
};

}  // namespace vlf
