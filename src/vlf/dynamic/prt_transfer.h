#pragma once
// Precomputed radiance transfer: how incident light becomes irradiance on an object that shadows
// itself and reflects light to itself (Sloan, Kautz and Snyder, "Precomputed Radiance Transfer for
// Real-Time Rendering in Dynamic, Low-Frequency Lighting Environments", SIGGRAPH 2002).

#include "vlf/dynamic/object.h"
#include "vlf/dynamic/object_model.h"
#include "vlf/math/spherical_harmonics.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vlf {

/// Of every sided vertex (ObjectMesh::sidedVertexCount) a vector t of RGB coefficients, so that
/// incident radiance with coefficients l, in the object's space, is an irradiance of Σ t·l there.
/// That of the vertex: its own reflectance is not in it.
struct PrtTransfer {
    static constexpr std::size_t kLanes = 8;

    int order = 0;
    std::size_t vertexCount = 0;
    Bounds box;  ///< of the mesh

    /// By blocks of kLanes vertices, the last one filled up with zeros: kLanes x, then y and z, of
    /// the place in the box, in [0, 1]; then for every function and channel kLanes coefficients.
    std::vector<float> blocks;

    /// Irradiance from what the object itself emits, by vertex; empty if it does not.
    std::vector<Vec3> own;

    std::size_t blockSize() const {
        return kLanes * static_cast<std::size_t>(3 + 3 * shCount(order));
    }
    float& at(std::size_t vertex, int function, int channel) {
        return blocks[index(vertex, 3 + 3 * function + channel)];
    }
    Vec3 coefficient(std::size_t vertex, int function) const {
        const std::size_t i = index(vertex, 3 + 3 * function);
        return {blocks[i], blocks[i + kLanes], blocks[i + 2 * kLanes]};
    }
    std::size_t index(std::size_t vertex, int row) const {
        return vertex / kLanes * blockSize() + static_cast<std::size_t>(row) * kLanes +
               vertex % kLanes;
    }
};

/// Deterministic, on all threads. Light that has met a mirror of the object goes on from there, up
/// to four times.
PrtTransfer computeTransfer(const ObjectMesh& mesh, const PrtSettings& settings);

/// Irradiance (W·m⁻², not below 0) at every sided vertex, own light included; `irradiance` has
/// transfer.vertexCount entries. Incident radiance is in the object's space: the same all over the
/// object,
void applyTransfer(const PrtTransfer& transfer, const Sh<Vec3>& radiance,
                   std::span<Vec3> irradiance);

/// or given at the corners of its box (corner i is at the far side along x, y, z where bit 0, 1, 2
/// of i is set) and interpolated linearly along each axis. Bands from the fourth on take the mean
/// of the corners: interpolating them, too, costs as much again and changes the error by a
/// hundredth of itself.
void applyTransfer(const PrtTransfer& transfer, const std::array<Sh<Vec3>, 8>& corners,
                   std::span<Vec3> irradiance);

}  // namespace vlf
