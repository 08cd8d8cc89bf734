#include "vlf/render/cpu/supersample.h"

#include "vlf/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <vector>

namespace vlf {

namespace {

constexpr int kTile = 32;      ///< pixels
constexpr int kFirstSide = 2;  ///< rays along a side of every pixel

/// Relative difference above which a pixel is refined: about four of the 255 steps of a display.
constexpr float kContrast = 0.04f;

/// Pixels [x0, x1) x [y0, y1).
struct PixelBlock {
    int x0, y0, x1, y1;

    int width() const { return x1 - x0; }
    std::size_t size() const { return static_cast<std::size_t>(width()) * (y1 - y0); }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - y0) * width() + (x - x0);
    }
    PixelBlock withBorder(int pictureWidth, int pictureHeight) const {
        return {std::max(x0 - 1, 0), std::max(y0 - 1, 0), std::min(x1 + 1, pictureWidth),
                std::min(y1 + 1, pictureHeight)};
    }
};

/// What the rays of a pixel, or of some pixels, have seen.
struct ColorRange {
    Vec3 lower{std::numeric_limits<float>::max()}, upper{0};

    void add(const ColorRange& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
    bool wide() const { return maxComponent(upper - lower - kContrast * (upper + lower)) > 0; }
};

struct PixelSamples {
    Vec3 mean{0};
    ColorRange range;
};

class TileSampler {
  public:
    TileSampler(const CameraRays& camera, const RayShader& shade)
        : camera_(camera), shade_(shade) {}

    void addPixel(int x, int y, int n) {
        for (int i = 0; i < n * n; ++i) {
            const Vec2 point = samplePoint(i, n);
            queue_.push_back(camera_.ray(x + point.x, y + point.y));
        }
    }

    /// Colours the pixels added since the last call, n x n rays each, in their order.
    const std::vector<PixelSamples>& shadePixels(int n) {
        colors_.resize(queue_.size());
        traced_ += shade_(queue_, n * n, colors_);
        const std::size_t perPixel = static_cast<std::size_t>(n) * n;
        pixels_.assign(queue_.size() / perPixel, {});
        for (std::size_t i = 0; i < colors_.size(); ++i) {
            PixelSamples& pixel = pixels_[i / perPixel];
            pixel.mean += colors_[i] / static_cast<float>(perPixel);
            pixel.range.add({colors_[i], colors_[i]});
        }
        queue_.clear();
        return pixels_;
    }

    std::uint64_t traced() const { return traced_; }

  private:
    const CameraRays& camera_;
    const RayShader& shade_;
    std::vector<Ray> queue_;
    std::vector<Vec3> colors_;
    std::vector<PixelSamples> pixels_;
    std::uint64_t traced_ = 0;
};

bool differsAround(const std::vector<PixelSamples>& pixels, const PixelBlock& block, int x, int y) {
    ColorRange range;
    for (int j = std::max(y - 1, block.y0); j < std::min(y + 2, block.y1); ++j)
        for (int i = std::max(x - 1, block.x0); i < std::min(x + 2, block.x1); ++i)
            range.add(pixels[block.index(i, j)].range);
    return range.wide();
}

std::uint64_t renderTile(const PixelBlock& tile, const CameraRays& camera, const RayShader& shade,
                         int n, Image& image) {
    TileSampler sampler(camera, shade);
    const int first = std::min(n, kFirstSide);
    const PixelBlock block = n > first ? tile.withBorder(image.width, image.height) : tile;
    for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x) sampler.addPixel(x, y, first);
    const std::vector<PixelSamples> coarse = sampler.shadePixels(first);

    std::vector<Vec3*> refined;
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
            image.at(x, y) = coarse[block.index(x, y)].mean;
            if (n <= first || !differsAround(coarse, block, x, y)) continue;
            sampler.addPixel(x, y, n);
            refined.push_back(&image.at(x, y));
        }
    const std::vector<PixelSamples>& fine = sampler.shadePixels(n);
    for (std::size_t i = 0; i < refined.size(); ++i) *refined[i] = fine[i].mean;
    return sampler.traced();
}

}  // namespace

Image supersample(const CameraRays& camera, int width, int height, int n, const RayShader& shade,
                  Progress& progress, std::uint64_t& traced) {
    Image image(width, height);
    const int columns = (width + kTile - 1) / kTile, rows = (height + kTile - 1) / kTile;
    const std::size_t tiles = static_cast<std::size_t>(columns) * rows;
    ProgressCounter counter(progress, tiles);
    std::atomic<std::uint64_t> total{0};
    parallelFor(tiles, [&](std::size_t i) {
        const int x = kTile * static_cast<int>(i % columns);
        const int y = kTile * static_cast<int>(i / columns);
        const PixelBlock tile{x, y, std::min(x + kTile, width), std::min(y + kTile, height)};
        total += renderTile(tile, camera, shade, n, image);
        counter.step();
    });
    traced = total;
    return image;
}

}  // namespace vlf
