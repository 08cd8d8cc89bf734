#pragma once
// Line drawings of a scene.

#include "vlf/base/progress.h"
#include "vlf/dynamic/dynamic_room.h"
#include "vlf/image/image.h"
#include "vlf/render/cpu/line_layer.h"
#include "vlf/render/cpu/projection.h"
#include "vlf/render/drawing/pen.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"

#include <cstdint>

namespace vlf {

/// A line or dot in space that nothing hides.
void drawSegment(LineLayer& layer, const Projection& projection, const Vec3& from, const Vec3& to,
                 const Pen& pen);

/// The triangles of the scene and of the objects in it as lines, in display-linear colours:
/// creases, borders and contours strong and, where something hides them, faint; the other edges
/// thin, the thinner the denser they lie; all paler with distance. `normals` adds the shading
/// normal at each visible triangle's centre. `traced` is the number of rays that tested visibility.
/// Throws Cancelled, and InputError if the camera has no view.
Image drawWireframe(const Scene& scene, const RayScene& rays, const Camera& camera, int width,
                    int height, bool normals, Progress& progress, std::uint64_t& traced,
                    const DynamicRoom* objects = nullptr);

}  // namespace vlf
