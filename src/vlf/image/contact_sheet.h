#pragma once
// Several pictures side by side in one.

#include "vlf/image/image.h"

#include <span>

namespace vlf {

/// The picture scaled to `width` x `height` >= 1: every new pixel is the mean of what it covers
/// (box filter), so that energy and edges are kept when it shrinks.
Image resized(const Image& image, int width, int height);

struct ContactSheetLayout {
    int columns = 0;      ///< 0: as many as make the sheet about as wide as high
    int cellWidth = 480;  ///< pixels; the height follows from the first picture's proportions
    int gap = 8;          ///< pixels between and around the pictures
    Vec3 background{0.02f};
};

/// All pictures in reading order, each scaled to fit its cell and centred in it. Throws InputError
/// if there is no picture, one is empty, or the sheet would exceed kMaxPixels of image_io.h.
Image contactSheet(std::span<const Image> pictures, const ContactSheetLayout& layout = {});

}  // namespace vlf
