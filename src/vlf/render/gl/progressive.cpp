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

/// What is there before the first sample counts so little in the mean that a sample replaces it.
constexpr float kFirstWeight = 1e-6f;
constexpr int kSmallestTile = 32;    ///< pixels along a side
constexpr double kTileShare = 0.25;  ///< of the time of a call, for one tile
constexpr int kCoarsest = 16;        ///< pixels of the view along a side of one that is drawn

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
        // Compiles the shaders, too.
        mean.restart(1, 1);
        picture = FloatTarget(1, 1);
        View nothing;
        nothing.width = nothing.height = 1;
        drawSample(nothing, DisplayMode::raytraced, {});
        mean.add(picture, 1, 1, 1, {0, 0, 1, 1});
        glFinish();
    }

    void draw(const View& view, const RenderSettings& settings, GLuint framebuffer, double budget) {
        const Clock::time_point start = Clock::now();
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
            const bool begins = !begun;
            if (begins) begin(budget);
            if (!moved) refine(start, budget - showSeconds, begins);
            show(view, settings, framebuffer);
        }
        glFinish();
    }

    void restart(const Subject& wanted) {
        subject = wanted;
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

    /// Draws into the lower left of `picture`.
    void drawSample(const View& view, DisplayMode mode, float textureBias) {
        RenderSettings settings;
        settings.mode = mode;
        settings.lookup = subject.lookup;
        settings.tone.reset();
        settings.textureBias = textureBias;
        renderer.draw(view, settings, picture.framebuffer.id());
    }

    /// What is seen until samples take its place.
    void begin(double budget) {
        const Clock::time_point start = Clock::now();
        mean.restart(subject.width, subject.height);
        if (picture.width != subject.width || picture.height != subject.height)
            picture = FloatTarget(subject.width, subject.height);
        const bool coarse = !renderer.canLookUp();
        View view = subjectView();
        if (coarse) {
            view.width = (view.width + coarseness - 1) / coarseness;
            view.height = (view.height + coarseness - 1) / coarseness;
        }
        drawSample(view, coarse ? DisplayMode::raytraced : DisplayMode::field, subject.textureBias);
        mean.add(picture, view.width, view.height, kFirstWeight,
                 {0, 0, subject.width, subject.height});
        glFinish();
        begun = true;
        if (coarse) adaptCoarseness(secondsSince(start) / budget);
    }

    /// `share`: of the time of a call.
    void adaptCoarseness(double share) {
        if (share > 1 && coarseness < kCoarsest) coarseness *= 2;
        if (share < 0.2 && coarseness > 1) coarseness /= 2;
    }

    /// Draws tiles of the sample in work until `budget` seconds have passed since `start`: one at
    /// least, unless other work has been done.
    void refine(Clock::time_point start, double budget, bool worked) {
        while (samples < kSamples) {
            if (tiles.empty()) tiles.push_back({0, 0, subject.width, subject.height});
            const PixelRectangle tile = tiles.back();
            if (clock.shading(pixelsOf(tile)) > kTileShare * budget && split()) continue;
            if (worked && secondsSince(start) + clock.drawing(pixelsOf(tile)) > budget) return;
            drawTile(tile);
            worked = true;
        }
    }

    void drawTile(const PixelRectangle& tile) {
        const Clock::time_point start = Clock::now();
        View view = shifted(subjectView(), samplePoint(orderOf(samples), kSamplesAlongSide) - 0.5f);
        view.part = tile;
        drawSample(view, DisplayMode::raytraced,
                   subject.textureBias - std::log2(static_cast<float>(kSamplesAlongSide)));
        mean.add(picture, subject.width, subject.height, 1, tile);
        glFinish();
        clock.note(pixelsOf(tile), secondsSince(start));
        tiles.pop_back();
        pixels += pixelsOf(tile);
        if (tiles.empty()) ++samples;
    }

    /// Halves the tile to be drawn next; false if it is small enough to be drawn at any cost.
    bool split() {
        PixelRectangle& a = tiles.back();
        PixelRectangle b = a;
        if (std::max(a.width, a.height) < 2 * kSmallestTile) return false;
        if (a.width > a.height) {
            a.width /= 2;
            b.x += a.width;
            b.width -= a.width;
        } else {
            a.height /= 2;
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
