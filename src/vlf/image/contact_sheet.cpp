#include "vlf/image/contact_sheet.h"

#include "vlf/base/error.h"
#include "vlf/image/image_io.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vlf {

namespace {

/// Source pixels [first, last] under [begin, end), the first and last counted in part.
struct Span {
    int first, last;
    float begin, end;

    Span(int i, int size, int sourceSize)
        : begin(static_cast<float>(i) * sourceSize / size),
          end(static_cast<float>(i + 1) * sourceSize / size) {
        first = std::min(static_cast<int>(begin), sourceSize - 1);
        last = std::clamp(static_cast<int>(std::ceil(end)) - 1, first, sourceSize - 1);
    }
    float coverage(int k) const {
        return std::min(end, k + 1.0f) - std::max(begin, static_cast<float>(k));
    }
};

void paste(const Image& picture, int x, int y, Image& sheet) {
    for (int row = 0; row < picture.height; ++row)
        std::copy_n(&picture.at(0, row), picture.width, &sheet.at(x, y + row));
}

Image fitted(const Image& picture, int width, int height) {
    const float scale = std::min(static_cast<float>(width) / picture.width,
                                 static_cast<float>(height) / picture.height);
    const auto fit = [&](int size, int limit) {
        return std::clamp(static_cast<int>(std::lround(scale * size)), 1, limit);
    };
    return resized(picture, fit(picture.width, width), fit(picture.height, height));
}

int cellHeight(const Image& first, int cellWidth) {
    const double height = static_cast<double>(cellWidth) * first.height / first.width;
    return std::max(1, static_cast<int>(std::lround(std::min(height, 1e6))));
}

}  // namespace

Image resized(const Image& image, int width, int height) {
    Image result(width, height);
    for (int y = 0; y < height; ++y) {
        const Span rows(y, height, image.height);
        for (int x = 0; x < width; ++x) {
            const Span columns(x, width, image.width);
            Vec3 sum(0);
            float area = 0;
            for (int j = rows.first; j <= rows.last; ++j)
                for (int i = columns.first; i <= columns.last; ++i) {
                    const float covered = rows.coverage(j) * columns.coverage(i);
                    sum += covered * image.at(i, j);
                    area += covered;
                }
            result.at(x, y) = sum / area;
        }
    }
    return result;
}

Image contactSheet(std::span<const Image> pictures, const ContactSheetLayout& layout) {
    if (pictures.empty()) throw InputError("a contact sheet needs at least one picture");
    for (const Image& p : pictures)
        if (p.pixels.empty()) throw InputError("a picture of the contact sheet has no pixels");

    const int count = static_cast<int>(pictures.size());
    const int columns = std::clamp(
        layout.columns > 0 ? layout.columns : static_cast<int>(std::ceil(std::sqrt(count))), 1,
        count);
    const int rows = (count + columns - 1) / columns;
    const int width = layout.cellWidth, height = cellHeight(pictures[0], width), gap = layout.gap;
    const std::size_t sheetWidth = std::size_t(columns) * (width + gap) + gap;
    const std::size_t sheetHeight = std::size_t(rows) * (height + gap) + gap;
    if (sheetWidth * sheetHeight > kMaxPixels)
        throw InputError("the contact sheet would be too large: make its cells smaller");

    Image sheet(static_cast<int>(sheetWidth), static_cast<int>(sheetHeight), layout.background);
    for (int i = 0; i < count; ++i) {
        const Image picture = fitted(pictures[i], width, height);
        paste(picture, gap + i % columns * (width + gap) + (width - picture.width) / 2,
              gap + i / columns * (height + gap) + (height - picture.height) / 2, sheet);
    }
    return sheet;
}

}  // namespace vlf
