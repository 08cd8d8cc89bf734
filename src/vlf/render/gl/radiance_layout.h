#pragma once
// Where the GPU finds the elements of the radiance field: one record per mirror chart and
// direction.
//
// The cells in which a direction shows a chart are stored as a sheared rectangle: row y of it
// starts at x + ⌊shear · y⌋. The projection of a wall mirror is a parallelogram, which this holds
// without waste. A field that does not fit is laid out coarser: k x k of its cells become one.

#include "vlf/field/radiance_field.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace vlf {

/// Four words, as the shader reads them.
struct RadianceRecord {
    std::uint32_t firstElement = 0;
    std::uint16_t x = 0, y = 0;           ///< first cell; x is offset by 0x8000
    std::uint16_t width = 0, height = 0;  ///< cells; 0: the chart is not seen
    float shear = 0;

    /// Column of the cell that row `row` of the rectangle starts with.
    int firstColumn(int row) const;
};
static_assert(sizeof(RadianceRecord) == 16);

struct RadianceLayout {
    int coarseness = 1;                   ///< k
    std::uint64_t elements = 0;           ///< of four bytes
    std::vector<RadianceRecord> records;  ///< chart by chart, one per oriented direction

    std::uint64_t bytes() const { return 4 * elements + sizeof(RadianceRecord) * records.size(); }
};

/// What a layout may take.
struct RadianceLimits {
    std::uint64_t elements = std::numeric_limits<std::uint32_t>::max();
    std::uint64_t bytes = std::numeric_limits<std::uint64_t>::max();
};

/// `charts` are the mirror charts in the order of their records; `coarseness` is a power of two, at
/// most the field's tile size. Records are only of use if elements fit 32 bits.
RadianceLayout layOutRadiance(const RadianceField& field, const std::vector<std::uint32_t>& charts,
                              int coarseness = 1);

/// The finest layout within limits. Throws InputError, saying what would be needed, if there is
/// none.
RadianceLayout layOutWithin(const RadianceLimits& limits, const RadianceField& field,
                            const std::vector<std::uint32_t>& charts);

}  // namespace vlf
