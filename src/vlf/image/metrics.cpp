#include "vlf/image/metrics.h"

#include "vlf/base/error.h"
#include "vlf/image/srgb.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

/// Calls add(test pixel, reference pixel) for all that the mask selects and returns their number.
template <class Add>
std::size_t forEachPixel(const Image& test, const Image& reference, PixelMask mask, Add add) {
    requireComparable(test, reference, mask);
    std::size_t count = 0;
    for (std::size_t i = 0; i < test.pixels.size(); ++i) {
        if (!mask.empty() && mask[i] == 0) continue;
        add(glm::dvec3(test.pixels[i]), glm::dvec3(reference.pixels[i]));
        ++count;
    }
    return count;
}

double sum(const glm::dvec3& v) {
    return v.x + v.y + v.z;
}

std::string sizeText(const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
}

}  // namespace

double relativeMse(const Image& test, const Image& reference, PixelMask mask) {
    double total = 0;
    const std::size_t count =
        forEachPixel(test, reference, mask, [&](const glm::dvec3& i, const glm::dvec3& r) {
            total += sum((i - r) * (i - r) / (r * r + 0.01));
        });
    return total / (3.0 * static_cast<double>(count));
}

double relativeRmse(const Image& test, const Image& reference, PixelMask mask) {
    double error = 0, power = 0;
    forEachPixel(test, reference, mask, [&](const glm::dvec3& i, const glm::dvec3& r) {
        error += sum((i - r) * (i - r));
        power += sum(r * r);
    });
    return error == 0 ? 0 : std::sqrt(error / power);
}

double peakSignalToNoise(const Image& test, const Image& reference, PixelMask mask) {
    double total = 0;
    const std::size_t count =
        forEachPixel(test, reference, mask, [&](const glm::dvec3& i, const glm::dvec3& r) {
            const glm::dvec3 d(srgbFromLinear(Vec3(i)) - srgbFromLinear(Vec3(r)));
            total += sum(d * d);
        });
    return -10 * std::log10(total / (3.0 * static_cast<double>(count)));
}

std::vector<std::size_t> nonFinitePixels(const Image& image) {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (!isFinite(image.pixels[i])) indices.push_back(i);
    return indices;
}

void requireComparable(const Image& test, const Image& reference, PixelMask mask) {
    if (test.width != reference.width || test.height != reference.height)
        throw InputError("images differ in size: " + sizeText(test) + " against " +
                         sizeText(reference) + "; compare images of equal size");
    if (test.pixels.empty()) throw InputError("the images to compare have no pixels");
    if (mask.empty()) return;
    if (mask.size() != test.pixels.size())
        throw InputError("the mask has " + std::to_string(mask.size()) + " pixels, the image " +
                         std::to_string(test.pixels.size()));
    if (std::all_of(mask.begin(), mask.end(), [](std::uint8_t m) { return m == 0; }))
        throw InputError("the mask selects no pixel");
}

}  // namespace vlf
