#include "vlf/dynamic/prt_transfer.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr std::size_t kLanes = PrtTransfer::kLanes;
constexpr int kInterpolatedOrder = 3;
using Lanes = std::array<float, kLanes>;

void store(const PrtTransfer& transfer, std::size_t block, const std::array<Lanes, 3>& sums,
           std::span<Vec3> irradiance) {
    const std::size_t first = block * kLanes;
    const std::size_t count = std::min(kLanes, transfer.vertexCount - first);
    for (std::size_t lane = 0; lane < count; ++lane) {
        Vec3 sum(sums[0][lane], sums[1][lane], sums[2][lane]);
        if (!transfer.own.empty()) sum += transfer.own[first + lane];
        irradiance[first + lane] = glm::max(sum, Vec3(0));
    }
}

/// Of the eight corners, at the places of a block's vertices.
std::array<Lanes, 8> cornerWeights(const float* places) {
    std::array<Lanes, 8> weights;
    for (std::size_t corner = 0; corner < weights.size(); ++corner)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            float w = 1;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const float place = places[axis * kLanes + lane];
                w *= (corner >> axis & 1) != 0 ? place : 1 - place;
            }
            weights[corner][lane] = w;
        }
    return weights;
}

/// Light of functions first to last - 1, whose rows begin at `row`, the same for all vertices.
void addRows(const float* row, const Sh<Vec3>& radiance, int first, int last,
             std::array<Lanes, 3>& sums) {
    std::array<Lanes, 3> added = sums;
    for (int f = first; f < last; ++f)
        for (int c = 0; c < 3; ++c, row += kLanes)
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                added[c][lane] += row[lane] * radiance[f][c];
    sums = added;
}

Sh<Vec3> meanOf(const std::array<Sh<Vec3>, 8>& corners) {
    Sh<Vec3> mean{};
    for (const Sh<Vec3>& corner : corners)
        for (int f = 0; f < kMaxShCount; ++f) mean[f] += 0.125f * corner[f];
    return mean;
}

}  // namespace

void applyTransfer(const PrtTransfer& transfer, const Sh<Vec3>& radiance,
                   std::span<Vec3> irradiance) {
    const std::size_t blockSize = transfer.blockSize();
    const int functions = shCount(transfer.order);
    for (std::size_t block = 0; block * kLanes < transfer.vertexCount; ++block) {
        std::array<Lanes, 3> sums{};
        addRows(transfer.blocks.data() + block * blockSize + 3 * kLanes, radiance, 0, functions,
                sums);
        store(transfer, block, sums, irradiance);
    }
}

void applyTransfer(const PrtTransfer& transfer, const std::array<Sh<Vec3>, 8>& corners,
                   std::span<Vec3> irradiance) {
    const std::size_t blockSize = transfer.blockSize();
    const int functions = shCount(transfer.order);
    const int interpolated = std::min(functions, shCount(kInterpolatedOrder));
    const Sh<Vec3> mean = meanOf(corners);
    for (std::size_t block = 0; block * kLanes < transfer.vertexCount; ++block) {
        const float* row = transfer.blocks.data() + block * blockSize;
        const std::array<Lanes, 8> weights = cornerWeights(row);
        row += 3 * kLanes;
        std::array<Lanes, 3> sums{};
        for (int f = 0; f < interpolated; ++f)
            for (int c = 0; c < 3; ++c, row += kLanes) {
                Lanes light{};
                for (std::size_t corner = 0; corner < corners.size(); ++corner)
                    for (std::size_t lane = 0; lane < kLanes; ++lane)
                        light[lane] += weights[corner][lane] * corners[corner][f][c];
                for (std::size_t lane = 0; lane < kLanes; ++lane)
                    sums[c][lane] += row[lane] * light[lane];
            }
        addRows(row, mean, interpolated, functions, sums);
        store(transfer, block, sums, irradiance);
    }
}

}  // namespace vlf
