#pragma once
// How bright the faces of objects are in two pictures of them.

#include "vlf/dynamic/dynamic_room.h"
#include "vlf/image/image.h"

#include <cstddef>
#include <vector>

namespace vlf {

/// The triangles of one object with the same normal or, where an object has many normals, with
/// normals nearest to the same of its six axes.
struct FaceRadiance {
    std::size_t object = 0;  ///< number in the DynamicRoom
    Vec3 normal{0};          ///< in the world
    std::size_t pixels = 0;  ///< that show the face and nothing else
    Vec3 test{0}, truth{0};  ///< mean radiance over these

    /// Relative error by luminance; 0.01 = 1 %.
    double error() const;
};

/// Every face that a pixel of the pictures from `camera` shows, in the order of the objects.
std::vector<FaceRadiance> compareFaces(const DynamicRoom& room, const RayScene& rays,
                                       const Camera& camera, const Image& test, const Image& truth);

/// Mean over faces of |error()|; 0 if there is none.
double meanFaceError(const std::vector<FaceRadiance>& faces);

}  // namespace vlf
