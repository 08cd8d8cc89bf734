#pragma once
// Where bytes go that are made piece by piece.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

class ByteSink {
  public:
    virtual ~ByteSink() = default;

    virtual void append(std::span<const std::uint8_t> bytes) = 0;
    /// Puts `bytes` in place of as many at the start.
    virtual void writeStart(std::span<const std::uint8_t> bytes) = 0;
    /// How many have been appended.
    virtual std::uint64_t size() const = 0;
};

/// Keeps them in memory.
class MemorySink final : public ByteSink {
  public:
    void append(std::span<const std::uint8_t> bytes) override {
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    void writeStart(std::span<const std::uint8_t> bytes) override {
        std::copy(bytes.begin(), bytes.end(), bytes_.begin());
    }
    std::uint64_t size() const override { return bytes_.size(); }

    const std::vector<std::uint8_t>& bytes() const { return bytes_; }

  private:
    std::vector<std::uint8_t> bytes_;
};

}  // namespace vlf
