#include "vlf/image/heat_map.h"

#include "vlf/image/srgb.h"

#include <algorithm>
#include <stdexcept>

namespace vlf {

Vec3 heatColor(float t) {
    t = t < 1 ? std::max(t, 0.0f) : 1.0f;
    // Least squares over the 256 colours of the map, sRGB-encoded: error at most 0.024.
    constexpr int kDegree = 6;
    static const Vec3 kCoefficients[kDegree + 1] = {
        {-0.0021f, -0.0007f, -0.0095f},  {0.2505f, 0.6945f, 2.4953f},
        {8.3459f, -3.5960f, 0.3291f},    {-27.6670f, 14.2539f, -13.6466f},
        {52.1707f, -27.9446f, 12.8811f}, {-50.7586f, 29.0539f, 4.2699f},
        {18.6643f, -11.4900f, -5.5708f},
    };
    Vec3 encoded(0);
    for (int i = kDegree; i >= 0; --i) encoded = encoded * t + kCoefficients[i];
    return linearFromSrgb(glm::clamp(encoded, 0.0f, 1.0f));
}

Image heatMap(std::span<const float> values, int width, int height, float white) {
    Image image(width, height);
    if (image.pixels.size() != values.size())
        throw std::logic_error("heatMap needs one value per pixel");
    for (std::size_t i = 0; i < values.size(); ++i) image.pixels[i] = heatColor(values[i] / white);
    return image;
}

}  // namespace vlf
