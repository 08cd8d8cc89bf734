#include "vlf/render/gl/packed_radiance.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/render/gl/shaders/shared.h"

#include <algorithm>
#include <limits>

namespace vlf {

namespace {

constexpr float kShearUnit = 1 / 256.0f, kMostShear = 15;  // exact in a float, times any row
constexpr int kSums = (1 << shared::kSumBits) - 1;
constexpr int kReds = (1 << shared::kRedBits) - 1, kBlues = (1 << shared::kBlueBits) - 1;
constexpr int kDistances = (1 << shared::kDistanceBits) - 1;

// What is darker than this beside the brightest cannot be seen in one picture with it.
constexpr float kMostOctaves = 16;
constexpr float kDarkest = 1e-20f;  // black, as a sum of red, green and blue

/// The cells of a row that hold something, first and last.
struct RowExtent {
    int y, first, last;
};

std::vector<RowExtent> extents(const RadianceField& field, std::span<const TileRow> rows) {
    std::vector<RowExtent> result;
    for (const TileRow& row : rows)
        for (int y = row.tileY * field.tileSize; y < (row.tileY + 1) * field.tileSize; ++y) {
            RowExtent extent{y, std::numeric_limits<int>::max(), -1};
            for (int x = row.tileX * field.tileSize;
                 x < (row.tileX + row.tilesWide) * field.tileSize; ++x) {
                const RadianceElement* e = field.element(rows, x, y);
                if (!e || e->distance == 0) continue;
                extent.first = std::min(extent.first, x);
                extent.last = x;
            }
            if (extent.last >= 0) result.push_back(extent);
        }
    return result;
}

int shift(float shear, int row) {
    return static_cast<int>(std::floor(shear * static_cast<float>(row)));
}

/// First and last column of the rectangle with a shear.
std::pair<int, int> columns(const std::vector<RowExtent>& rows, float shear) {
    int first = std::numeric_limits<int>::max(), last = std::numeric_limits<int>::min();
    for (const RowExtent& row : rows) {
        const int offset = shift(shear, row.y - rows.front().y);
        first = std::min(first, row.first - offset);
        last = std::max(last, row.last - offset);
    }
    return {first, last};
}

/// The shear of the narrowest rectangle: its width is convex in the shear but for rounding.
float bestShear(const std::vector<RowExtent>& rows) {
    const auto width = [&](int s) {
        const auto [first, last] = columns(rows, static_cast<float>(s) * kShearUnit);
        return last - first;
    };
    int lower = static_cast<int>(-kMostShear / kShearUnit), upper = -lower;
    while (upper - lower > 8) {
        const int a = lower + (upper - lower) / 3, b = upper - (upper - lower) / 3;
        (width(a) < width(b) ? upper : lower) = width(a) < width(b) ? b : a;
    }
    int best = 0;
    for (int s = lower; s <= upper; ++s)
        if (width(s) < width(best)) best = s;
    return static_cast<float>(best) * kShearUnit;
}

RadianceRecord layOut(const RadianceField& field, std::uint32_t direction, std::uint32_t chart) {
    const auto rows = extents(field, field.rowsOf(direction, chart));
    if (rows.empty()) return {};
    RadianceRecord record;
    record.shear = bestShear(rows);
    const auto [first, last] = columns(rows, record.shear);
    record.x = static_cast<std::uint16_t>(first + 0x8000);
    record.y = static_cast<std::uint16_t>(rows.front().y);
    record.width = static_cast<std::uint16_t>(last - first + 1);
    record.height = static_cast<std::uint16_t>(rows.back().y - rows.front().y + 1);
    return record;
}

float sumOf(const Vec3& rgb) {
    return rgb.x + rgb.y + rgb.z;
}

struct Range {
    float lower = std::numeric_limits<float>::max(), upper = std::numeric_limits<float>::lowest();

    void add(float v) {
        lower = std::min(lower, v);
        upper = std::max(upper, v);
    }
    /// Codes from 0 to `largest` over the range.
    LinearCode code(int largest) const {
        if (lower > upper) return {0, 1};
        return {lower, std::max((upper - lower) / static_cast<float>(largest), 1e-6f)};
    }
};

void findCodes(const RadianceField& field, PackedRadiance& packed) {
    std::uint16_t longest = 1;
    Range logSum, red, blue;
    for (const RadianceElement& e : field.elements) {
        if (e.distance == 0) continue;
        longest = std::max(longest, e.distance);
        const Vec3 rgb = unpackRgb9e5(e.rgb9e5());
        const float sum = sumOf(rgb);
        logSum.add(std::log2(std::max(sum, kDarkest)));
        if (sum <= 0) continue;
        red.add(rgb.x / sum);
        blue.add(rgb.z / sum);
    }
    logSum.lower = std::max(logSum.lower, logSum.upper - kMostOctaves);
    packed.longestDistance = field.maxDistance * static_cast<float>(longest) / 65535;
    packed.logSum = logSum.code(kSums);
    packed.red = red.code(kReds);
    packed.blue = blue.code(kBlues);
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
std::uint32_t pack(const RadianceElement& e, int x, int y, const RadianceField& field,
                   const PackedRadiance& packed) {
    const float metres = field.maxDistance * static_cast<float>(e.distance) / 65535;
    const std::uint32_t distance =
        std::max(1u, encode(metres, {0, packed.longestDistance / kDistances}, kDistances));
    const Vec3 rgb = unpackRgb9e5(e.rgb9e5());
    const float sum = std::max(sumOf(rgb), kDarkest);
    // Each part its own pattern, so that they do not err all in the same cells.
    const std::uint32_t logSum = encode(std::log2(sum), packed.logSum, kSums, thresholdOf(x, y));
    const std::uint32_t red = encode(rgb.x / sum, packed.red, kReds, thresholdOf(x + 1, y));
    const std::uint32_t blue = encode(rgb.z / sum, packed.blue, kBlues, thresholdOf(x, y + 1));
    using namespace shared;
    return distance | logSum << kDistanceBits | red << (kDistanceBits + kSumBits) |
           blue << (kDistanceBits + kSumBits + kRedBits);
}

void fill(const RadianceField& field, std::uint32_t direction, std::uint32_t chart,
          const RadianceRecord& record, PackedRadiance& packed) {
    const auto rows = field.rowsOf(direction, chart);
    for (int y = 0; y < record.height; ++y)
        for (int x = 0; x < record.width; ++x) {
            const int column = record.x - 0x8000 + shift(record.shear, y) + x;
            const RadianceElement* e = field.element(rows, column, record.y + y);
            if (!e || e->distance == 0) continue;
            const std::size_t i =
                std::size_t{record.firstElement} + static_cast<std::size_t>(y) * record.width + x;
            packed.elements[i] = pack(*e, column, record.y + y, field, packed);
        }
}

}  // namespace

PackedRadiance packRadiance(const RadianceField& field, const std::vector<std::uint32_t>& charts) {
    PackedRadiance packed;
    if (field.empty()) return packed;
    const auto directions = static_cast<std::size_t>(2 * field.lines);
    packed.records.resize(charts.size() * directions);
    const auto chartOf = [&](std::size_t i) { return charts[i / directions]; };
    const auto directionOf = [&](std::size_t i) {
        return static_cast<std::uint32_t>(i % directions);
    };
    parallelFor(packed.records.size(), 16, [&](std::size_t i) {
        packed.records[i] = layOut(field, directionOf(i), chartOf(i));
    });
    std::uint64_t next = 0;
    for (RadianceRecord& record : packed.records) {
        record.firstElement = static_cast<std::uint32_t>(next);
        next += std::uint64_t{record.width} * record.height;
    }
    if (next > std::numeric_limits<std::uint32_t>::max())
        throw InputError(
            "the radiance field holds too many elements to be shown: bake it with "
            "fewer --radiance-cells");
    packed.elements.assign(next, 0);
    findCodes(field, packed);
    parallelFor(packed.records.size(), 16, [&](std::size_t i) {
        fill(field, directionOf(i), chartOf(i), packed.records[i], packed);
    });
    return packed;
}

}  // namespace vlf
