#pragma once
// Radiance or sums of radiance, one entry per atlas texel.

#include "vlf/math/vector.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace vlf {

/// Four floats a texel: RGB and a weight. As radiance: W·m⁻²·sr⁻¹, weight 1. As accumulator: sum of
/// the radiance seen and the number of samples. The last entry (index texelCount) stands for the
/// outside of the scene.
class TexelBuffer {
  public:
    using Entry = std::array<float, 4>;

    TexelBuffer() = default;
    explicit TexelBuffer(std::size_t texelCount) : entries_(texelCount + 1, Entry{}) {}

    bool empty() const { return entries_.empty(); }
    std::size_t texelCount() const { return entries_.size() - 1; }
    std::vector<Entry>& entries() { return entries_; }
    const std::vector<Entry>& entries() const { return entries_; }
    float* data() { return entries_.data()->data(); }
    const float* data() const { return entries_.data()->data(); }

    Vec3 rgb(std::size_t i) const { return {entries_[i][0], entries_[i][1], entries_[i][2]}; }
    float weight(std::size_t i) const { return entries_[i][3]; }
    void set(std::size_t i, const Vec3& rgb, float weight) {
        entries_[i] = {rgb.x, rgb.y, rgb.z, weight};
    }
    void add(std::size_t i, const Vec3& rgb, float weight) {
        Entry& e = entries_[i];
        e[0] += rgb.x, e[1] += rgb.y, e[2] += rgb.z;
        e[3] += weight;
    }
    /// All zero, of this size; memory it has is kept.
    void reset(std::size_t texelCount) { entries_.assign(texelCount + 1, Entry{}); }

  private:
    std::vector<Entry> entries_;
};

/// Sum of equal-sized buffers, added in their order.
TexelBuffer sumInOrder(std::span<const TexelBuffer> buffers);

}  // namespace vlf
