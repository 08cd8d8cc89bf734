#include "vlf/render/gl/packed_radiance.h"

#include "vlf/base/parallel.h"
#include "vlf/render/gl/shaders/shared.h"

#include <algorithm>
#include <array>
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
constexpr float kBlackest = -64;  // black, as the log2 of a sum of red, green and blue

/// Of a radiance: log2 of the sum of red, green and blue, and shares of red and blue in it.
struct Color {
    float logSum = kBlackest, red = 0, blue = 0;
};

/// Colours of shared-exponent radiance. Its mantissas have small integers for a sum.
class ColorTable {
  public:
    ColorTable() {
        for (std::size_t i = 1; i < kSize; ++i) {
            log2_[i] = std::log2(static_cast<float>(i));
            inverse_[i] = 1 / static_cast<float>(i);
        }
    }

    Color colorOf(std::uint32_t rgb9e5) const {
        const std::uint32_t red = rgb9e5 & 511, green = rgb9e5 >> 9 & 511,
                            blue = rgb9e5 >> 18 & 511;
        const std::uint32_t sum = red + green + blue;
        if (sum == 0) return {};
        const float exponent = static_cast<float>(rgb9e5 >> 27) - 24;
        return {log2_[sum] + exponent, static_cast<float>(red) * inverse_[sum],
                static_cast<float>(blue) * inverse_[sum]};
    }

  private:
    static constexpr std::size_t kSize = 3 * 511 + 1;
    std::array<float, kSize> log2_{}, inverse_{};
};

const ColorTable& colorTable() {
    static const ColorTable table;
    return table;
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

    void add(const RadianceElement& e, const ColorTable& table) {
        if (e.distance == 0) return;
        longest = std::max(longest, e.distance);
        const Color color = table.colorOf(e.rgb9e5());
        logSum.add(color.logSum);
        if (color.logSum == kBlackest) return;
        red.add(color.red);
        blue.add(color.blue);
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
    const ColorTable& table = colorTable();
    parallelFor(blocks.size(), [&](std::size_t b) {
        const std::size_t end = std::min((b + 1) * kBlock, field.elements.size());
        Ranges block;
        for (std::size_t i = b * kBlock; i < end; ++i) block.add(field.elements[i], table);
        blocks[b] = block;
    });
    Ranges all;
    for (const Ranges& block : blocks) all.add(block);
    all.logSum.lower = std::max(all.logSum.lower, all.logSum.upper - kMostOctaves);
    packed.longestDistance = field.maxDistance * static_cast<float>(all.longest) / 65535;
    packed.logSum = all.logSum.code(kSums);
    packed.red = all.red.code(kReds);
    packed.blue = all.blue.code(kBlues);
}

/// What k x k cells of the field hold, as one: the median distance and the mean radiance. Distance
/// 0 where no cell holds anything.
RadianceElement meanOf(const RadianceField& field, std::span<const TileRow> rows, int x, int y,
                       int k) {
    std::vector<std::uint16_t> distances;
    Vec3 sum(0);
    for (int i = 0; i < k * k; ++i) {
        const RadianceElement* e = field.element(rows, k * x + i % k, k * y + i / k);
        if (!e || e->distance == 0) continue;
        distances.push_back(e->distance);
        sum += unpackRgb9e5(e->rgb9e5());
    }
    if (distances.empty()) return {};
    const auto median = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), median, distances.end());
    return {packRgb9e5(sum / static_cast<float>(distances.size())), *median};
}

/// Ordered dither: the mean of four neighbouring cells, which is what a lookup takes, is finer than
/// the codes.
float thresholdOf(int x, int y) {
    constexpr float kThresholds[2][2] = {{0.125f, 0.625f}, {0.875f, 0.375f}};
    return kThresholds[y & 1][x & 1];
}

/// Values to codes from 0 to `largest`.
class Encoder {
  public:
    Encoder(const LinearCode& code, int largest)
        : first_(code.first), perStep_(1 / code.step), largest_(static_cast<float>(largest)) {}

    /// Rounds up from `threshold` of the way to the next code.
    std::uint32_t operator()(float v, float threshold = 0.5f) const {
        const float c = (v - first_) * perStep_ + 1 - threshold;
        return static_cast<std::uint32_t>(std::clamp(c, 0.0f, largest_));
    }

  private:
    float first_, perStep_, largest_;
};

class Packer {
  public:
    Packer(const RadianceField& field, PackedRadiance& packed)
        : field_(field),
          packed_(packed),
          distance_({0, packed.longestDistance / kDistances}, kDistances),
          logSum_(packed.logSum, kSums),
          red_(packed.red, kReds),
          blue_(packed.blue, kBlues) {}

    /// Writes the elements of a chart in a direction.
    void fill(std::span<const TileRow> rows, const RadianceRecord& record, int coarseness) const {
        for (int row = 0; row < record.height; ++row) {
            std::uint32_t* elements =
                &packed_
                     .elements[record.firstElement + static_cast<std::size_t>(row) * record.width];
            const int first = record.firstColumn(row), y = record.y + row;
            if (coarseness == 1)
                fillRow(rows, first, first + record.width, y, elements);
            else
                for (int i = 0; i < record.width; ++i)
                    elements[i] =
                        pack(meanOf(field_, rows, first + i, y, coarseness), first + i, y);
        }
    }

  private:
    /// Cells first ... end of row y, as far as the field's tiles reach.
    void fillRow(std::span<const TileRow> rows, int first, int end, int y,
                 std::uint32_t* elements) const {
        const int m = field_.tileSize;
        const TileRow& tiles = rows[static_cast<std::size_t>(y / m - rows.front().tileY)];
        const int begin = std::max(first, tiles.tileX * m);
        end = std::min(end, (tiles.tileX + tiles.tilesWide) * m);
        for (int x = begin; x < end;) {
            const auto tile = static_cast<std::uint64_t>(x / m - tiles.tileX);
            const RadianceElement* e =
                &field_.elements[tiles.firstElement + tile * field_.tileElements() +
                                 static_cast<std::uint64_t>(y % m * m)];
            for (const int tileEnd = std::min(end, (x / m + 1) * m); x < tileEnd; ++x)
                elements[x - first] = pack(e[x % m], x, y);
        }
    }

    /// What the subfield's cell (x, y) holds.
    std::uint32_t pack(const RadianceElement& e, int x, int y) const {
        if (e.distance == 0) return 0;
        const float metres = field_.maxDistance / 65535 * static_cast<float>(e.distance);
        const Color color = colorTable_.colorOf(e.rgb9e5());
        // Each part has its own pattern, so that they do not err all in the same cells.
        using namespace shared;
        return std::max(1u, distance_(metres)) |
               logSum_(color.logSum, thresholdOf(x, y)) << kDistanceBits |
               red_(color.red, thresholdOf(x + 1, y)) << (kDistanceBits + kSumBits) |
               blue_(color.blue, thresholdOf(x, y + 1)) << (kDistanceBits + kSumBits + kRedBits);
    }

    const RadianceField& field_;
    PackedRadiance& packed_;
    const ColorTable& colorTable_ = colorTable();
    Encoder distance_, logSum_, red_, blue_;
};

}  // namespace

PackedRadiance packRadiance(const RadianceField& field, const std::vector<std::uint32_t>& charts,
                            const RadianceLayout& layout) {
    PackedRadiance packed;
    packed.elements.assign((layout.elements + 3) / 4 * 4, 0);
    if (field.empty()) return packed;
    findCodes(field, packed);
    const Packer packer(field, packed);
    const auto directions = static_cast<std::size_t>(2 * field.lines);
    parallelFor(layout.records.size(), 16, [&](std::size_t i) {
        const auto direction = static_cast<std::uint32_t>(i % directions);
        packer.fill(field.rowsOf(direction, charts[i / directions]), layout.records[i],
                    layout.coarseness);
    });
    return packed;
}

}  // namespace vlf
