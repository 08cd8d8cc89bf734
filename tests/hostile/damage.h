#pragma once
// Files damaged by chance, as disks, networks and ill will do it; the same for the same seed.

#include "fuzz/readers.h"

#include "vlf/math/random.h"

#include <cstddef>

namespace vlf::test {

using fuzz::Blob;

class Damage {
  public:
    explicit Damage(std::uint64_t seed) : random_(seed, 0) {}

    /// A whole number in [0, n), n > 0.
    std::size_t below(std::size_t n) { return random_.nextBits() % n; }

    /// One to four kinds of damage: bits flipped, extreme bytes, numbers that lie, parts that are
    /// missing, repeated, or of the other file, an early end.
    Blob of(const Blob& file, const Blob& other);

    /// The same to the content of a field file's chunk, or chunks that are exchanged; all checksums
    /// are right. `file` must be intact.
    Blob behindChecksums(const Blob& file, const Blob& other);

  private:
    void damage(Blob& bytes, const Blob& other);
    void flipBit(Blob& bytes);
    void putExtremeByte(Blob& bytes);
    void putLyingInteger(Blob& bytes);
    void putLyingNumber(Blob& bytes);
    void removePart(Blob& bytes);
    void insertPart(Blob& bytes, const Blob& from);

    RandomStream random_;
};

}  // namespace vlf::test
