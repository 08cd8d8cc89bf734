#pragma once
// The irradiance atlas in the memory of the GPU.

#include "vlf/field/light_field.h"
#include "vlf/render/gl/atlas_fit.h"
#include "vlf/render/gl/gl_object.h"

#include <cstdint>
#include <vector>

namespace vlf::gl {

class IrradianceTexture {
  public:
    /// `largestSide`: texels. Throws as AtlasFit.
    IrradianceTexture(const LightField& field, std::uint32_t largestSide);

    /// How the charts lie in it.
    const AtlasFit& fit() const { return fit_; }
    GLuint id() const { return texture_.id(); }
    std::uint64_t bytes() const;

    /// An atlas of the field's charts.
    void load(const IrradianceAtlas& whole);

    /// The same, at the cost of what differs from the call before.
    void update(const IrradianceAtlas& whole);

  private:
    void loadRows(const IrradianceAtlas& light, std::uint32_t first, std::uint32_t last,
                  std::uint32_t left, std::uint32_t right);

    AtlasFit fit_;
    std::uint32_t width_, height_;
    TextureObject texture_;
    IrradianceAtlas shown_;  ///< what was copied by update()
    std::vector<std::uint32_t> packed_;
};

}  // namespace vlf::gl
