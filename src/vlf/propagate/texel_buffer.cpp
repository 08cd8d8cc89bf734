#include "vlf/propagate/texel_buffer.h"

#include "vlf/base/parallel.h"

namespace vlf {

TexelBuffer sumInOrder(std::span<const TexelBuffer> buffers) {
    constexpr std::size_t kBlock = 1 << 14;
    TexelBuffer sum = buffers.front();
    const std::size_t floats = 4 * (sum.texelCount() + 1);
    parallelFor((floats + kBlock - 1) / kBlock, [&](std::size_t block) {
        const std::size_t begin = block * kBlock, end = std::min(floats, begin + kBlock);
        for (std::size_t b = 1; b < buffers.size(); ++b) {
            const float* from = buffers[b].data();
            float* to = sum.data();
            for (std::size_t i = begin; i < end; ++i) to[i] += from[i];
        }
    });
    return sum;
}

}  // namespace vlf
