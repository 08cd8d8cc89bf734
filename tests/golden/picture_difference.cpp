#include "golden/picture_difference.h"

#include "vlf/image/flip.h"
#include "vlf/image/srgb.h"

#include <fmt/format.h>

namespace vlf::test {

PictureDifference difference(const Image& picture, const Image& golden) {
    PictureDifference result;
    result.flip = flip(picture, golden).mean;
    const auto count = static_cast<double>(golden.pixels.size());
    for (std::size_t i = 0; i < golden.pixels.size(); ++i) {
        const Vec3 d =
            glm::abs(srgbFromLinear(picture.pixels[i]) - srgbFromLinear(golden.pixels[i]));
        result.mean += (d.x + d.y + d.z) / (3 * count);
        if (maxComponent(d) > kVisibleStep) result.share += 1 / count;
    }
    return result;
}

bool within(const PictureDifference& d, const PictureLimits& limits) {
    const PictureDifference& most = limits.largest;
    return d.mean <= most.mean && d.share <= most.share && d.flip <= most.flip;
}

std::string describe(const PictureDifference& d, const PictureLimits& limits) {
    const PictureDifference& most = limits.largest;
    return fmt::format(
        "mean difference {:.5f} (<= {}), {:.2f} % of the pixels differ visibly (<= {} %), "
        "FLIP {:.5f} (<= {}); limits '{}'",
        d.mean, most.mean, 100 * d.share, 100 * most.share, d.flip, most.flip, limits.name);
}

}  // namespace vlf::test
