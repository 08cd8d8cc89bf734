#include "vlf/scene/sky.h"

#include "vlf/base/parallel.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr double kMostOfMean = 4;  // luminance of the smooth part, of its mean
constexpr int kBisections = 40;
constexpr float kLeastSine = 1e-6f;

double rowSine(int row, int height) {
    return std::sin(std::numbers::pi * (row + 0.5) / height);
}

/// Luminances of a picture's pixels and the solid angles of its rows' pixels, which sum to 1.
struct Luminances {
    std::vector<float> pixels;
    std::vector<double> rowShare;
    int width, height;

    explicit Luminances(const Environment& e)
        : pixels(e.picture.pixels.size()), width(e.picture.width), height(e.picture.height) {
        for (std::size_t i = 0; i < pixels.size(); ++i)
            pixels[i] = luminance(e.radiance * e.picture.pixels[i]);
        double sum = 0;
        for (int y = 0; y < height; ++y) {
            rowShare.push_back(rowSine(y, height));
            sum += rowShare.back() * width;
        }
        for (double& share : rowShare) share /= sum;
    }

    /// Mean over the sphere of what is at most `cap`.
    double meanBelow(double cap) const {
        std::vector<double> rows(static_cast<std::size_t>(height));
        parallelFor(rows.size(), 16, [&](std::size_t y) {
            const float* row = pixels.data() + y * static_cast<std::size_t>(width);
            double sum = 0;
            for (int x = 0; x < width; ++x) sum += std::min<double>(row[x], cap);
            rows[y] = sum * rowShare[y];
        });
        double sum = 0;
        for (const double row : rows) sum += row;
        return sum;
    }
};

/// Of [0, 1) one in [-1, 1] of density 1 - |x|.
float tent(float u) {
    return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
}

}  // namespace

float meanLuminance(const Environment& environment) {
    if (environment.isUniform()) return luminance(environment.radiance);
    const Luminances luminances(environment);
    return static_cast<float>(luminances.meanBelow(
        *std::max_element(luminances.pixels.begin(), luminances.pixels.end())));
}

float smoothCap(const Environment& environment) {
    if (environment.isUniform()) return luminance(environment.radiance);
    const Luminances luminances(environment);
    const double most = *std::max_element(luminances.pixels.begin(), luminances.pixels.end());
    // The mean below a cap, relative to it, falls as the cap rises.
    const auto fits = [&](double cap) { return cap <= kMostOfMean * luminances.meanBelow(cap); };
    if (!(most > 0) || fits(most)) return static_cast<float>(most);
    double low = 0, high = most;
    for (int i = 0; i < kBisections && high - low > 1e-4 * high; ++i) {
        const double middle = 0.5 * (low + high);
        (fits(middle) ? low : high) = middle;
    }
    return static_cast<float>(low > 1e-6 * most ? low : 0);
}

Sky::Sky(const Environment& environment, float cap) : environment_(&environment), cap_(cap) {
    if (environment.isBlack() || environment.isUniform()) return;
    const auto w = static_cast<std::size_t>(width()), h = static_cast<std::size_t>(height());
    weights_.resize(w * h);
    columns_.resize(w * h);
    rows_.resize(h);
    parallelFor(h, 16, [&](std::size_t y) {
        const double sine = rowSine(static_cast<int>(y), height());
        double sum = 0;
        for (std::size_t i = y * w; i < (y + 1) * w; ++i) {
            const Vec3& pixel = environment.picture.pixels[i];
            weights_[i] = static_cast<float>(sine * brightShare(pixel) *
                                             luminance(environment.radiance * pixel));
            columns_[i] = static_cast<float>(sum += weights_[i]);
        }
        rows_[y] = sum;
    });
    for (double& row : rows_) row = total_ += row;
    if (total_ > 0) return;
    weights_.clear();
    columns_.clear();
}

float Sky::brightShare(const Vec3& pixel) const {
    const float l = luminance(environment_->radiance * pixel);
    return l > cap_ ? 1 - cap_ / l : 0;
}

Vec3 Sky::radiance(const Vec3& direction) const {
    return isBlack() ? Vec3(0) : skyRadiance(*environment_, direction);
}

Vec3 Sky::smoothAt(const Vec2& place) const {
    if (environment_->isUniform()) return environment_->radiance;
    const SkyPixels pixels(width(), height(), place);
    Vec3 sum(0);
    for (int k = 0; k < 4; ++k) {
        const Vec3& pixel = environment_->picture.pixels[pixels.index[k]];
        sum += pixels.weight[k] * (1 - brightShare(pixel)) * pixel;
    }
    return environment_->radiance * sum;
}

Vec3 Sky::brightAt(const Vec2& place) const {
    const SkyPixels pixels(width(), height(), place);
    Vec3 sum(0);
    for (int k = 0; k < 4; ++k) {
        const Vec3& pixel = environment_->picture.pixels[pixels.index[k]];
        sum += pixels.weight[k] * brightShare(pixel) * pixel;
    }
    return environment_->radiance * sum;
}

Vec3 Sky::smooth(const Vec3& direction) const {
    if (isBlack()) return Vec3(0);
    return smoothAt(skyCoordinates(*environment_, direction));
}

Vec3 Sky::bright(const Vec3& direction) const {
    if (!hasBright()) return Vec3(0);
    return brightAt(skyCoordinates(*environment_, direction));
}

float Sky::densityAt(const Vec2& place) const {
    const SkyPixels pixels(width(), height(), place);
    float sum = 0;
    for (int k = 0; k < 4; ++k) sum += pixels.weight[k] * weights_[pixels.index[k]];
    const auto share = static_cast<float>(sum / total_ * static_cast<double>(weights_.size()));
    return share / (2 * kPi * kPi * std::max(std::sin(kPi * place.y), kLeastSine));
}

float Sky::density(const Vec3& direction) const {
    if (!hasBright()) return 0;
    return densityAt(skyCoordinates(*environment_, direction));
}

/// A pixel by its weight, and a point about its middle by the weight that it has there.
Sky::Sample Sky::sample(const Vec2& u) const {
    const auto w = static_cast<std::size_t>(width());
    const double row = static_cast<double>(u.y) * total_;
    const auto y = static_cast<std::size_t>(std::upper_bound(rows_.begin(), rows_.end() - 1, row) -
                                            rows_.begin());
    const double above = y > 0 ? rows_[y - 1] : 0;
    const auto ofRow = static_cast<float>((row - above) / (rows_[y] - above));
    const auto first = columns_.begin() + static_cast<std::ptrdiff_t>(y * w);
    const auto last = first + static_cast<std::ptrdiff_t>(w);
    const float column = u.x * *(last - 1);
    const auto found = std::upper_bound(first, last - 1, column);
    const float left = found == first ? 0 : *(found - 1);
    const float ofColumn = (column - left) / std::max(*found - left, 1e-30f);
    const auto inside = [](float x) { return std::clamp(x, 0.0f, 0.99999994f); };
    float px = static_cast<float>(found - first) + 0.5f + tent(inside(ofColumn));
    float py = static_cast<float>(y) + 0.5f + tent(inside(ofRow));
    const auto wide = static_cast<float>(width()), high = static_cast<float>(height());
    px = px < 0 ? px + wide : px >= wide ? px - wide : px;
    py = py < 0 ? -py : py > high ? 2 * high - py : py;
    const Vec2 place(px / wide, py / high);
    return {direction(place), brightAt(place), densityAt(place)};
}

Vec3 Sky::brightFlux() const {
    if (!hasBright()) return Vec3(0);
    glm::dvec3 sum(0);
    const auto w = static_cast<std::size_t>(width());
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        if (weights_[i] <= 0) continue;
        const Vec3& pixel = environment_->picture.pixels[i];
        sum += rowSine(static_cast<int>(i / w), height()) * brightShare(pixel) *
               glm::dvec3(environment_->radiance * pixel);
    }
    const double pixels = static_cast<double>(weights_.size());
    return Vec3(sum * (2 * std::numbers::pi * std::numbers::pi / pixels));
}

float Sky::brightCosine(const Vec3& axis) const {
    const float pixel = kPi / static_cast<float>(std::max(height(), 1));
    float least = 1;
    const auto w = static_cast<std::size_t>(width());
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        if (weights_[i] <= 0) continue;
        const Vec2 place((static_cast<float>(i % w) + 0.5f) / static_cast<float>(width()),
                         (static_cast<float>(i / w) + 0.5f) / static_cast<float>(height()));
        least = std::min(least, glm::dot(axis, direction(place)));
    }
    // What a pixel is blended with reaches over its neighbours.
    return std::cos(std::min(std::acos(std::clamp(least, -1.0f, 1.0f)) + 2 * pixel, kPi));
}

Sky::Grid Sky::smoothGrid(int gridWidth, int gridHeight) const {
    Grid grid{gridWidth, gridHeight, {}};
    grid.radiance.resize(static_cast<std::size_t>(gridWidth) *
                         static_cast<std::size_t>(gridHeight));
    if (isBlack()) return grid;
    const int finest = environment_->isUniform() ? 1 : width();
    const int steps = std::max(1, (finest + gridWidth - 1) / gridWidth);
    parallelFor(static_cast<std::size_t>(gridHeight), 8, [&](std::size_t y) {
        for (int x = 0; x < gridWidth; ++x) {
            Vec3 sum(0);
            for (int k = 0; k < steps * steps; ++k) {
                const Vec2 within(static_cast<float>(k % steps) + 0.5f,
                                  static_cast<float>(k / steps) + 0.5f);
                const Vec2 at = Vec2(static_cast<float>(x), static_cast<float>(y)) +
                                within / static_cast<float>(steps);
                sum += smoothAt(
                    at / Vec2(static_cast<float>(gridWidth), static_cast<float>(gridHeight)));
            }
            grid.radiance[y * static_cast<std::size_t>(gridWidth) + static_cast<std::size_t>(x)] =
                sum / static_cast<float>(steps * steps);
        }
    });
    return grid;
}

}  // namespace vlf
