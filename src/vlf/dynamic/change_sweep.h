#pragma once
// Light that has changed all over the room bounces on by bundle sweeps, as in the bake: for objects
// that emit. A few rays (change_bounce.h) would be too few there.

#include "vlf/dynamic/change_bounce.h"
#include "vlf/dynamic/lit_room.h"
#include "vlf/propagate/bundle_faces.h"
#include "vlf/propagate/texel_buffer.h"

#include <vector>

namespace vlf {

class ChangeSweep {
  public:
    explicit ChangeSweep(const LitRoom& room);

    /// Appends to `light` all that it becomes by bouncing.
    void bounce(const LitRoom& room, std::vector<TexelChange>& light);

  private:
    void emit(const LitRoom& room);
    void sweep(const LitRoom& room, int lines, int number);

    BundleFaces faces_;
    std::vector<Vec3> irradiance_;  ///< by atlas texel, of the bounce before
    TexelBuffer radiance_;
    std::vector<TexelBuffer> parts_;
    LightSources sources_;
};

}  // namespace vlf
