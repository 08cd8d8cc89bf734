#include "vlf/io/radiance_codec.h"

#include "vlf/io/grid_codec.h"

#include <algorithm>
#include <array>
#include <bit>

namespace vlf {

namespace {

constexpr std::uint64_t kGroupElements = 65536;

/// Distance, green, red - green, blue - green: the colour channels as bfloat16, whose bits are
/// nearly a logarithm, so that differences of channels do not change with brightness.
using Code = std::array<std::uint16_t, 4>;

constexpr std::uint16_t kChroma = 0x8000;  ///< keeps differences of channels positive
constexpr int kDistanceShift = 4;
constexpr std::uint32_t kMaxDistance = 0xffff >> kDistanceShift;

/// Upper half of a float, rounded to nearest, ties to even.
std::uint16_t toBfloat16(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return static_cast<std::uint16_t>((bits + 0x7fff + (bits >> 16 & 1)) >> 16);
}

/// Three bfloat16 as RGB9E5, whose mantissas have a bit more than the largest of them needs.
std::uint32_t toRgb9e5(std::uint16_t red, std::uint16_t green, std::uint16_t blue) {
    constexpr std::uint32_t kLeastExponent = 111;  // of 2⁻¹⁶, with the bias of a float
    constexpr std::uint16_t kLargest = 0x477f;     // 65280
    const auto bounded = [&](std::uint16_t code) -> std::uint32_t {
        return std::min<std::uint16_t>(code & 0x7fff, kLargest);
    };
    const std::uint32_t r = bounded(red), g = bounded(green), b = bounded(blue);
    const std::uint32_t exponent = std::max(std::max(r, std::max(g, b)) >> 7, kLeastExponent);
    // 2 to the power of 24 less the shared exponent, as the bits of a float.
    const auto scale = std::bit_cast<float>((127 + 24 + kLeastExponent - exponent) << 23);
    const auto mantissa = [&](std::uint32_t code) {
        const auto scaled = std::bit_cast<float>(code << 16) * scale;
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(scaled + 0.5f));
    };
    return mantissa(r) | mantissa(g) << 9 | mantissa(b) << 18 | (exponent - kLeastExponent) << 27;
}

Code toCode(const Vec3& radiance, std::uint16_t distance) {
    const std::uint16_t r = toBfloat16(radiance.x), g = toBfloat16(radiance.y),
                        b = toBfloat16(radiance.z);
    const std::uint32_t d = (distance + (1u << (kDistanceShift - 1))) >> kDistanceShift;
    return {static_cast<std::uint16_t>(std::clamp(d, 1u, kMaxDistance)), g,
            static_cast<std::uint16_t>(r - g + kChroma),
            static_cast<std::uint16_t>(b - g + kChroma)};
}

RadianceElement fromCode(const Code& code) {
    const auto channel = [&](int i) {
        return static_cast<std::uint16_t>(code[1] + code[i] - kChroma);
    };
    return {toRgb9e5(channel(2), code[1], channel(3)),
            static_cast<std::uint16_t>(code[0] << kDistanceShift)};
}

/// The code of an element that a reader will turn into an element of the same code: rounding the
/// brightest channel up may raise the shared exponent, which rounds the others once more.
Code stableCode(const RadianceElement& element) {
    const RadianceElement once = fromCode(toCode(unpackRgb9e5(element.rgb9e5()), element.distance));
    return toCode(unpackRgb9e5(once.rgb9e5()), element.distance);
}

/// Four lanes of a vector register: an extension of GCC and Clang, for any processor.
using Lanes [[gnu::vector_size(8)]] = std::uint16_t;
using SignedLanes [[gnu::vector_size(8)]] = std::int16_t;

/// Lane by lane the middle one of low <= high and value.
SignedLanes clampLanes(SignedLanes value, SignedLanes low, SignedLanes high) {
    const SignedLanes raised = value < low ? low : value;
    return raised > high ? high : raised;
}

/// left + up - upperLeft for distances, which is exact on planes; predictMedian for colours, which
/// is the same after clamping upperLeft to what left and up span.
Code predictCode(const Code& left, const Code& up, const Code& upperLeft) {
    constexpr SignedLanes kColours = {0, -1, -1, -1};
    constexpr std::uint16_t kSign = 0x8000;  // processors compare signed lanes faster
    const Lanes l = std::bit_cast<Lanes>(left) ^ kSign, u = std::bit_cast<Lanes>(up) ^ kSign;
    const auto corner = std::bit_cast<SignedLanes>(std::bit_cast<Lanes>(upperLeft) ^ kSign);
    const auto a = std::bit_cast<SignedLanes>(l), b = std::bit_cast<SignedLanes>(u);
    const SignedLanes clamped = clampLanes(corner, a < b ? a : b, a < b ? b : a);
    const auto subtracted = std::bit_cast<Lanes>((clamped & kColours) | (corner & ~kColours));
    return std::bit_cast<Code>((l + u - subtracted) ^ kSign);
}

/// The codes of one tile with the last column, row and corner of its left, upper and upper left
/// neighbours around it.
class BorderedTile {
  public:
    explicit BorderedTile(int size)
        : size_(size), stride_(size + 1), codes_(static_cast<std::size_t>(stride_) * stride_) {}

    Code& at(int x, int y) { return codes_[static_cast<std::size_t>(y + 1) * stride_ + x + 1]; }

    /// Neighbours that are absent (nullptr) continue those present; if all are, the border is 0.
    void setBorder(const Code* left, const Code* up, const Code* upperLeft) {
        const int last = size_ - 1;
        const auto cell = [&](const Code* tile, int x, int y) { return tile[y * size_ + x]; };
        at(-1, -1) = left && up && upperLeft ? cell(upperLeft, last, last)
                     : up                    ? cell(up, 0, last)
                     : left                  ? cell(left, last, 0)
                                             : Code{};
        for (int i = 0; i < size_; ++i) {
            at(i, -1) = up ? cell(up, i, last) : at(-1, -1);
            at(-1, i) = left ? cell(left, last, i) : at(-1, -1);
        }
    }

    Code predict(int x, int y) { return predictCode(at(x - 1, y), at(x, y - 1), at(x - 1, y - 1)); }

  private:
    int size_, stride_;
    std::vector<Code> codes_;
};

/// One bit per element, lowest first: whether it is its chart's.
bool bit(std::span<const std::uint8_t> mask, std::size_t i) {
    return mask[i / 8] >> i % 8 & 1;
}

std::size_t countBits(std::span<const std::uint8_t> mask) {
    std::size_t count = 0;
    for (const std::uint8_t byte : mask) count += static_cast<std::size_t>(std::popcount(byte));
    return count;
}

Code difference(const Code& code, const Code& prediction) {
    Code residual;
    for (int c = 0; c < 4; ++c)
        residual[c] = zigzag<std::uint16_t>(static_cast<std::uint16_t>(code[c] - prediction[c]));
    return residual;
}

/// High bytes of the four members, one member after the other, then the low bytes.
void appendPlanes(std::vector<std::uint8_t>& bytes, const std::vector<Code>& residuals) {
    for (const int shift : {8, 0})
        for (int c = 0; c < 4; ++c)
            for (const Code& residual : residuals)
                bytes.push_back(static_cast<std::uint8_t>(residual[c] >> shift));
}

/// The differences of which appendPlanes() wrote the residuals, one member after the other.
std::vector<std::uint16_t> differencesOf(std::span<const std::uint8_t> planes) {
    std::vector<std::uint16_t> differences(planes.size() / 2);
    for (std::size_t i = 0; i < differences.size(); ++i)
        differences[i] =
            unzigzag(static_cast<std::uint16_t>(planes[i] << 8 | planes[differences.size() + i]));
    return differences;
}

}  // namespace

/// Where a tile lies, and the steps back in the order of tiles to its neighbours; 0: none.
struct TileGroups::Tile {
    std::uint64_t firstElement = 0;
    std::uint64_t toLeft = 0, toUp = 0, toUpperLeft = 0;
};

TileGroups::TileGroups(const RadianceField& field)
    : field_(field),
      tileElements_(field.tileElements()),
      groupTiles_(kGroupElements / std::clamp<std::uint64_t>(tileElements_, 1, kGroupElements)),
      firstTile_{0} {
    firstTile_.reserve(field.rows.size() + 1);
    for (const TileRow& row : field.rows) firstTile_.push_back(firstTile_.back() + row.tilesWide);
}

std::uint64_t TileGroups::groupElements(std::uint64_t g) const {
    return std::min(groupTiles_, tileCount() - g * groupTiles_) * tileElements_;
}

std::uint64_t TileGroups::stepsUp(std::size_t r, int tileX) const {
    if (r == 0) return 0;
    const TileRow &row = field_.rows[r], &up = field_.rows[r - 1];
    if (up.chart != row.chart || up.tileY + 1 != row.tileY) return 0;
    const int column = tileX - up.tileX;
    if (column < 0 || column >= up.tilesWide) return 0;
    return up.tilesWide - static_cast<std::uint64_t>(column);
}

TileGroups::Tile TileGroups::tileAt(std::uint64_t index) const {
    const auto after = std::upper_bound(firstTile_.begin(), firstTile_.end(), index);
    const auto r = static_cast<std::size_t>(after - firstTile_.begin()) - 1;
    const TileRow& row = field_.rows[r];
    const std::uint64_t column = index - firstTile_[r];
    const int x = row.tileX + static_cast<int>(column);
    const std::uint64_t up = stepsUp(r, x), upperLeft = stepsUp(r, x - 1);
    return {row.firstElement + column * tileElements_, column > 0 ? 1u : 0u,
            up > 0 ? up + column : 0, upperLeft > 0 ? upperLeft + column : 0};
}

/// Calls visit(i, prediction), which returns the code of the group's element i, in order.
template <class Visit>
void TileGroups::visitPredicted(std::uint64_t g, const Visit& visit) const {
    const int m = field_.tileSize;
    std::vector<Code> codes(groupElements(g));
    BorderedTile tile(m);
    for (std::uint64_t t = 0, i = 0; i < codes.size(); ++t) {
        const Tile place = tileAt(g * groupTiles_ + t);
        const auto neighbour = [&](std::uint64_t back) -> const Code* {
            return back > 0 && back <= t ? &codes[(t - back) * tileElements_] : nullptr;
        };
        tile.setBorder(neighbour(place.toLeft), neighbour(place.toUp),
                       neighbour(place.toUpperLeft));
        for (int y = 0; y < m; ++y)
            for (int x = 0; x < m; ++x, ++i)
                codes[i] = tile.at(x, y) = visit(i, tile.predict(x, y));
    }
}

std::vector<RadianceElement> TileGroups::gather(std::uint64_t g) const {
    std::vector<RadianceElement> elements;
    elements.reserve(groupElements(g));
    for (std::uint64_t t = g * groupTiles_; elements.size() < groupElements(g); ++t) {
        const RadianceElement* tile = field_.elements.data() + tileAt(t).firstElement;
        elements.insert(elements.end(), tile, tile + tileElements_);
    }
    if (elements.empty()) return elements;
    field_.release(tileAt(g * groupTiles_).firstElement, elements.size());
    return elements;
}

std::vector<std::uint8_t> TileGroups::encode(std::uint64_t g) const {
    const std::vector<RadianceElement> elements = gather(g);
    std::vector<std::uint8_t> bytes((elements.size() + 7) / 8);
    std::vector<Code> residuals;
    visitPredicted(g, [&](std::uint64_t i, const Code& prediction) {
        if (elements[i].distance == 0) return prediction;
        bytes[i / 8] |= static_cast<std::uint8_t>(1 << i % 8);
        const Code code = stableCode(elements[i]);
        residuals.push_back(difference(code, prediction));
        return code;
    });
    appendPlanes(bytes, residuals);
    return bytes;
}

bool TileGroups::decode(std::uint64_t g, std::span<const std::uint8_t> bytes,
                        std::span<RadianceElement> all) const {
    const auto elements = all.subspan(g * groupTiles_ * tileElements_, groupElements(g));
    const std::size_t maskBytes = (elements.size() + 7) / 8;
    if (bytes.size() < maskBytes) return false;
    const auto mask = bytes.first(maskBytes), planes = bytes.subspan(maskBytes);
    if (planes.size() != countBits(mask) * sizeof(Code)) return false;
    const std::vector<std::uint16_t> differences = differencesOf(planes);
    const std::size_t filled = differences.size() / 4;
    std::size_t next = 0;
    visitPredicted(g, [&](std::uint64_t i, const Code& prediction) {
        if (!bit(mask, i)) return prediction;
        Code code;
        for (std::size_t c = 0; c < 4; ++c)
            code[c] = static_cast<std::uint16_t>(prediction[c] + differences[c * filled + next]);
        ++next;
        elements[i] = fromCode(code);
        return code;
    });
    return true;
}

}  // namespace vlf
