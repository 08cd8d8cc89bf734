// Layout: openexr.com, "OpenEXR File Layout". Numbers are little-endian; a header is a list of
// attributes (name, type, size of value, value) that ends with an empty name, and in a file of
// several parts an empty header ends the list of headers.

#include "vlf/image/exr_header.h"

#include "vlf/base/error.h"
#include "vlf/image/image_size.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace vlf {

namespace {

using Bytes = std::span<const std::uint8_t>;

/// Types whose values OpenEXR reads without regard to the size that is given for them.
constexpr std::pair<std::string_view, std::size_t> kFixedSizes[] = {
    {"box2f", 16}, {"box2i", 16}, {"chromaticities", 32}, {"compression", 1}, {"double", 8},
    {"float", 4},  {"int", 4},    {"lineOrder", 1},       {"tiledesc", 9},    {"v2f", 8},
    {"v2i", 8},
};

class HeaderReader {
  public:
    HeaderReader(Bytes bytes, const std::string& name)
        : rest_(bytes), fileBytes_(bytes.size()), name_(name) {}

    Bytes take(std::size_t count) {
        if (count > rest_.size()) fail();
        const Bytes taken = rest_.first(count);
        rest_ = rest_.subspan(count);
        return taken;
    }

    std::string_view takeString() {
        const auto end = std::find(rest_.begin(), rest_.end(), 0);
        const auto length = static_cast<std::size_t>(end - rest_.begin());
        const Bytes string = take(length + 1);
        return {reinterpret_cast<const char*>(string.data()), length};
    }

    std::int32_t takeInt() {
        const Bytes b = take(4);
        return static_cast<std::int32_t>(std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 |
                                         std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24);
    }

    bool atEnd() const { return rest_.empty(); }

    /// False if the header has no attribute.
    bool checkHeader() {
        bool any = false;
        for (std::string_view key; !(key = takeString()).empty(); any = true) checkAttribute(key);
        return any;
    }

  private:
    void checkAttribute(std::string_view key) {
        const std::string_view type = takeString();
        const std::int32_t size = takeInt();
        if (size < 0) fail();
        const Bytes value = take(static_cast<std::size_t>(size));
        for (const auto& [fixedType, fixedSize] : kFixedSizes)
            if (type == fixedType && value.size() != fixedSize) fail();
        if (type == "chlist") checkChannels(value);
        if (type == "tiledesc") checkTile(value);
        if (key == "dataWindow" && type == "box2i") checkWindow(value);
    }

    void checkChannels(Bytes value) {
        constexpr std::size_t kChannelBytes = 16;
        HeaderReader channels(value, name_);
        while (!channels.takeString().empty()) channels.take(kChannelBytes);
        if (!channels.atEnd()) fail();
    }

    void checkWindow(Bytes value) {
        HeaderReader window(value, name_);
        const std::int64_t left = window.takeInt(), top = window.takeInt();
        const std::int64_t right = window.takeInt(), bottom = window.takeInt();
        constexpr std::int64_t kFarthest = 1
                                           << 24;  // from the origin; addresses are counted from it
        if (std::max({std::abs(left), std::abs(top), std::abs(right), std::abs(bottom)}) >
            kFarthest)
            fail();
        requireImageSize(right - left + 1, bottom - top + 1, fileBytes_, name_);
    }

    void checkTile(Bytes value) {
        HeaderReader tile(value, name_);
        const std::int64_t width = tile.takeInt(), height = tile.takeInt();
        requireImageSize(width, height, fileBytes_, name_);
    }

    [[noreturn]] void fail() const {
        throw InputError(name_ + ": damaged EXR file: the header is not valid");
    }

    Bytes rest_;
    std::size_t fileBytes_;
    const std::string& name_;
};

}  // namespace

void checkExrHeader(Bytes bytes, const std::string& name) {
    constexpr std::int32_t kDeep = 0x800, kMultiPart = 0x1000;
    HeaderReader reader(bytes, name);
    reader.take(4);  // magic number
    const std::int32_t version = reader.takeInt();
    if (version & kDeep)
        throw InputError(name +
                         ": EXR file of deep data, of which no picture is read; flatten it first");
    const bool multiPart = (version & kMultiPart) != 0;
    while (reader.checkHeader() && multiPart) continue;
}

}  // namespace vlf
