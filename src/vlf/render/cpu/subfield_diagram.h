#pragma once
// Diagrams of one parallel subfield: all of it, or one of its tiles.

#include "vlf/render/cpu/diagram.h"

namespace vlf {

/// drawDiagram for the kinds `subfield` and `tile`.
Image drawSubfieldDiagram(const Scene& scene, const RayScene& rays, const LightField& field,
                          const Camera& camera, int width, int height, int antialias,
                          const DiagramParams& params, Progress& progress, std::uint64_t& traced);

}  // namespace vlf
