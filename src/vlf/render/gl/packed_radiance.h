#pragma once
// The radiance field as the GPU reads it: four bytes an element, coded as shaders/shared.h says,
// each of its parts over the range that it has in the field. radiance_layout.h says where they are.

#include "vlf/field/radiance_field.h"
#include "vlf/render/gl/radiance_layout.h"

#include <cstdint>
#include <vector>

namespace vlf {

/// Code c stands for first + c · step.
struct LinearCode {
    float first = 0, step = 0;
};

struct PackedRadiance {
    std::vector<std::uint32_t> elements;  ///< filled up to a multiple of four
    float longestDistance = 0;            ///< metres
    LinearCode logSum;                    ///< log2 of the sum of red, green and blue
    LinearCode red, blue;                 ///< their shares in the sum
};

/// `layout` is of this field and these charts.
PackedRadiance packRadiance(const RadianceField& field, const std::vector<std::uint32_t>& charts,
                            const RadianceLayout& layout);

}  // namespace vlf
