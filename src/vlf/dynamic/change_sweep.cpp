#include "vlf/dynamic/change_sweep.h"

#include "vlf/base/parallel.h"
#include "vlf/field/direction_set.h"
#include "vlf/field/parallel_subfield.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"
#include "vlf/propagate/ray_gather.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr int kLines = 129, kCells = 128;  // as the bake's coarse sweeps
constexpr std::size_t kAccumulators = 4;   // fixed: the sum is the same for any number of threads

}  // namespace

ChangeSweep::ChangeSweep(const LitRoom& room)
    : faces_(makeBundleFaces(room.scene, room.texels.unwrap, room.texels.frame)),
      irradiance_(room.texels.source.size(), Vec3(0)),
      radiance_(room.texels.source.size()),
      parts_(kAccumulators),
      sources_(room.texels.sources) {
    sources_.allApart = true;  // emission is no part of the change
}

void ChangeSweep::sweep(const LitRoom& room, int number) {
    const RoomTexels& texels = room.texels;
    const DirectionSet set(kLines);
    RandomStream turns(static_cast<std::uint64_t>(number), ~0ull);
    const Mat3 turn = sampleUniformRotation(Vec3(turns.next2(), turns.next()));
    parallelFor(kAccumulators, [&](std::size_t a) {
        parts_[a].reset(texels.source.size());
        SweepScratch scratch;
        RayGatherer mirrors(room.scene, room.rays, texels.unwrap, sources_);
        std::vector<MirrorSight> sights;
        for (auto line = static_cast<std::uint32_t>(a); line < kLines; line += kAccumulators) {
            RandomStream random(static_cast<std::uint64_t>(number), line);
            const float roll = 2 * kPi * random.next();
            const ParallelSubfield subfield = makeSubfield(texels.frame, turn * set.direction(line),
                                                           kCells, roll, random.next2());
            sights.clear();
            sweepBundle(faces_, subfield, radiance_, parts_[a], sights, scratch);
            mirrors.gatherFromMirrors(subfield, sights, radiance_, parts_[a]);
        }
    });
}

void ChangeSweep::add(const std::vector<TexelChange>& light, const LitRoom& room, int bounces,
                      RoomChange& change) {
    const Unwrap& unwrap = room.texels.unwrap;
    std::fill(irradiance_.begin(), irradiance_.end(), Vec3(0));
    for (const TexelChange& t : light) irradiance_[t.texel] += t.irradiance;
    for (int bounce = 0; bounce < bounces; ++bounce) {
        for (const std::uint32_t t : unwrap.texels)
            radiance_.set(t, room.texels.reflectance[t] * irradiance_[t] / kPi, 1);
        for (const auto& [texel, proxy] : unwrap.proxies)
            radiance_.set(texel, radiance_.rgb(proxy), 1);
        radiance_.set(radiance_.texelCount(), Vec3(0), 1);
        sweep(room, bounce);
        const TexelBuffer gathered = sumInOrder(parts_);
        for (const std::uint32_t t : unwrap.texels) {
            const float samples = gathered.weight(t);
            irradiance_[t] = samples > 0 ? kPi * gathered.rgb(t) / samples : Vec3(0);
            if (irradiance_[t] != Vec3(0)) change.add(t, irradiance_[t]);
        }
    }
}

}  // namespace vlf
