// Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom, Fairchild: FLIP: A Difference Evaluator
// for Alternating Images, Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020. Section and symbol
// names are theirs.

#include "vlf/image/flip.h"

#include "vlf/base/error.h"
#include "vlf/image/convolution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vlf {

namespace {

constexpr float kColorExponent = 0.7f;            // q_c
constexpr float kKneeInput = 0.4f;                // p_c
constexpr float kKneeOutput = 0.95f;              // p_t
constexpr float kFeatureWidthInDegrees = 0.082f;  // w

// Linear sRGB and XYZ; the sums of the rows are the white point, as in the authors' definition.
const Mat3 kXyzFromRgb =
    glm::transpose(Mat3(10135552.0f / 24577794, 8788810.0f / 24577794, 4435075.0f / 24577794,  //
                        2613072.0f / 12288897, 8788810.0f / 12288897, 887015.0f / 12288897,    //
                        1425312.0f / 73733382, 8788810.0f / 73733382, 70074185.0f / 73733382));
const Mat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);
const Vec3 kWhite = kXyzFromRgb * Vec3(1);

Vec3 ycxczFromRgb(const Vec3& rgb) {
    const Vec3 q = kXyzFromRgb * rgb / kWhite;
    return {116 * q.y - 16, 500 * (q.x - q.y), 200 * (q.y - q.z)};
}

Vec3 rgbFromYcxcz(const Vec3& v) {
    const float y = (v.x + 16) / 116;
    return kRgbFromXyz * (Vec3(y + v.y / 500, y, y - v.z / 200) * kWhite);
}

float labCurve(float t) {
    constexpr float kDelta = 6.0f / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29;
}

/// CIELAB with chroma scaled by lightness, after the Hunt effect (4.1.2).
Vec3 huntLabFromRgb(const Vec3& rgb) {
    const Vec3 q = kXyzFromRgb * rgb / kWhite;
    const float x = labCurve(q.x), y = labCurve(q.y), z = labCurve(q.z);
    const float lightness = 116 * y - 16;
    return {lightness, 0.01f * lightness * 500 * (x - y), 0.01f * lightness * 200 * (y - z)};
}

/// Distance of large colour differences [Abasi et al. 2020].
float hyab(const Vec3& a, const Vec3& b) {
    const Vec3 d = a - b;
    return std::abs(d.x) + std::hypot(d.y, d.z);
}

// --- Colour pipeline (4.1) -----------------------------------------------------------------------

/// One Gaussian a sqrt(pi/b) exp(-pi^2 r^2 / b) of a contrast sensitivity function; r in degrees.
struct CsfTerm {
    float a, b;
};

/// Contrast sensitivity of the channels Y (A), Cx (RG) and Cz (BY): table 1 of the paper.
constexpr CsfTerm kAchromatic{1, 0.0047f}, kRedGreen{1, 0.0053f};
constexpr CsfTerm kBlueYellow1{34.1f, 0.04f}, kBlueYellow2{13.5f, 0.025f};

struct CsfFilter {
    Kernel kernel;  ///< of one dimension, sum 1
    float weight;   ///< of its square before it was normalised
};

CsfFilter csfFilter(const CsfTerm& term, float pixelsPerDegree) {
    constexpr float kPi2 = kPi * kPi;
    const float widest = std::sqrt(kBlueYellow1.b / (2 * kPi2));
    const int radius = static_cast<int>(std::ceil(3 * widest * pixelsPerDegree));
    Kernel kernel = makeKernel(radius, [&](float i) {
        const float r = i / pixelsPerDegree;
        return std::exp(-kPi2 * r * r / term.b);
    });
    const float sum = normalize(kernel);
    return {kernel, term.a * std::sqrt(kPi / term.b) * sum * sum};
}

Plane blurred(const Plane& plane, const Kernel& kernel) {
    return filterColumns(filterRows(plane, kernel), kernel);
}

/// The two Gaussians of the blue-yellow channel, each separable, mixed by their weights.
Plane blurredBlueYellow(const Plane& cz, float pixelsPerDegree) {
    const CsfFilter first = csfFilter(kBlueYellow1, pixelsPerDegree);
    const CsfFilter second = csfFilter(kBlueYellow2, pixelsPerDegree);
    const float share = first.weight / (first.weight + second.weight);
    Plane result = blurred(cz, first.kernel);
    const Plane other = blurred(cz, second.kernel);
    for (std::size_t i = 0; i < result.values.size(); ++i)
        result.values[i] = share * result.values[i] + (1 - share) * other.values[i];
    return result;
}

using Opponent = std::array<Plane, 3>;  ///< Y, Cx, Cz

Opponent opponentOf(const Image& image) {
    const Plane empty(image.width, image.height);
    Opponent result{empty, empty, empty};
    parallelFor(image.pixels.size(), 4096, [&](std::size_t i) {
        const Vec3 v = ycxczFromRgb(glm::clamp(image.pixels[i], 0.0f, 1.0f));
        for (int c = 0; c < 3; ++c) result[c].values[i] = v[c];
    });
    return result;
}

/// What is left of the picture at the viewing distance, in the space that colours differ in.
std::vector<Vec3> perceivedColors(const Opponent& opponent, float pixelsPerDegree) {
    const Plane y = blurred(opponent[0], csfFilter(kAchromatic, pixelsPerDegree).kernel);
    const Plane cx = blurred(opponent[1], csfFilter(kRedGreen, pixelsPerDegree).kernel);
    const Plane cz = blurredBlueYellow(opponent[2], pixelsPerDegree);
    std::vector<Vec3> colors(y.values.size());
    parallelFor(colors.size(), 4096, [&](std::size_t i) {
        const Vec3 rgb = rgbFromYcxcz({y.values[i], cx.values[i], cz.values[i]});
        colors[i] = huntLabFromRgb(glm::clamp(rgb, 0.0f, 1.0f));
    });
    return colors;
}

float largestColorDifference() {
    const Vec3 green = huntLabFromRgb({0, 1, 0}), blue = huntLabFromRgb({0, 0, 1});
    return std::pow(hyab(green, blue), kColorExponent);
}

/// Error redistribution to [0, 1] (4.1.4): most of the range goes to small differences.
float colorError(const Vec3& a, const Vec3& b, float largest) {
    const float difference = std::pow(hyab(a, b), kColorExponent), knee = kKneeInput * largest;
    if (difference < knee) return kKneeOutput / knee * difference;
    return kKneeOutput + (difference - knee) / (largest - knee) * (1 - kKneeOutput);
}

// --- Feature pipeline (4.2) ----------------------------------------------------------------------

struct FeatureFilters {
    Kernel gaussian, edge, point;
};

FeatureFilters featureFilters(float pixelsPerDegree) {
    const float sigma = 0.5f * kFeatureWidthInDegrees * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    const auto gaussian = [&](float x) { return std::exp(-x * x / (2 * sigma * sigma)); };
    FeatureFilters filters{
        makeKernel(radius, gaussian), makeKernel(radius, [&](float x) { return -x * gaussian(x); }),
        makeKernel(radius, [&](float x) { return (x * x / (sigma * sigma) - 1) * gaussian(x); })};
    normalize(filters.gaussian);
    normalizeSigns(filters.edge);
    normalizeSigns(filters.point);
    return filters;
}

/// Length of the response to a filter in x and the same in y.
Plane featureStrength(const Plane& plane, const Plane& smoothedRows, const Kernel& derivative,
                      const Kernel& gaussian) {
    Plane result = filterColumns(filterRows(plane, derivative), gaussian);
    const Plane vertical = filterColumns(smoothedRows, derivative);
    for (std::size_t i = 0; i < result.values.size(); ++i)
        result.values[i] = std::hypot(result.values[i], vertical.values[i]);
    return result;
}

struct Features {
    Plane edge, point;
};

Features featuresOf(const Plane& achromatic, float pixelsPerDegree) {
    const FeatureFilters filters = featureFilters(pixelsPerDegree);
    Plane grey = achromatic;
    for (float& v : grey.values) v = (v + 16) / 116;
    const Plane smoothed = filterRows(grey, filters.gaussian);
    return {featureStrength(grey, smoothed, filters.edge, filters.gaussian),
            featureStrength(grey, smoothed, filters.point, filters.gaussian)};
}

float featureError(const Features& a, const Features& b, std::size_t i) {
    const float edge = std::abs(a.edge.values[i] - b.edge.values[i]);
    const float point = std::abs(a.point.values[i] - b.point.values[i]);
    return std::sqrt(std::max(edge, point) / std::numbers::sqrt2_v<float>);  // q_f = 1/2
}

// -------------------------------------------------------------------------------------------------

double maskedMean(const std::vector<float>& values, PixelMask mask) {
    double total = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (mask.empty() || mask[i] != 0) total += values[i], ++count;
    return total / static_cast<double>(count);
}

}  // namespace

FlipResult flip(const Image& test, const Image& reference, float pixelsPerDegree, PixelMask mask) {
    requireComparable(test, reference, mask);
    if (!(pixelsPerDegree >= 1 && pixelsPerDegree <= 1000))
        throw InputError("pixels per degree must be between 1 and 1000");
    const Opponent opponentTest = opponentOf(test), opponentReference = opponentOf(reference);
    const auto colorsTest = perceivedColors(opponentTest, pixelsPerDegree);
    const auto colorsReference = perceivedColors(opponentReference, pixelsPerDegree);
    const Features featuresTest = featuresOf(opponentTest[0], pixelsPerDegree);
    const Features featuresReference = featuresOf(opponentReference[0], pixelsPerDegree);

    FlipResult result;
    result.error.resize(test.pixels.size());
    const float largest = largestColorDifference();
    parallelFor(result.error.size(), 4096, [&](std::size_t i) {
        const float color = colorError(colorsTest[i], colorsReference[i], largest);
        const float feature = featureError(featuresTest, featuresReference, i);
        result.error[i] = std::pow(color, 1 - feature);
    });
    result.mean = maskedMean(result.error, mask);
    return result;
}

}  // namespace vlf
