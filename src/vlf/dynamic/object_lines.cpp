#include "vlf/dynamic/object_lines.h"

#include "vlf/base/parallel.h"
#include "vlf/dynamic/turned_set.h"
#include "vlf/field/direction_set.h"
#include "vlf/math/frame.h"
#include "vlf/math/random.h"
#include "vlf/math/sampling.h"

#include <cmath>

namespace vlf {

namespace {

struct LinePart {
    std::vector<LineEnd> entries, exits;
};

LineEnd endAt(const ObjectReceivers& receivers, const Ray& ray, const Hit& hit) {
    const bool front = glm::dot(areaVector(receivers.mesh->scene, hit.triangle), ray.direction) < 0;
    return {ray.origin + hit.t * ray.direction, receivers.at(hit.triangle, hit.barycentric, front),
            hit.triangle, hit.barycentric};
}

LinePart linesAlong(const ObjectReceivers& receivers, const Sphere& bounds, const Vec3& direction,
                    float cell, std::uint64_t key) {
    const Frame frame = frameFromNormal(direction);
    const Vec2 jitter = RandomStream(0, key).next2();
    const int reach = static_cast<int>(std::ceil(bounds.radius / cell));
    std::vector<Ray> forward, backward;
    for (int y = -reach - 1; y <= reach; ++y)
        for (int x = -reach - 1; x <= reach; ++x) {
            const Vec2 at = cell * (Vec2(x, y) + jitter);
            if (glm::dot(at, at) > bounds.radius * bounds.radius) continue;
            const Vec3 p = bounds.centre + frame.toWorld({at, 0});
            forward.push_back({p - 1.5f * bounds.radius * direction, direction});
            backward.push_back({p + 1.5f * bounds.radius * direction, -direction});
        }
    std::vector<Hit> first(forward.size()), last(backward.size());
    receivers.mesh->rays.closest(forward, first);
    receivers.mesh->rays.closest(backward, last);
    LinePart part;
    for (std::size_t i = 0; i < forward.size(); ++i) {
        if (!first[i] || !last[i]) continue;
        part.entries.push_back(endAt(receivers, forward[i], first[i]));
        part.exits.push_back(endAt(receivers, backward[i], last[i]));
    }
    return part;
}

}  // namespace

ObjectLines makeObjectLines(const ObjectReceivers& receivers, const Sphere& bounds, int lines,
                            float cell) {
    const DirectionSet set(lines);
    const Mat3 turn = sampleUniformRotation(kTurn);
    ObjectLines result;
    result.cellArea = cell * cell;
    std::vector<LinePart> parts(static_cast<std::size_t>(set.lineCount()));
    parallelFor(parts.size(), 16, [&](std::size_t k) {
        parts[k] = linesAlong(receivers, bounds,
                              turn * set.direction(static_cast<std::uint32_t>(k)), cell, k);
    });
    result.firstCell.push_back(0);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const LinePart& part = parts[k];
        result.directions.push_back(turn * set.direction(static_cast<std::uint32_t>(k)));
        result.weights.push_back(set.weight(static_cast<std::uint32_t>(k)));
        result.entries.insert(result.entries.end(), part.entries.begin(), part.entries.end());
        result.exits.insert(result.exits.end(), part.exits.begin(), part.exits.end());
        result.firstCell.push_back(static_cast<std::uint32_t>(result.entries.size()));
    }
    return result;
}

}  // namespace vlf
