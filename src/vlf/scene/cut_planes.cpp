#include "vlf/scene/cut_planes.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace vlf {

namespace {

using Corners = std::array<std::uint32_t, 3>;

struct Plane {
    int axis;
    float coordinate;
};

/// By triangle: whether it is, or is connected with, one of these and no emitter.
std::vector<bool> withConnected(const Scene& scene, const std::vector<bool>& chosen) {
    std::vector<std::uint32_t> parent(scene.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t t) {
        while (parent[t] != t) t = parent[t] = parent[parent[t]];
        return t;
    };
    std::map<std::array<float, 3>, std::uint32_t> triangleAt;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        for (int c = 0; c < 3; ++c) {
            const Vec3& p = scene.position(t, c);
            parent[root(t)] = root(triangleAt.try_emplace({p.x, p.y, p.z}, t).first->second);
        }
    std::vector<bool> rootChosen(chosen.size()), result(chosen.size());
    for (std::uint32_t t = 0; t < chosen.size(); ++t)
        if (chosen[t]) rootChosen[root(t)] = true;
    for (std::uint32_t t = 0; t < chosen.size(); ++t)
        result[t] = rootChosen[root(t)] && !scene.material(t).isEmitter();
    return result;
}

class Cutter {
  public:
    Cutter(Scene& scene, const AxisPlanes& planes, float tolerance)
        : scene_(scene), planes_(planes), tolerance_(tolerance) {}

    std::vector<std::uint32_t> run(const std::vector<bool>& isCut) {
        std::vector<Triangle> triangles;
        std::vector<std::uint32_t> sources, first;
        for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
            first.push_back(static_cast<std::uint32_t>(triangles.size()));
            parts_.assign(1, scene_.triangles[t].vertex);
            if (isCut[t]) cut(t);
            for (const Corners& part : parts_) {
                triangles.push_back({part, scene_.triangles[t].material});
                sources.push_back(t);
            }
        }
        first.push_back(static_cast<std::uint32_t>(triangles.size()));
        scene_.triangles = std::move(triangles);
        for (Mesh& mesh : scene_.meshes) {
            const std::uint32_t end = first[mesh.firstTriangle + mesh.triangleCount];
            mesh.firstTriangle = first[mesh.firstTriangle];
            mesh.triangleCount = end - mesh.firstTriangle;
        }
        return sources;
    }

  private:
    /// Into parts_.
    void cut(std::uint32_t t) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto [least, most] =
                std::minmax({scene_.position(t, 0)[axis], scene_.position(t, 1)[axis],
                             scene_.position(t, 2)[axis]});
            const std::vector<float>& coordinates = planes_[axis];
            for (auto i = std::lower_bound(coordinates.begin(), coordinates.end(), least);
                 i != coordinates.end() && *i < most; ++i) {
                next_.clear();
                for (const Corners& part : parts_) split(part, {axis, *i});
                std::swap(parts_, next_);
            }
        }
    }

    /// Appends the parts on either side to next_.
    void split(const Corners& t, const Plane& plane) {
        std::array<int, 3> side{};
        for (int c = 0; c < 3; ++c) side[c] = sideOf(t[c], plane);
        if (std::min({side[0], side[1], side[2]}) >= 0 ||
            std::max({side[0], side[1], side[2]}) <= 0) {
            next_.push_back(t);
            return;
        }
        // Turned so that the first corner is on the plane or alone on its side.
        int c = 0;
        while (side[c] == side[(c + 1) % 3] || side[c] == side[(c + 2) % 3]) ++c;
        for (int i = 0; i < 3; ++i)
            if (side[i] == 0) c = i;
        const std::uint32_t a = t[c], b = t[(c + 1) % 3], d = t[(c + 2) % 3];
        if (side[c] == 0) {
            const std::uint32_t p = vertexOn(b, d, plane);
            next_.push_back({a, b, p});
            next_.push_back({a, p, d});
            return;
        }
        const std::uint32_t p = vertexOn(a, b, plane), q = vertexOn(a, d, plane);
        next_.push_back({a, p, q});
        const auto length = [&](std::uint32_t i, std::uint32_t j) {
            return glm::distance(scene_.positions[i], scene_.positions[j]);
        };
        if (length(p, d) < length(b, q)) {
            next_.push_back({p, b, d});
            next_.push_back({p, d, q});
        } else {
            next_.push_back({p, b, q});
            next_.push_back({b, d, q});
        }
    }

    int sideOf(std::uint32_t vertex, const Plane& plane) const {
        const float distance = scene_.positions[vertex][plane.axis] - plane.coordinate;
        return std::abs(distance) <= tolerance_ ? 0 : distance < 0 ? -1 : 1;
    }

    /// The point of an edge on the plane: the same bits from either end and for every triangle.
    std::uint32_t vertexOn(std::uint32_t a, std::uint32_t b, const Plane& plane) {
        Scene& s = scene_;
        const auto key = [&](std::uint32_t v) {
            const Vec3& p = s.positions[v];
            return std::make_tuple(p.x, p.y, p.z, v);
        };
        if (key(b) < key(a)) std::swap(a, b);
        const auto next = static_cast<std::uint32_t>(s.positions.size());
        const auto [it, isNew] = vertices_.try_emplace({a, b, plane.axis, plane.coordinate}, next);
        if (!isNew) return it->second;
        const float from = s.positions[a][plane.axis], to = s.positions[b][plane.axis];
        const float t = (plane.coordinate - from) / (to - from);
        Vec3 position = glm::mix(s.positions[a], s.positions[b], t);
        position[plane.axis] = plane.coordinate;
        const Vec3 normal = glm::mix(s.normals[a], s.normals[b], t);
        const float length = glm::length(normal);
        s.positions.push_back(position);
        s.normals.push_back(length > 0 ? normal / length : s.normals[a]);
        s.uvs.push_back(glm::mix(s.uvs[a], s.uvs[b], t));
        return next;
    }

    Scene& scene_;
    const AxisPlanes& planes_;
    float tolerance_;
    std::vector<Corners> parts_, next_;
    std::map<std::tuple<std::uint32_t, std::uint32_t, int, float>, std::uint32_t> vertices_;
};

}  // namespace

std::vector<std::uint32_t> cutByPlanes(Scene& scene, const AxisPlanes& planes, float tolerance,
                                       const std::vector<bool>& divided) {
    return Cutter(scene, planes, tolerance).run(withConnected(scene, divided));
}

}  // namespace vlf
