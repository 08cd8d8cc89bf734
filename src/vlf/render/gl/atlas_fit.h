#pragma once
// The irradiance atlas where it is larger than a texture may be: its charts packed anew and, where
// that is not enough, shrunk by a whole factor.

#include "vlf/field/light_field.h"

#include <cstdint>
#include <vector>

namespace vlf {

class AtlasFit {
  public:
    /// Throws InputError if even charts of single texels do not fit.
    AtlasFit(const LightField& field, std::uint32_t maxSide);

    /// Texels along a side that become one.
    std::uint32_t factor() const { return factor_; }
    /// The atlas is shown as it is.
    bool unchanged() const { return charts_.empty(); }

    /// What a renderer needs to know of the field's charts: these and the atlas' size, no light.
    LightField layout() const;

    /// The light of an atlas of the field's charts, as layout() has it. Precondition: !unchanged().
    IrradianceAtlas fit(const IrradianceAtlas& atlas) const;

  private:
    std::vector<Chart> original_, charts_;  ///< no charts_: unchanged
    std::vector<TriangleCharts> triangleCharts_;
    std::uint32_t factor_ = 1, width_ = 0, height_ = 0;
};

}  // namespace vlf
