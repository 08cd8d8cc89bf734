#pragma once
// How objects change the light of a room, for mirrors that look up what they show.

#include "vlf/dynamic/changed_charts.h"
#include "vlf/render/gl/gl_object.h"
#include "vlf/render/gl/receiver_grid.h"
#include "vlf/render/gl/shaders/shared.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vlf::gl {

class ChangedLight {
  public:
    /// `looksUp`: whether anything looks factors up; else there are none. Both must outlive it.
    ChangedLight(const Scene& scene, const LightField& field, bool looksUp);

    bool looksUp() const { return looksUp_; }

    /// The atlases are of the field's charts.
    void update(const IrradianceAtlas& with, const IrradianceAtlas& without);

    std::span<const shared::ReceiverData> receivers() const { return receivers_; }
    /// Eight corners around each receiver's changed part.
    const std::vector<std::array<Vec3, 8>>& places() const { return places_; }
    /// Which of them may be where.
    const ReceiverGrid& grid() const { return grid_; }
    float tolerance() const { return charts_.tolerance(); }

    /// Binds the factors to shared::kChangeUnit.
    void bind() const;

    std::uint64_t bytes() const;

  private:
    void load(const ChangedChart& changed, const IrradianceAtlas& with,
              const IrradianceAtlas& without);

    const LightField& field_;
    ChangedCharts charts_;
    std::vector<shared::ReceiverData> receivers_;
    ReceiverGrid grid_;
    std::vector<std::array<Vec3, 8>> places_;
    std::vector<std::uint32_t> packed_;
    TextureObject factors_;  ///< in the atlas; where nothing has changed they are not read
    bool looksUp_;
};

}  // namespace vlf::gl
