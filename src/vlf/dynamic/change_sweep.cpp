#include "vlf/dynamic/change_sweep.h"

#include "vlf/base/parallel.h"
#include "vlf/field/direction_set.h"
#include "vlf/field/parallel_subfield.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/propagate/ray_gather.h"
#include "vlf/propagate/smooth_indirect.h"

#include <algorithm>
#include <array>

namespace vlf {

namespace {

/// Lines of the bounces. The first has bright spots next to objects, which few directions would
/// show one by one.
constexpr std::array<int, 3> kLines{513, 129, 129};
constexpr int kCells = 128;
constexpr std::size_t kAccumulators = 8;  // fixed: the sum is the same for any number of threads

}  // namespace

ChangeSweep::ChangeSweep(const LitRoom& room)
    : faces_(makeBundleFaces(room.scene, room.texels.unwrap, room.texels.frame)),
      irradiance_(room.texels.source.size(), Vec3(0)),
      radiance_(room.texels.source.size()),
      parts_(kAccumulators),
      sources_(room.texels.sources) {
    sources_.allApart = true;  // emission is no part of the change
}

/// Radiance by irradiance_.
void ChangeSweep::emit(const LitRoom& room) {
    const Unwrap& unwrap = room.texels.unwrap;
    for (const std::uint32_t t : unwrap.texels)
        radiance_.set(t, room.texels.reflectance[t] * irradiance_[t] / kPi, 1);
    for (const auto& [texel, proxy] : unwrap.proxies) radiance_.set(texel, radiance_.rgb(proxy), 1);
    radiance_.set(radiance_.texelCount(), Vec3(0), 1);
}

void ChangeSweep::sweep(const LitRoom& room, int lines, int number) {
    const RoomTexels& texels = room.texels;
    const DirectionSet set(lines);
    RandomStream turns(static_cast<std::uint64_t>(number), ~0ull);
    const Mat3 turn = sampleUniformRotation(Vec3(turns.next2(), turns.next()));
    parallelFor(kAccumulators, [&](std::size_t a) {
        parts_[a].reset(texels.source.size());
        SweepScratch scratch;
        RayGatherer mirrors(room.scene, room.rays, texels.unwrap, sources_);
        std::vector<MirrorSight> sights;
        for (auto line = static_cast<std::uint32_t>(a); line < static_cast<std::uint32_t>(lines);
             line += kAccumulators) {
            RandomStream random(static_cast<std::uint64_t>(number), line);
            const float roll = 2 * kPi * random.next();
            const ParallelSubfield subfield = makeSubfield(texels.frame, turn * set.direction(line),
                                                           kCells, roll, random.next2());
            sights.clear();
            sweepBundle(faces_, subfield, radiance_, parts_[a], sights, scratch);
            mirrors.gatherFromMirrors(subfield, sights, random, radiance_, parts_[a]);
        }
    });
}

void ChangeSweep::bounce(const LitRoom& room, std::vector<TexelChange>& light) {
    const RoomTexels& texels = room.texels;
    std::fill(irradiance_.begin(), irradiance_.end(), Vec3(0));
    for (const TexelChange& t : light) irradiance_[t.texel] += t.irradiance;
    for (std::size_t bounce = 0; bounce < kLines.size(); ++bounce) {
        emit(room);
        sweep(room, kLines[bounce], static_cast<int>(bounce));
        TexelBuffer gathered = sumInOrder(parts_);
        smoothIndirect(texels.unwrap, parts_, gathered);
        for (const std::uint32_t t : texels.unwrap.texels) {
            const float samples = gathered.weight(t);
            irradiance_[t] = samples > 0 ? kPi * gathered.rgb(t) / samples : Vec3(0);
            if (irradiance_[t] != Vec3(0)) light.push_back({t, irradiance_[t]});
        }
    }
    // What still bounces is spread evenly.
    Vec3 flux(0);
    for (const std::uint32_t t : texels.unwrap.texels)
        flux += texels.area[t] * texels.reflectance[t] * irradiance_[t];
    const Vec3 rest = flux * texels.gain() / std::max(texels.totalArea, 1e-20f);
    for (const std::uint32_t t : texels.unwrap.texels) light.push_back({t, rest});
}

}  // namespace vlf
