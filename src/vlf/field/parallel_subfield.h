#pragma once
// A parallel subfield (PSF): for one direction, an N x N grid of cells on the plane perpendicular
// to it, covering the bounding sphere; each cell is the origin of one ray.

#include "vlf/math/frame.h"
#include "vlf/math/vector.h"

namespace vlf {

/// Sphere that holds the scene; its inside is the unit sphere of the field.
struct FieldFrame {
    Vec3 centre{0};
    float radius = 1;  ///< metres
};

/// Canonical frame of one direction: cell coordinates and depth along the direction are affine
/// functions of world position.
struct ParallelSubfield {
    Vec3 xAxis, yAxis;  ///< cells per metre
    float xOffset = 0, yOffset = 0;
    Vec3 direction;     ///< unit
    float depthOffset = 0;
    int cells = 0;      ///< N

    /// Cell coordinates in [0, N]² of world point p; cell (i, j) covers [i, i+1) x [j, j+1), its
    /// ray passes through (i + ½, j + ½).
    Vec2 cellCoordinates(const Vec3& p) const {
        return {glm::dot(xAxis, p) + xOffset, glm::dot(yAxis, p) + yOffset};
    }
    /// Metres along the direction, 0 where it enters the bounding sphere's slab.
    float depth(const Vec3& p) const { return glm::dot(direction, p) + depthOffset; }
};

/// The subfield of `direction`. `roll` turns the grid about the direction (radians) and `jitter`
/// in [0, 1)² shifts it by parts of a cell; the grid then covers the sphere with one cell to
/// spare.
ParallelSubfield makeSubfield(const FieldFrame& frame, const Vec3& direction, int cells,
                              float roll = 0, const Vec2& jitter = Vec2(0));

}  // namespace vlf
