#include "vlf/render/gl/packed_radiance.h"

#include "vlf/base/parallel.h"
#include "vlf/render/gl/shaders/shared.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace vlf {

namespace {

constexpr int kSums = (1 << shared::kSumBits) - 1;
constexpr int kReds = (1 << shared::kRedBits) - 1, kBlues = (1 << shared::kBlueBits) - 1;
constexpr int kDistances = (1 << shared::kDistanceBits) - 1;

// What is darker than this beside the brightest cannot be seen in one picture with it.
constexpr float kMostOctaves = 16;
constexpr float kDarkest = 1e-20f;  // black, as a sum of red, green and blue

float sumOf(const Vec3& rgb) {
    return rgb.x + rgb.y + rgb.z;
}

struct Range {
    float lower = std::numeric_limits<float>::max(), upper = std::numeric_limits<float>::lowest();

    void add(float v) {
        lower = std::min(lower, v);
        upper = std::max(upper, v);
    }
    void add(const Range& other) {
        lower = std::min(lower, other.lower);
        upper = std::max(upper, other.upper);
    }
    /// Codes from 0 to `largest` over the range.
    LinearCode code(int largest) const {
        if (lower > upper) return {0, 1};
        return {lower, std::max((upper - lower) / static_cast<float>(largest), 1e-6f)};
    }
};

/// What elements take of each part of a code.
struct Ranges {
    std::uint16_t longest = 1;
    Range logSum, red, blue;

    void add(const RadianceElement& e) {
        if (e.distance == 0) return;
        longest = std::max(longest, e.distance);
        const Vec3 rgb = unpackRgb9e5(e.rgb9e5());
        const float sum = sumOf(rgb);
        logSum.add(std::log2(std::max(sum, kDarkest)));
        if (sum <= 0) return;
        red.add(rgb.x / sum);
        blue.add(rgb.z / sum);
    }
    void add(const Ranges& other) {
        longest = std::max(longest, other.longest);
        logSum.add(other.logSum);
        red.add(other.red);
        blue.add(other.blue);
    }
};

void findCodes(const RadianceField& field, PackedRadiance& packed) {
    constexpr std::size_t kBlock = 1 << 16;
    std::vector<Ranges> blocks((field.elements.size() + kBlock - 1) / kBlock);
    parallelFor(blocks.size(), [&](std::size_t b) {
        const std::size_t end = std::min((b + 1) * kBlock, field.elements.size());
        for (std::size_t i = b * kBlock; i < end; ++i) blocks[b].add(field.elements[i]);
    });
    Ranges all;
    for (const Ranges& block : blocks) all.add(block);
    all.logSum.lower = std::max(all.logSum.lower, all.logSum.upper - kMostOctaves);
    packed.longestDistance = field.maxDistance * static_cast<float>(all.longest) / 65535;
    packed.logSum = all.logSum.code(kSums);
    packed.red = all.red.code(kReds);
    packed.blue = all.blue.code(kBlues);
}

/// What k x k cells of the field hold, as one: the median distance, and the mean radiance of the
/// cells that show the surface there. Distance 0 where no cell holds anything.
struct CellMean {
    std::uint16_t distance = 0;
    Vec3 radiance{0};
};

CellMean meanOf(const RadianceField& field, std::span<const TileRow> rows, int x, int y, int k) {
    if (k == 1) {
        const RadianceElement* e = field.element(rows, x, y);
        return e ? CellMean{e->distance, unpackRgb9e5(e->rgb9e5())} : CellMean{};
    }
    constexpr int kOneSurface = 65535 / 32;  // distances closer than this
    std::vector<const RadianceElement*> filled;
    for (int i = 0; i < k * k; ++i) {
        const RadianceElement* e = field.element(rows, k * x + i % k, k * y + i / k);
        if (e && e->distance > 0) filled.push_back(e);
    }
    if (filled.empty()) return {};
    const auto median = filled.begin() + static_cast<std::ptrdiff_t>(filled.size() / 2);
    std::nth_element(filled.begin(), median, filled.end(),
                     [](const auto* a, const auto* b) { return a->distance < b->distance; });
    CellMean mean{(*median)->distance, Vec3(0)};
    int count = 0;
    for (const RadianceElement* e : filled) {
        if (std::abs(e->distance - mean.distance) > kOneSurface) continue;
        mean.radiance += unpackRgb9e5(e->rgb9e5());
        ++count;
    }
    mean.radiance /= static_cast<float>(count);
    return mean;
}

/// Rounds up from `threshold` of the way to the next code.
std::uint32_t encode(float v, const LinearCode& code, int largest, float threshold = 0.5f) {
    const float c = std::floor((v - code.first) / code.step + 1 - threshold);
    return static_cast<std::uint32_t>(std::clamp(c, 0.0f, static_cast<float>(largest)));
}

/// Ordered dither: the mean of four neighbouring cells, which is what a lookup takes, is finer than
/// the codes.
float thresholdOf(int x, int y) {
    constexpr float kThresholds[2][2] = {{0.125f, 0.625f}, {0.875f, 0.375f}};
    return kThresholds[y & 1][x & 1];
}

/// What the subfield's cell (x, y) holds.
std::uint32_t pack(const CellMean& cell, int x, int y, const RadianceField& field,
                   const PackedRadiance& packed) {
    const float metres = field.maxDistance * static_cast<float>(cell.distance) / 65535;
    const std::uint32_t distance =
        std::max(1u, encode(metres, {0, packed.longestDistance / kDistances}, kDistances));
    const Vec3& rgb = cell.radiance;
    const float sum = std::max(sumOf(rgb), kDarkest);
    // Each part its own pattern, so that they do not err all in the same cells.
    const std::uint32_t logSum = encode(std::log2(sum), packed.logSum, kSums, thresholdOf(x, y));
    const std::uint32_t red = encode(rgb.x / sum, packed.red, kReds, thresholdOf(x + 1, y));
    const std::uint32_t blue = encode(rgb.z / sum, packed.blue, kBlues, thresholdOf(x, y + 1));
    using namespace shared;
    return distance | logSum << kDistanceBits | red << (kDistanceBits + kSumBits) |
           blue << (kDistanceBits + kSumBits + kRedBits);
}

void fill(const RadianceField& field, std::span<const TileRow> rows, const RadianceRecord& record,
          int coarseness, PackedRadiance& packed) {
    std::size_t next = record.firstElement;
    for (int row = 0; row < record.height; ++row)
        for (int i = 0; i < record.width; ++i, ++next) {
            const int x = record.firstColumn(row) + i, y = record.y + row;
            const CellMean cell = meanOf(field, rows, x, y, coarseness);
            if (cell.distance > 0) packed.elements[next] = pack(cell, x, y, field, packed);
        }
}

}  // namespace

PackedRadiance packRadiance(const RadianceField& field, const std::vector<std::uint32_t>& charts,
                            const RadianceLayout& layout) {
    PackedRadiance packed;
    packed.elements.assign((layout.elements + 3) / 4 * 4, 0);
    if (field.empty()) return packed;
    findCodes(field, packed);
    const auto directions = static_cast<std::size_t>(2 * field.lines);
    parallelFor(layout.records.size(), 16, [&](std::size_t i) {
        const auto direction = static_cast<std::uint32_t>(i % directions);
        fill(field, field.rowsOf(direction, charts[i / directions]), layout.records[i],
             layout.coarseness, packed);
    });
    return packed;
}

}  // namespace vlf
