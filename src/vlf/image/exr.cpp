#include "vlf/image/exr.h"

#include "vlf/base/error.h"
#include "vlf/image/exr_header.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

namespace vlf {

namespace {

using Bytes = std::span<const std::uint8_t>;

class MemoryReader : public Imf::IStream {
  public:
    MemoryReader(Bytes bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}

    bool read(char buffer[], int count) override {
        if (count < 0 || static_cast<std::size_t>(count) > bytes_.size() - position_)
            throw std::runtime_error("the file ends early");
        std::memcpy(buffer, bytes_.data() + position_, static_cast<std::size_t>(count));
        position_ += static_cast<std::size_t>(count);
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override {
        position_ = std::min<std::uint64_t>(position, bytes_.size());
    }

  private:
    Bytes bytes_;
    std::size_t position_ = 0;
};

class MemoryWriter : public Imf::OStream {
  public:
    MemoryWriter() : OStream("image") {}

    void write(const char buffer[], int count) override {
        const std::size_t end = position_ + static_cast<std::size_t>(count);
        if (end > bytes.size()) bytes.resize(end);
        std::memcpy(bytes.data() + position_, buffer, static_cast<std::size_t>(count));
        position_ = end;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }

    std::vector<std::uint8_t> bytes;

  private:
    std::size_t position_ = 0;
};

constexpr const char* kRgb[3] = {"R", "G", "B"};

/// One channel of the image; pixel (0, 0) of the image is at the corner of the data window. OpenEXR
/// wants the address of the window's origin, which need not be one of the image's.
Imf::Slice sliceOf(const Image& image, int channel, const Imath::V2i& corner) {
    const std::ptrdiff_t first = corner.x + std::ptrdiff_t{corner.y} * image.width;
    const auto address = reinterpret_cast<std::uintptr_t>(image.pixels.data()) -
                         static_cast<std::uintptr_t>(first) * sizeof(Vec3) +
                         static_cast<std::uintptr_t>(channel) * sizeof(float);
    return Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(address), sizeof(Vec3),
                      sizeof(Vec3) * static_cast<std::size_t>(image.width), 1, 1, 0.0);
}

std::string channelNames(const Imf::ChannelList& channels) {
    std::string names;
    for (auto c = channels.begin(); c != channels.end(); ++c)
        names += (names.empty() ? "" : ", ") + std::string(c.name());
    return names;
}

Image readPixels(Imf::InputFile& file, const std::string& name) {
    const Imf::ChannelList& channels = file.header().channels();
    const bool color = std::any_of(std::begin(kRgb), std::end(kRgb),
                                   [&](const char* c) { return channels.findChannel(c); });
    if (!color && !channels.findChannel("Y"))
        throw InputError(name + ": no channel R, G, B or Y; it has " + channelNames(channels));

    const Imath::Box2i window = file.header().dataWindow();
    Image image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
    Imf::FrameBuffer target;
    for (int c = 0; c < 3; ++c)
        if (color) target.insert(kRgb[c], sliceOf(image, c, window.min));
    if (!color) target.insert("Y", sliceOf(image, 0, window.min));
    file.setFrameBuffer(target);
    file.readPixels(window.min.y, window.max.y);
    if (!color)
        for (Vec3& p : image.pixels) p = Vec3(p.x);
    return image;
}

}  // namespace

bool isExr(Bytes bytes) {
    constexpr std::uint8_t kMagic[] = {0x76, 0x2f, 0x31, 0x01};
    return bytes.size() >= 4 && std::equal(std::begin(kMagic), std::end(kMagic), bytes.begin());
}

Image decodeExr(Bytes bytes, const std::string& name) {
    checkExrHeader(bytes, name);
    try {
        MemoryReader stream(bytes, name);
        Imf::InputFile file(stream);
        return readPixels(file, name);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {
        throw InputError(name + ": damaged EXR file: " + e.what());
    }
}

std::vector<std::uint8_t> encodeExr(const Image& image, const ImageAttributes& attributes) {
    if (image.pixels.empty()) throw InputError("an image without pixels cannot be written as EXR");
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer source;
    for (int c = 0; c < 3; ++c) {
        header.channels().insert(kRgb[c], Imf::Channel(Imf::FLOAT));
        source.insert(kRgb[c], sliceOf(image, c, {0, 0}));
    }
    for (const auto& [key, value] : attributes) header.insert(key, Imf::StringAttribute(value));
    MemoryWriter stream;
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(source);
        file.writePixels(image.height);
    }  // the table of offsets is written here
    return std::move(stream.bytes);
}

}  // namespace vlf
