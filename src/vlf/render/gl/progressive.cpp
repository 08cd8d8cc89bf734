#include "vlf/render/gl/progressive.h"

#include "vlf/render/cpu/supersample.h"
#include "vlf/render/gl/picture_mean.h"
#include "vlf/render/gl/tile_clock.h"

#include <chrono>
#include <vector>

namespace vlf {

namespace {

using namespace gl;
using Clock = std::chrono::steady_clock;

/// Counts so much more in the mean than the 1 of what is there before that it replaces that.
constexpr float kSampleWeight = 1e6f;
constexpr int kTileUnit = TileClock::kCell;  ///< sides of tiles, pixels, are multiples of this
constexpr double kTileShare = 0.25;          ///< of the time for tiles, for one of them
constexpr double kWorkShare =
    0.25;                      ///< of the time of a call, for tiles, however long showing takes
constexpr int kCoarsest = 16;  ///< pixels of the view along a side of one that is drawn

/// What the samples depend on.
struct Subject {
    Mat4 clipFromWorld{0};
    Vec3 eye{0};
    int width = 0, height = 0;
    LookupKind lookup = LookupKind::depthCorrected;
    float textureBias = 0;
    std::uint64_t lightChanges = 0;

    bool operator==(const Subject&) const = default;
};

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double pixelsOf(const PixelRectangle& r) {
    return static_cast<double>(r.width) * r.height;
}

}  // namespace

struct ProgressiveRenderer::Impl {
    Impl(Renderer& used, const RendererOptions& options)
        : renderer(used), mean(options.shaderFolder) {
        compileShaders();
    }

    /// By drawing a pixel with each.
    void compileShaders() {
        mean.resize(1, 1);
        picture = FloatTarget(1, 1);
        View pixel;
        pixel.width = pixel.height = 1;
        drawSample(pixel, DisplayMode::raytraced, 0, picture);
        if (renderer.canLookUp()) drawSample(pixel, DisplayMode::field, 0, mean.sum());
        mean.add(picture, 1, 1, 1, {0, 0, 1, 1});
        mean.show(pixel, {}, picture.framebuffer.id());
        glFinish();
    }

    void draw(const View& view, const RenderSettings& settings, GLuint framebuffer, double budget) {
        const Subject wanted{view.clipFromWorld,
                             view.eye,
                             view.width,
                             view.height,
                             settings.lookup,
                             settings.textureBias,
                             renderer.lightChanges()};
        const bool moved = !(wanted == subject);
        if (moved) restart(wanted);
        if (moved && renderer.canLookUp()) {
            RenderSettings atOnce = settings;
            atOnce.mode = DisplayMode::field;
            View whole = view;
            whole.part.reset();
            renderer.draw(whole, atOnce, framebuffer);
        } else {
            if (begun)
                refine(std::max(budget - showSeconds, kWorkShare * budget));
            else
                begin(budget);
            show(view, settings, framebuffer);
        }
        glFinish();
    }

    void restart(const Subject& wanted) {
        subject = wanted;
        if (picture.width != subject.width || picture.height != subject.height) {
            picture = FloatTarget(subject.width, subject.height);
            mean.resize(subject.width, subject.height);
            clock.resize(subject.width, subject.height);
        }
        begun = false;
        tiles.clear();
        samples = 0;
        pixels = 0;
    }

    View subjectView() const {
        View view;
        view.clipFromWorld = subject.clipFromWorld;
        view.eye = subject.eye;
        view.width = subject.width;
        view.height = subject.height;
        return view;
    }

    void drawSample(const View& view, DisplayMode mode, float textureBias,
                    const FloatTarget& target) {
        RenderSettings settings;
        settings.mode = mode;
        settings.lookup = subject.lookup;
        settings.tone.reset();
        settings.textureBias = textureBias;
        renderer.draw(view, settings, target.framebuffer.id());
    }

    /// What is seen until samples take its place.
    void begin(double budget) {
        if (renderer.canLookUp())
            drawSample(subjectView(), DisplayMode::field, subject.textureBias, mean.sum());
        else
            beginCoarsely(budget);
        begun = true;
    }

    void beginCoarsely(double budget) {
        const Clock::time_point start = Clock::now();
        View view = subjectView();
        view.width = (view.width + coarseness - 1) / coarseness;
        view.height = (view.height + coarseness - 1) / coarseness;
        drawSample(view, DisplayMode::raytraced, subject.textureBias, picture);
        mean.clear();
        mean.add(picture, view.width, view.height, 1, {0, 0, subject.width, subject.height});
        glFinish();
        adaptCoarseness(secondsSince(start) / budget);
    }

    /// `share`: of the time of a call.
    void adaptCoarseness(double share) {
        if (share > 1 && coarseness < kCoarsest) coarseness *= 2;
        if (share < 0.2 && coarseness > 1) coarseness /= 2;
    }

    /// Draws tiles of the sample in work for `budget` seconds, one at least.
    void refine(double budget) {
        const Clock::time_point start = Clock::now();
        for (bool first = true; samples < kSamples; first = false) {
            if (tiles.empty()) tiles.push_back({0, 0, subject.width, subject.height});
            while (clock.shading(tiles.back()) > kTileShare * budget && split()) continue;
            const PixelRectangle tile = tiles.back();
            if (!first && secondsSince(start) + clock.drawing(tile) > budget) return;
            drawTile(tile);
        }
    }

    void drawTile(const PixelRectangle& tile) {
        const Clock::time_point start = Clock::now();
        View view = shifted(subjectView(), samplePoint(orderOf(samples), kSamplesAlongSide) - 0.5f);
        view.part = tile;
        drawSample(view, DisplayMode::raytraced,
                   subject.textureBias - std::log2(static_cast<float>(kSamplesAlongSide)), picture);
        mean.add(picture, subject.width, subject.height, kSampleWeight, tile);
        glFinish();
        clock.note(tile, secondsSince(start));
        tiles.pop_back();
        pixels += pixelsOf(tile);
        if (tiles.empty()) ++samples;
    }

    /// Halves the tile to be drawn next; false if it is small enough to be drawn at any cost.
    bool split() {
        const auto half = [](int side) { return kTileUnit * ((side / kTileUnit + 1) / 2); };
        PixelRectangle& a = tiles.back();
        PixelRectangle b = a;
        if (std::max(a.width, a.height) <= kTileUnit) return false;
        if (a.width > a.height) {
            a.width = half(a.width);
            b.x += a.width;
            b.width -= a.width;
        } else {
            a.height = half(a.height);
            b.y += a.height;
            b.height -= a.height;
        }
        tiles.push_back(b);
        return true;
    }

    void show(const View& view, const RenderSettings& settings, GLuint framebuffer) {
        const Clock::time_point start = Clock::now();
        mean.show(view, settings, framebuffer);
        glFinish();
        showSeconds = secondsSince(start);
    }

    /// Spreads the first few samples over the pixel: strides of the golden section.
    static int orderOf(int sample) {
        constexpr int kStride = 39;
        return sample * kStride % kSamples;
    }

    Renderer& renderer;
    PictureMean mean;
    FloatTarget picture;
    Subject subject;
    TileClock clock;
    std::vector<PixelRectangle> tiles;  ///< of the sample in work, the next one last
    bool begun = false;
    int coarseness = 4, samples = 0;
    double pixels = 0;       ///< of all samples
    double showSeconds = 0;  ///< that the last show took
};

ProgressiveRenderer::ProgressiveRenderer(Renderer& renderer, const RendererOptions& options)
    : impl_(std::make_unique<Impl>(renderer, options)) {}
ProgressiveRenderer::~ProgressiveRenderer() = default;
ProgressiveRenderer::ProgressiveRenderer(ProgressiveRenderer&&) noexcept = default;
ProgressiveRenderer& ProgressiveRenderer::operator=(ProgressiveRenderer&&) noexcept = default;

void ProgressiveRenderer::draw(const View& view, const RenderSettings& settings,
                               unsigned framebuffer, double seconds) {
    impl_->draw(view, settings, framebuffer, seconds);
}

int ProgressiveRenderer::samples() const {
    return impl_->samples;
}

double ProgressiveRenderer::progress() const {
    const Subject& s = impl_->subject;
    return s.width == 0 ? 0 : impl_->pixels / (static_cast<double>(kSamples) * s.width * s.height);
}

}  // namespace vlf
