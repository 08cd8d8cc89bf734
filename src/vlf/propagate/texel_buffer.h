#pragma once
// Radiance or sums of radiance, one entry per atlas texel.

#include "vlf/math/vector.h"

#include <cstddef>
#include <vector>

namespace vlf {

/// Four floats a texel: RGB and a weight. As radiance: W·m⁻²·sr⁻¹, weight 1. As accumulator: sum of
/// the radiance seen and the number of samples. The last entry (index texelCount) stands for the
/// outside of the scene.
class TexelBuffer {
  public:
    TexelBuffer() = default;
    explicit TexelBuffer(std::size_t texelCount) : values_(4 * (texelCount + 1), 0.0f) {}

    std::size_t texelCount() const { return values_.size() / 4 - 1; }
    float* data() { return values_.data(); }
    const float* data() const { return values_.data(); }

    Vec3 rgb(std::size_t i) const {
        return {values_[4 * i], values_[4 * i + 1], values_[4 * i + 2]};
    }
    float weight(std::size_t i) const { return values_[4 * i + 3]; }
    void set(std::size_t i, const Vec3& rgb, float weight) {
        values_[4 * i] = rgb.x, values_[4 * i + 1] = rgb.y, values_[4 * i + 2] = rgb.z;
        values_[4 * i + 3] = weight;
    }
    void add(std::size_t i, const Vec3& rgb, float weight) {
        values_[4 * i] += rgb.x, values_[4 * i + 1] += rgb.y, values_[4 * i + 2] += rgb.z;
        values_[4 * i + 3] += weight;
    }
    /// All zero, of this size; memory it has is kept.
    void reset(std::size_t texelCount) { values_.assign(4 * (texelCount + 1), 0.0f); }

  private:
    std::vector<float> values_;
};

/// Sum of equal-sized buffers, added in their order.
TexelBuffer sumInOrder(const std::vector<TexelBuffer>& buffers);

}  // namespace vlf
