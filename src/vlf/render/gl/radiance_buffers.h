#pragma once
// A radiance field in the memory of the GPU.

#include "vlf/field/light_field.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/radiance_layout.h"
#include "vlf/render/gl/shaders/shared.h"

#include <cstdint>
#include <vector>

namespace vlf::gl {

class RadianceBuffers {
  public:
    /// `radiance`, of a field in this frame, of these mirror charts, as finely as `limits` and
    /// `bufferTexels`, texels of a buffer texture, allow. Throws InputError if its coarsest is too
    /// much.
    RadianceBuffers(const FieldFrame& frame, const RadianceField& radiance,
                    const std::vector<std::uint32_t>& charts, const RadianceLimits& limits,
                    std::uint64_t bufferTexels);

    /// Binds them to their units and block (shaders/shared.h).
    void bind() const;

    bool fourATexel() const { return fourATexel_; }
    std::uint32_t coarseness() const { return coarseness_; }
    std::uint64_t bytes() const { return bytes_; }
    std::uint64_t elements() const { return elementCount_; }

  private:
    Buffer elements_, records_, description_;
    TextureObject elementTexture_, recordTexture_;
    bool fourATexel_ = false;
    std::uint32_t coarseness_ = 1;
    std::uint64_t bytes_ = 0, elementCount_ = 0;
};

}  // namespace vlf::gl
