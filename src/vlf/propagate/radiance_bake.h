#pragma once
// Fills the radiance field: for every direction and cell whose ray leaves a mirror, perfect or
// rough, what is seen in it and how far away.

#include "vlf/base/resumable_loop.h"
#include "vlf/field/light_field.h"
#include "vlf/propagate/mirror_view.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

#include <cstdint>

namespace vlf {

struct RadianceParams {
    int lines = 2049;                       ///< of the direction set: 2·4ⁿ + 1
    int cells = 256;                        ///< N
    int tileSize = 4;                       ///< m, a power of two
    MirrorKind kind = MirrorKind::perfect;  ///< of which mirrors
    GlossSamples gloss{};
};

struct RadianceSize {
    std::uint64_t elements = 0;
    std::uint64_t bytes = 0;  ///< of these and of the rows that they stand in
};

/// The exact size of what bakeRadiance would return, without the work.
RadianceSize radianceSize(const Scene& scene, const LightField& field,
                          const RadianceParams& params);

/// About the same, to a few per cent, from some of the directions.
RadianceSize estimateRadianceSize(const Scene& scene, const LightField& field,
                                  const RadianceParams& params);

/// A radiance field, complete or under way.
struct PartialRadiance {
    RadianceField field;  ///< elements of all directions, filled for those that are done
    LoopMarks done;       ///< oriented directions
};

/// Makes the radiance field of all charts whose material is a mirror of the kind, until it is
/// complete (true) or a pause is due (false). Of `field`, the charts, their triangles, the atlas
/// and the frame are read. The subfield of a direction and of its opposite is
/// makeSubfield(field.frame, direction of the line, cells).
///
/// What is seen is emission (of the emitting side), ρE/π with E from the atlas and the environment,
/// times the reflectance of the mirrors on the way, up to kMaxReflections of them. Every chart is
/// covered on its own, whatever hides it, with a guard band: all cells whose square of twice the
/// cell size touches it, so that bilinear interpolation on the chart finds its four cells.
/// Deterministic for any number of threads. Empty if there is no mirror. Throws InputError for
/// parameters out of range, or if elements that were made before are not of this field; Cancelled,
/// after which, too, it can be gone on with.
bool fillRadiance(const Scene& scene, const RayScene& rays, const LightField& field,
                  const RadianceParams& params, PartialRadiance& radiance, Progress& progress);

/// The same without a pause.
RadianceField bakeRadiance(const Scene& scene, const RayScene& rays, const LightField& field,
                           const RadianceParams& params, Progress& progress);

}  // namespace vlf
