#include "vlf/scene/generate/procedural_texture.h"

#include "vlf/math/random.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

namespace vlf {

namespace {

constexpr int kPictureSize = 256;

float latticeValue(int x, int y, int period, std::uint64_t seed) {
    const auto wrap = [&](int i) {
        return static_cast<std::uint64_t>(((i % period) + period) % period);
    };
    return RandomStream(seed, wrap(x) << 32 | wrap(y)).next();
}

float valueNoise(const Vec2& p, int period, std::uint64_t seed) {
    const Vec2 cell = glm::floor(p), f = p - cell, s = f * f * (3.0f - 2.0f * f);
    const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y);
    return glm::mix(
        glm::mix(latticeValue(x, y, period, seed), latticeValue(x + 1, y, period, seed), s.x),
        glm::mix(latticeValue(x, y + 1, period, seed), latticeValue(x + 1, y + 1, period, seed),
                 s.x),
        s.y);
}

std::uint8_t toByte(float value) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

/// 0 below `edge`, 1 above, blended over the width of a pixel or two.
float step(float edge, float x) {
    return glm::smoothstep(edge - 1.0f / kPictureSize, edge + 1.0f / kPictureSize, x);
}

Texture paintPicture(const std::string& name, const std::function<Vec3(const Vec2& uv)>& colour) {
    return paintTexture(name, kPictureSize, kPictureSize, Wrap::clamp, colour);
}

}  // namespace

Texture paintTexture(const std::string& name, int width, int height, Wrap wrap,
                     const std::function<Vec3(const Vec2& uv)>& colour) {
    Texture texture{name, width, height, {}, {}, wrap, wrap};
    texture.srgb8.reserve(std::size_t{4} * width * height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Vec3 c =
                colour({(static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                        1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(height)});
            for (int channel = 0; channel < 3; ++channel)
                texture.srgb8.push_back(toByte(c[channel]));
            texture.srgb8.push_back(255);
        }
    }
    return texture;
}

float fractalNoise(const Vec2& p, int period, int octaves, std::uint64_t seed) {
    float sum = 0, weight = 0.5f, total = 0;
    for (int octave = 0; octave < octaves; ++octave, weight *= 0.5f) {
        const int frequency = 1 << octave;
        sum += weight *
               valueNoise(static_cast<float>(frequency) * p, frequency * period, seed + octave);
        total += weight;
    }
    return sum / total;
}

Texture woodTexture(const std::string& name, const Vec3& dark, const Vec3& light, int planks) {
    return paintTexture(name, 512, 512, Wrap::repeat, [&](const Vec2& uv) {
        const float across = uv.y * static_cast<float>(planks);
        const float plank = std::floor(across);
        RandomStream random(11, static_cast<std::uint64_t>(plank));
        const float tone = 0.35f * random.next(), joint = random.next();
        const float along = uv.x - joint - std::floor(uv.x - joint);
        const float grain = fractalNoise({4 * along, 16 * across}, 4 * 16 * planks, 5, 17);
        const float rings = 0.5f + 0.5f * std::sin(40 * (grain + 0.15f * across));
        const Vec3 wood = glm::mix(dark, light, 0.25f + tone + 0.25f * grain + 0.15f * rings);
        const bool gap = planks > 1 && (across - plank < 0.02f || along < 0.004f);
        return gap ? 0.6f * wood : wood;
    });
}

Texture tileTexture(const std::string& name, const Vec3& tile, const Vec3& other, const Vec3& grout,
                    int tiles) {
    return paintTexture(name, 256, 256, Wrap::repeat, [&](const Vec2& uv) {
        const Vec2 p = uv * static_cast<float>(tiles), cell = glm::floor(p), f = p - cell;
        if (std::min({f.x, f.y, 1 - f.x, 1 - f.y}) < 0.025f) return grout;
        const bool odd = static_cast<int>(cell.x + cell.y) % 2 == 1;
        return (odd ? other : tile) *
               (0.92f + 0.16f * (fractalNoise(8.0f * p, 8 * tiles, 3, 5) - 0.5f));
    });
}

Texture mountainPainting() {
    return paintPicture("mountains", [](const Vec2& uv) {
        Vec3 colour = glm::mix(Vec3(0.98f, 0.80f, 0.55f), Vec3(0.30f, 0.45f, 0.75f), uv.y);
        colour = glm::mix(Vec3(1.0f, 0.95f, 0.75f), colour,
                          step(0.07f, glm::distance(uv, Vec2(0.68f, 0.70f))));
        const std::array<Vec3, 3> ranges{Vec3(0.55f, 0.55f, 0.72f), Vec3(0.35f, 0.40f, 0.55f),
                                         Vec3(0.13f, 0.22f, 0.25f)};
        for (int i = 0; i < 3; ++i) {
            const float x = uv.x * static_cast<float>(3 + i);
            const float ridge = 0.48f - 0.16f * static_cast<float>(i) +
                                0.34f * (fractalNoise({x, 0.5f}, 64, 5, 31 + i) - 0.4f);
            colour = glm::mix(ranges[i], colour, step(ridge, uv.y));
        }
        return colour;
    });
}

Texture seaPainting() {
    return paintPicture("sea", [](const Vec2& uv) {
        constexpr float kHorizon = 0.42f;
        const Vec3 sky = glm::mix(Vec3(1.0f, 0.62f, 0.30f), Vec3(0.32f, 0.22f, 0.45f),
                                  (uv.y - kHorizon) / (1 - kHorizon));
        const float depth = std::max(0.02f, kHorizon - uv.y);
        const float ripple = fractalNoise({2 * uv.x / depth, 6 / depth}, 1 << 12, 3, 77);
        const float glitter = std::exp(-20 * std::fabs(uv.x - 0.5f)) * step(0.5f, ripple);
        const Vec3 sea = glm::mix(Vec3(0.10f, 0.20f, 0.35f), Vec3(0.30f, 0.38f, 0.50f), ripple) +
                         glitter * Vec3(0.8f, 0.5f, 0.2f);
        const Vec3 back = glm::mix(sea, sky, step(kHorizon, uv.y));
        const bool sun = uv.y > kHorizon && glm::distance(uv, Vec2(0.5f, kHorizon + 0.05f)) < 0.12f;
        return sun ? Vec3(1.0f, 0.90f, 0.60f) : back;
    });
}

Texture blockPainting() {
    struct Block {
        Vec2 lower, upper;
        Vec3 colour;
    };
    static const std::array<Block, 6> kBlocks{
        {{{0.00f, 0.36f}, {0.62f, 1.00f}, {0.82f, 0.12f, 0.10f}},
         {{0.62f, 0.70f}, {1.00f, 1.00f}, {0.94f, 0.92f, 0.86f}},
         {{0.00f, 0.00f}, {0.24f, 0.36f}, {0.12f, 0.22f, 0.58f}},
         {{0.24f, 0.00f}, {0.80f, 0.36f}, {0.94f, 0.92f, 0.86f}},
         {{0.80f, 0.00f}, {1.00f, 0.20f}, {0.96f, 0.80f, 0.16f}},
         {{0.62f, 0.36f}, {1.00f, 0.70f}, {0.90f, 0.88f, 0.80f}}}};
    return paintPicture("blocks", [](const Vec2& uv) {
        constexpr float kLine = 0.014f;
        for (const Block& b : kBlocks) {
            const Vec2 low = uv - b.lower, high = b.upper - uv;
            if (std::min({low.x, low.y, high.x, high.y}) > kLine) return b.colour;
        }
        return Vec3(0.06f);
    });
}

Texture circlePainting() {
    return paintPicture("circles", [](const Vec2& uv) {
        const Vec2 p = 3.0f * uv, cell = glm::floor(p);
        const float r = glm::length(p - cell - 0.5f);
        RandomStream random(5, static_cast<std::uint64_t>(cell.x + 3 * cell.y));
        Vec3 colour(random.next(), random.next(), random.next());
        for (const float radius : {0.46f, 0.36f, 0.25f, 0.13f}) {
            const Vec3 ring(random.next(), random.next(), random.next());
            colour = glm::mix(0.15f + 0.8f * ring, colour, step(radius, r));
        }
        return colour;
    });
}

Texture wavePainting() {
    return paintPicture("waves", [](const Vec2& uv) {
        static const std::array<Vec3, 5> kColours{
            Vec3(0.95f, 0.55f, 0.20f), Vec3(0.93f, 0.83f, 0.65f), Vec3(0.16f, 0.50f, 0.52f),
            Vec3(0.08f, 0.24f, 0.32f), Vec3(0.78f, 0.24f, 0.20f)};
        const float bend = 0.9f * std::sin(5 * uv.x + 1.5f * uv.y) + 0.3f * std::sin(13 * uv.x);
        const float band = 9 * uv.y + bend + 2;
        return kColours[static_cast<int>(std::floor(band)) % 5];
    });
}

Texture skyTexture() {
    return paintPicture("sky", [](const Vec2& uv) {
        const float cloud = fractalNoise({3 * uv.x, 6 * uv.y}, 64, 5, 3);
        const Vec3 blue = glm::mix(Vec3(0.80f, 0.90f, 1.0f), Vec3(0.45f, 0.68f, 0.98f), uv.y);
        const Vec3 sky = glm::mix(blue, Vec3(1), glm::smoothstep(0.50f, 0.72f, cloud));
        const float hill = 0.22f + 0.16f * fractalNoise({2 * uv.x, 0.5f}, 64, 4, 8);
        const float trees = fractalNoise({24 * uv.x, 24 * uv.y}, 64, 3, 9);
        const Vec3 green = glm::mix(Vec3(0.22f, 0.42f, 0.16f), Vec3(0.42f, 0.60f, 0.28f), trees);
        return glm::mix(green, sky, step(hill, uv.y));
    });
}

Texture lavaTexture() {
    return paintPicture("lava", [](const Vec2& uv) {
        const float n = fractalNoise({6 * uv.x, 6 * uv.y}, 6, 5, 41);
        const float heat = std::pow(1 - std::min(1.0f, 7 * std::fabs(n - 0.5f)), 1.5f);
        return Vec3(0.15f, 0.02f, 0.01f) + heat * Vec3(0.85f, 0.75f, 0.25f);
    });
}

Texture canopyTexture() {
    return paintPicture("canopy", [](const Vec2& uv) {
        const float r = 2 * glm::distance(uv, Vec2(0.5f));
        const float leaves = fractalNoise({9 * uv.x, 9 * uv.y}, 9, 4, 23);
        const float open = glm::smoothstep(0.45f, 0.60f, leaves + 0.55f * (0.72f - r));
        return glm::mix(Vec3(0.05f, 0.11f, 0.03f), Vec3(0.86f, 0.95f, 1.0f), open);
    });
}

}  // namespace vlf
