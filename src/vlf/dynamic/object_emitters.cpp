#include "vlf/dynamic/object_emitters.h"

#include "vlf/base/parallel.h"
#include "vlf/dynamic/posed_scene.h"

#include <algorithm>
#include <array>

namespace vlf {

namespace {

constexpr int kPoints = 128;    // of all emitting surfaces of an object
constexpr float kOff = 4;       // ray epsilons that a shadow ray ends before an emitter
constexpr float kEven = 0.03f;  // relative deviation of the middle from its interpolation
constexpr int kSide = RoomTexels::kGroupSide;

/// The texels of one square.
class Square {
  public:
    Square(const RoomTexels& room, const TexelGroup& group) : room_(room) {
        entries_.fill(kNoTexel);
        for (std::uint32_t i = group.first; i < group.first + group.count; ++i) {
            const std::uint32_t entry = room.grouped[i];
            const Chart& chart = room.unwrap.charts[room.unwrap.texelChart[entry]];
            const std::uint32_t texel = room.unwrap.texels[entry];
            const std::uint32_t x = texel % room.unwrap.atlasWidth - chart.x;
            const std::uint32_t y = texel / room.unwrap.atlasWidth - chart.y;
            entries_[y % kSide * kSide + x % kSide] = entry;
        }
        whole_ = group.count == kSide * kSide;
    }

    /// Calls find(entry) for as many texels as needed and keep(texel, irradiance) for all.
    template <class Find, class Keep>
    void light(Find find, Keep keep) const {
        if (whole_) {
            std::array<Vec3, 9> grid;
            for (int i = 0; i < 9; ++i) grid[i] = find(entryAt(kAt[i % 3], kAt[i / 3]));
            if (isEven(grid)) {
                for (int y = 0; y < kSide; ++y)
                    for (int x = 0; x < kSide; ++x)
                        keep(room_.unwrap.texels[entryAt(x, y)], interpolate(grid, x, y));
                return;
            }
        }
        for (const std::uint32_t entry : entries_)
            if (entry != kNoTexel) keep(room_.unwrap.texels[entry], find(entry));
    }

  private:
    static constexpr std::array<int, 3> kAt{0, 3, 7};

    std::uint32_t entryAt(int x, int y) const { return entries_[y * kSide + x]; }

    static Vec3 interpolate(const std::array<Vec3, 9>& grid, int x, int y) {
        const int i = x >= kAt[1], j = y >= kAt[1];
        const float u = static_cast<float>(x - kAt[i]) / static_cast<float>(kAt[i + 1] - kAt[i]);
        const float v = static_cast<float>(y - kAt[j]) / static_cast<float>(kAt[j + 1] - kAt[j]);
        const auto row = [&](int r) { return (1 - u) * grid[3 * r + i] + u * grid[3 * r + i + 1]; };
        return (1 - v) * row(j) + v * row(j + 1);
    }

    static bool isEven(const std::array<Vec3, 9>& grid) {
        const auto at = [&](int i) { return luminance(grid[i]); };
        const float u = static_cast<float>(kAt[1]) / kAt[2];
        const auto even = [&](int a, int middle, int b) {
            const float straight = (1 - u) * at(a) + u * at(b);
            return std::abs(at(middle) - straight) <= kEven * std::max(at(middle), straight);
        };
        return even(0, 1, 2) && even(3, 4, 5) && even(6, 7, 8) && even(0, 3, 6) && even(1, 4, 7) &&
               even(2, 5, 8);
    }

    const RoomTexels& room_;
    std::array<std::uint32_t, kSide * kSide> entries_;
    bool whole_ = false;
};

}  // namespace

std::unique_ptr<const ObjectEmitters> makeEmitters(const DynamicObject& object,
                                                   const Unwrap& unwrap, std::uint32_t number) {
    Scene posed = posedScene(Scene{}, {&object, 1});
    for (Material& material : posed.materials) material.mirror = Vec3(0);  // they have no images
    auto emitters = std::make_unique<ObjectEmitters>();
    emitters->number = number;
    emitters->points = spreadPoints(posed, findLightSources(posed, unwrap), kPoints, 0);
    return emitters;
}

Vec3 EmittedLight::irradiance(const EmitterPoints& emitters, const Vec3& point, const Vec3& normal,
                              const Vec3& geometric) {
    rays_.clear(), light_.clear();
    solidAngles_.resize(emitters.points.size());
    const Vec3 origin = point + room_.epsilon() * geometric;
    for (const EmitterShare& share : emitters.shares) {
        solidAngles(emitters, share, point,
                    std::span(solidAngles_).subspan(share.first, share.count));
        for (std::uint32_t p = share.first; p < share.first + share.count; ++p) {
            const EmitterPoint& emitter = emitters.points[p];
            const Vec3 target = emitter.position + kOff * room_.epsilon() * emitter.normal;
            const Vec3 way = target - origin;
            const float cosine = glm::dot(normal, way) / glm::length(way);
            if (solidAngles_[p] <= 0 || cosine <= 0 || glm::dot(geometric, way) <= 0) continue;
            rays_.push_back({origin, way, 0, 1});
            light_.push_back(solidAngles_[p] * cosine * emitter.radiance);
        }
    }
    blocked_.resize(rays_.size()), blockedByObject_.resize(rays_.size());
    room_.occluded(rays_, blocked_);
    objects_.occluded(rays_, blockedByObject_);
    Vec3 sum(0);
    for (std::size_t i = 0; i < rays_.size(); ++i)
        if (!blocked_[i] && !blockedByObject_[i]) sum += light_[i];
    return sum;
}

void findEmittedLight(const ObjectEmitters& emitters, const Scene& scene, const RayScene& rays,
                      const RoomTexels& room, const Coverage& coverage, const RayInstances& objects,
                      std::vector<TexelChange>& light) {
    std::vector<std::vector<TexelChange>> parts(room.groups.size());
    parallelFor(room.groups.size(), 8, [&](std::size_t g) {
        EmittedLight emitted(rays, objects);
        const auto find = [&](std::uint32_t entry) {
            const auto points = coverage.points(room, entry);
            if (points.empty()) return Vec3(0);
            const SurfacePoint& p = points[points.size() / 2];
            const LightReceiver texel = texelReceiver(scene, room.unwrap, entry);
            const Vec3 geometric = texel.side * geometricNormal(scene, p.triangle);
            Vec3 normal = shadingNormalAt(scene, p.triangle, p.barycentric);
            if (glm::dot(normal, geometric) < 0) normal = -normal;
            const Vec3 point = positionAt(scene, p.triangle, p.barycentric);
            return emitted.irradiance(emitters.points, point, normal, geometric);
        };
        Square(room, room.groups[g]).light(find, [&](std::uint32_t texel, const Vec3& irradiance) {
            if (irradiance != Vec3(0)) parts[g].push_back({texel, irradiance});
        });
    });
    for (const std::vector<TexelChange>& part : parts)
        light.insert(light.end(), part.begin(), part.end());
}

}  // namespace vlf
