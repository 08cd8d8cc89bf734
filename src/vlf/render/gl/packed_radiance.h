#pragma once
// The radiance field as the GPU reads it: four bytes an element and one record per mirror chart
// and direction, so that a lookup takes one fetch besides the record.
//
// The cells in which a direction shows a chart are stored as a sheared rectangle: row y of it
// starts at x + ⌊shear · y⌋. The projection of a wall mirror is a parallelogram, which this holds
// without waste. An element is coded as shaders/shared.h says, each
// of its parts over the range that it has in the field.

#include "vlf/field/light_field.h"

#include <cstdint>
#include <vector>

namespace vlf {

/// Four words, as the shader reads them.
struct RadianceRecord {
    std::uint32_t firstElement = 0;
    std::uint16_t x = 0, y = 0;           ///< first cell; x is offset by 0x8000
    std::uint16_t width = 0, height = 0;  ///< cells; 0: the chart is not seen
    float shear = 0;
};
static_assert(sizeof(RadianceRecord) == 16);

/// Code c stands for first + c · step.
struct LinearCode {
    float first = 0, step = 0;
};

struct PackedRadiance {
    std::vector<std::uint32_t> elements;
    std::vector<RadianceRecord> records;  ///< chart by chart, one per oriented direction
    float longestDistance = 0;            ///< metres
    LinearCode logSum;                    ///< log2 of the sum of red, green and blue
    LinearCode red, blue;                 ///< their shares in the sum
};

/// `charts` are the mirror charts in the order of their records. Throws InputError if the field
/// holds more elements than 32 bits can number.
PackedRadiance packRadiance(const RadianceField& field, const std::vector<std::uint32_t>& charts);

}  // namespace vlf
