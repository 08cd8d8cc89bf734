#pragma once
// What the surfaces of a room are like where a ray hits them, as plain data, to be copied into the
// buffers of a GPU and read by a shader (shaders/hit_surface.glsl).

#include "vlf/field/light_field.h"
#include "vlf/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vlf {

/// Records of one or more texels of four words; floats are held by their bits. A record names
/// another by the number of its first texel, kNoRecord: none.
///
/// side (front of triangle t: texel 2t, back: 2t + 1)
///     vertex, vertex, vertex, chart (none: the side is black)
/// vertex
///     position; x of the shading normal
///     y, z of the shading normal; texture coordinates
/// chart: as field/chart.h, its axes moved to its place in the atlas
///     u axis, offset
///     v axis, offset
///     first texel | last << 16 of u; the same of v; material; flags (shared.h)
/// material
///     diffuse reflectance; texture
///     mirror reflectance; texture
///     emitted radiance; texture
///     transmission and index of refraction of glass
/// texture
///     first of its texels; width | height << 16; Wrap of u; Wrap of v
struct HitSurfaces {
    using Texel = std::array<std::uint32_t, 4>;

    static constexpr std::uint32_t kNoRecord = 0xffffffffu;

    std::vector<Texel> records;
    std::vector<std::uint32_t> texels;  ///< of all textures in use, linear, as RGB9E5; row by row
};

/// Precondition: the charts are of this scene. Throws InputError if there are more records or
/// texels than 32 bits can number, or a texture or the atlas has more than 65535 pixels along a
/// side.
HitSurfaces makeHitSurfaces(const Scene& scene, const std::vector<Chart>& charts,
                            const std::vector<TriangleCharts>& triangleCharts);

}  // namespace vlf
