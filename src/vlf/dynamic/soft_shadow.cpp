#include "vlf/dynamic/soft_shadow.h"

#include "vlf/base/parallel.h"
#include "vlf/dynamic/shadowed_texel.h"
#include "vlf/dynamic/texel_square.h"

#include <algorithm>

namespace vlf {

namespace {

constexpr std::size_t kGroupsAtOnce = 8;
constexpr float kBent = 3;  // slight errors: so far the middle of a square may be from a straight
                            // line, which those between two of its nine texels are a quarter from
constexpr float kWeak = 0.7f;  // slight errors
constexpr std::uint32_t kPoints = 24;

/// Points from all over a group.
void spreadPoints(const RoomTexels& room, const TexelGroup& group,
                  std::vector<SurfacePoint>& points) {
    points.clear();
    for (std::uint32_t k = 0; k < kPoints; ++k) {
        // Steps of the golden ratio: any that follow one another lie apart.
        const std::uint32_t place = (k * 0x9e3779b9u >> 16) * group.count >> 16;
        const auto of = room.unwrap.points.of(room.grouped[group.first + place]);
        points.push_back(of[k * 7 % of.size()]);
    }
}

}  // namespace

std::vector<std::uint32_t> texelsInShadow(const Scene& scene, const RayScene& rays,
                                          const RoomTexels& room,
                                          std::span<const ShadowCaster> objects) {
    Obstructions obstructions(scene, rays, room);
    obstructions.place(objects);
    std::vector<std::uint32_t> found;
    for (const TexelGroup& group : room.groups) {
        if (!obstructions.mayShadow(obstructions.receiverOf(group))) continue;
        for (std::uint32_t i = group.first; i < group.first + group.count; ++i)
            if (obstructions.mayShadow(texelReceiver(scene, room.unwrap, room.grouped[i])))
                found.push_back(room.grouped[i]);
    }
    return found;
}

ExtraOccluder occluderOf(const RayInstances& instances) {
    return [&instances](std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
        thread_local std::vector<std::uint8_t> own;
        own.resize(rays.size());
        instances.occluded(rays, own);
        for (std::size_t i = 0; i < own.size(); ++i) blocked[i] |= own[i];
    };
}

const TexelLoss& SoftShadows::find(const Coverage& coverage, const RayInstances& rays,
                                   std::span<const ShadowCaster> objects, int samples,
                                   float slight) {
    obstructions_.place(objects);
    parts_.resize(room_.groups.size());
    weak_.assign(room_.groups.size(), Vec3(0));
    parallelFor(room_.groups.size(), kGroupsAtOnce, [&](std::size_t g) {
        parts_[g].clear();
        const TexelGroup& group = room_.groups[g];
        const LightReceiver all = obstructions_.receiverOf(group);
        thread_local std::vector<MayHide> shadows;
        obstructions_.findShadows(all, shadows);
        if (shadows.empty()) return;
        ShadowedTexel texel(scene_, rays_, room_, rays, obstructions_, shadows, {samples, slight});
        const auto find = [&](std::uint32_t entry) {
            LightReceiver receiver = texelReceiver(scene_, room_.unwrap, entry);
            receiver.points = coverage.points(room_, entry);
            return receiver.points.empty() ? Vec3(0) : texel.loss(receiver);
        };
        const auto keep = [&](std::uint32_t t, const Vec3& loss) {
            if (loss != Vec3(0)) parts_[g].emplace_back(room_.entryOf[t], loss);
        };
        const auto expect = [&](const Sphere& part) {
            thread_local std::vector<MayHide> there;
            LightReceiver receiver = all;
            receiver.centre = part.centre, receiver.radius = part.radius;
            there.clear();
            for (const MayHide& shadow : shadows)
                if (obstructions_.mayHide(receiver, shadow.image, *shadow.object))
                    there.push_back(shadow);
            return there.empty()                              ? LightThere::none
                   : obstructions_.areSmooth(receiver, there) ? LightThere::even
                                                              : LightThere::any;
        };
        if (obstructions_.areSmooth(all, shadows)) {
            thread_local std::vector<SurfacePoint> points;
            spreadPoints(room_, group, points);
            LightReceiver whole = texelReceiver(scene_, room_.unwrap, room_.grouped[group.first]);
            whole.points = points;
            whole.centre = all.centre, whole.radius = all.radius;
            const Vec3 mean = texel.loss(whole);
            if (luminance(mean) <= kWeak * slight) {
                weak_[g] = mean;
                return;
            }
        }
        TexelSquare(room_, group).light(kBent * slight, expect, find, keep);
    });
    loss_.entries.clear(), loss_.loss.clear(), loss_.groups.clear(), loss_.groupLoss.clear();
    for (std::uint32_t g = 0; g < weak_.size(); ++g) {
        if (weak_[g] == Vec3(0)) continue;
        loss_.groups.push_back(g);
        loss_.groupLoss.push_back(weak_[g]);
    }
    for (const auto& part : parts_)
        for (const auto& [entry, loss] : part) {
            loss_.entries.push_back(entry);
            loss_.loss.push_back(loss);
        }
    return loss_;
}

}  // namespace vlf
