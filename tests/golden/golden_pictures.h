#pragma once
// The pictures that are kept: what each shows, and how it is made.

#include "golden/picture_difference.h"
#include "support/baked_example.h"
#include "vlf/render/cpu/still.h"

#include <string>
#include <vector>

namespace vlf::test {

struct GoldenPicture {
    std::string scene, camera;
    std::string shows;  ///< the last part of its name
    PictureLimits limits;
    float exposure = 0;  ///< EV, of pictures of radiance
    DisplayMode mode = DisplayMode::raytraced;
    LookupKind lookup = LookupKind::depthCorrected;
    DiagramKind diagram = DiagramKind::directions;
    bool openGl = false;  ///< drawn by the GPU

    std::string name() const { return scene + "-" + camera + (openGl ? "-gl-" : "-") + shows; }
    std::string nameByCpu() const { return scene + "-" + camera + "-" + shows; }
};

const std::vector<GoldenPicture>& goldenPictures();

/// In display-linear colours in [0, 1].
Image renderGolden(const BakedExample& baked, const GoldenPicture& picture);

}  // namespace vlf::test
