#include "vlf/dynamic/prt_transfer.h"

#include "vlf/base/parallel.h"
#include "vlf/field/direction_set.h"

#include <algorithm>
#include <numeric>

#include <glm/packing.hpp>

namespace vlf {

namespace {

constexpr int kLines = 513, kFewLines = 129;
constexpr std::size_t kManyVertices = 1 << 15;  // are given the few
constexpr float kInset = 1.0f / 64;             // of the way from a vertex to a triangle's middle
constexpr int kMaxMirrors = 4;
constexpr int kMaxBounces = 64;
constexpr float kTolerance = 1e-3f;  // of the light still to come, relative to the first

/// A transfer vector, and last the light that the object emits itself.
using Row = std::array<Vec3, kMaxShCount + 1>;

/// Light that a vertex has from another place of the object, as a share of the irradiance there.
struct Reflection {
    std::uint32_t side;     // twice the triangle, and one if at its back
    std::uint32_t weights;  // barycentric coordinates, 16 bits each
    Vec3 share;
};

/// The triangles around each vertex.
struct VertexTriangles {
    std::vector<std::uint32_t> first, triangles;

    explicit VertexTriangles(const Scene& scene) : first(scene.positions.size() + 1, 0) {
        for (const Triangle& t : scene.triangles)
            for (const std::uint32_t v : t.vertex) ++first[v + 1];
        std::partial_sum(first.begin(), first.end(), first.begin());
        triangles.resize(first.back());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
            for (const std::uint32_t v : scene.triangles[t].vertex) triangles[next[v]++] = t;
    }
    std::span<const std::uint32_t> of(std::size_t vertex) const {
        return std::span(triangles).subspan(first[vertex], first[vertex + 1] - first[vertex]);
    }
};

/// Where rays from a vertex start on one of its triangles: a little inwards, since at the vertex
/// itself they would run within neighbouring faces.
struct Start {
    Vec3 origin, normal;
};

class TransferTracer {
  public:
    TransferTracer(const ObjectMesh& mesh, bool reflections)
        : mesh_(mesh),
          scene_(mesh.scene),
          reflections_(reflections),
          around_(mesh.scene),
          set_(mesh.sidedVertexCount() > kManyVertices ? kFewLines : kLines) {
        // Turned, so that faces along the axes have no directions within them.
        const Quat turn = glm::normalize(Quat(0.83f, 0.21f, -0.34f, 0.39f));
        for (int i = 0; i < set_.directionCount(); ++i) {
            directions_.push_back(turn * set_.direction(static_cast<std::uint32_t>(i)));
            basis_.push_back(shBasis(directions_.back()));
        }
    }

    /// Light that comes to a vertex from outside, and the shares of what comes from elsewhere.
    Row trace(std::size_t sidedVertex, std::vector<Reflection>& reflections) const;

  private:
    struct Sums {
        Sh<float> open{};  // met nothing
        Row row{};         // by way of mirrors, and own emission
        float weight = 0;
        std::vector<Reflection>& reflections;
    };

    std::vector<Start> starts(std::size_t vertex, float side) const;
    void follow(Ray ray, Hit hit, float weight, Sums& sums) const;

    const ObjectMesh& mesh_;
    const Scene& scene_;
    bool reflections_;
    VertexTriangles around_;
    DirectionSet set_;
    std::vector<Vec3> directions_;
    std::vector<Sh<float>> basis_;
};

std::vector<Start> TransferTracer::starts(std::size_t vertex, float side) const {
    std::vector<Start> starts;
    for (const std::uint32_t t : around_.of(vertex)) {
        const Vec3 normal = side * geometricNormal(scene_, t);
        if (!isFinite(normal)) continue;
        const Vec3 middle =
            (scene_.position(t, 0) + scene_.position(t, 1) + scene_.position(t, 2)) / 3.0f;
        starts.push_back(
            {glm::mix(scene_.positions[vertex], middle, kInset) + mesh_.rays.epsilon() * normal,
             normal});
    }
    const Vec3 normal = side * scene_.normals[vertex];
    if (starts.empty())
        starts.push_back({scene_.positions[vertex] + mesh_.rays.epsilon() * normal, normal});
    return starts;
}

Row TransferTracer::trace(std::size_t sidedVertex, std::vector<Reflection>& reflections) const {
    const std::size_t vertexCount = scene_.positions.size();
    const std::size_t vertex = sidedVertex % vertexCount;
    const float side = sidedVertex < vertexCount ? 1.0f : -1.0f;
    const Vec3 normal = side * scene_.normals[vertex];
    const std::vector<Start> from = starts(vertex, side);
    thread_local std::vector<Ray> rays;
    thread_local std::vector<Hit> hits;
    thread_local std::vector<std::uint32_t> directions;
    rays.clear(), directions.clear();
    for (std::uint32_t i = 0; i < basis_.size(); ++i) {
        const Vec3& d = directions_[i];
        const Start& start = from[i % from.size()];
        if (glm::dot(normal, d) <= 0 || glm::dot(start.normal, d) <= 0) continue;
        rays.push_back({start.origin, d});
        directions.push_back(i);
    }
    hits.resize(rays.size());
    mesh_.rays.closest(rays, hits);

    Sums sums{.reflections = reflections};
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const std::uint32_t i = directions[k];
        const float weight = glm::dot(normal, rays[k].direction) * set_.weight(i);
        if (hits[k]) {
            follow(rays[k], hits[k], weight, sums);
            continue;
        }
        sums.weight += weight;
        for (int f = 0; f < kMaxShCount; ++f) sums.open[f] += weight * basis_[i][f];
    }
    if (sums.weight <= 0) return {};
    for (Reflection& r : reflections) r.share /= sums.weight;
    for (int f = 0; f < kMaxShCount; ++f) sums.row[f] += Vec3(sums.open[f]);
    for (Vec3& v : sums.row) v *= kPi / sums.weight;
    return sums.row;
}

/// A ray that has met the object: the diffuse light of what it met, and of what is seen in it. One
/// that sees the inside of a solid is no sample.
void TransferTracer::follow(Ray ray, Hit hit, float weight, Sums& sums) const {
    Vec3 throughput(weight);
    for (int mirrors = 0; hit; ++mirrors) {
        const Vec3 faceNormal = geometricNormal(scene_, hit.triangle);
        const bool front = glm::dot(faceNormal, ray.direction) < 0;
        if (!front && mesh_.closed) {
            if (mirrors > 0) sums.weight += weight;
            return;
        }
        const Material& material = scene_.material(hit.triangle);
        const Vec2 uv = uvAt(scene_, hit.triangle, hit.barycentric);
        if (front || material.emitsBothSides)
            sums.row.back() += throughput * emittedRadiance(scene_, material, uv);
        if (reflections_ && !material.isPureMirror())
            sums.reflections.push_back({2 * hit.triangle + (front ? 0 : 1),
                                        glm::packUnorm2x16(hit.barycentric),
                                        throughput * diffuseReflectance(scene_, material, uv)});
        if (!reflections_ || !material.isMirror() || mirrors == kMaxMirrors) {
            sums.weight += weight;
            return;
        }
        throughput *= mirrorReflectance(scene_, material, uv);
        const Vec3 side = front ? faceNormal : -faceNormal;
        Vec3 normal = shadingNormalAt(scene_, hit.triangle, hit.barycentric);
        if (glm::dot(normal, side) < 0) normal = -normal;
        const Vec3 reflected = glm::reflect(ray.direction, normal);
        if (glm::dot(reflected, side) <= 0) break;
        ray = {ray.origin + hit.t * ray.direction + mesh_.rays.epsilon() * side, reflected};
        hit = mesh_.rays.closest(ray);
        if (hit) continue;
        const Sh<float> basis = shBasis(reflected);
        for (int f = 0; f < kMaxShCount; ++f) sums.row[f] += basis[f] * throughput;
    }
    sums.weight += weight;
}

/// What a vertex has by reflection of the light `from`.
Row reflected(const ObjectMesh& mesh, const std::vector<Reflection>& reflections,
              const std::vector<Row>& from) {
    Row sum{};
    for (const Reflection& r : reflections) {
        const Vec2 b = glm::unpackUnorm2x16(r.weights);
        const std::array<float, 3> weights{1 - b.x - b.y, b.x, b.y};
        const std::size_t offset = r.side % 2 == 0 ? 0 : mesh.scene.positions.size();
        for (int c = 0; c < 3; ++c) {
            const Row& row = from[offset + mesh.scene.triangles[r.side / 2].vertex[c]];
            const Vec3 share = weights[c] * r.share;
            for (std::size_t f = 0; f < row.size(); ++f) sum[f] += share * row[f];
        }
    }
    return sum;
}

/// Largest light of any vertex under constant radiance of 1/Y_0 and of its own.
float most(const std::vector<Row>& rows) {
    float largest = 0;
    for (const Row& row : rows)
        largest = std::max(largest, maxComponent(row.front()) + maxComponent(row.back()));
    return largest;
}

/// Adds all further reflections to `rows`.
void bounce(const ObjectMesh& mesh, const std::vector<std::vector<Reflection>>& reflections,
            std::vector<Row>& rows) {
    std::vector<Row> last = rows, next(rows.size());
    const float limit = kTolerance * most(rows);
    for (int i = 0; i < kMaxBounces && most(last) > limit; ++i) {
        parallelFor(rows.size(), 16, [&](std::size_t v) {
            next[v] = reflected(mesh, reflections[v], last);
            for (std::size_t f = 0; f < next[v].size(); ++f) rows[v][f] += next[v][f];
        });
        last.swap(next);
    }
}

PrtTransfer pack(const ObjectMesh& mesh, const std::vector<Row>& rows, int order) {
    PrtTransfer transfer;
    transfer.order = order;
    transfer.vertexCount = rows.size();
    transfer.box = boundsOf(mesh.scene);
    const std::size_t blockCount = (rows.size() + PrtTransfer::kLanes - 1) / PrtTransfer::kLanes;
    transfer.blocks.assign(blockCount * transfer.blockSize(), 0);
    const Vec3 size = transfer.box.size();
    for (std::size_t v = 0; v < rows.size(); ++v) {
        const Vec3 offset =
            mesh.scene.positions[v % mesh.scene.positions.size()] - transfer.box.lower;
        for (int c = 0; c < 3; ++c) {
            transfer.blocks[transfer.index(v, c)] = size[c] > 0 ? offset[c] / size[c] : 0;
            for (int f = 0; f < shCount(order); ++f) transfer.at(v, f, c) = rows[v][f][c];
        }
    }
    if (hasEmitter(mesh.scene))
        for (const Row& row : rows) transfer.own.push_back(row.back());
    return transfer;
}

}  // namespace

PrtTransfer computeTransfer(const ObjectMesh& mesh, const PrtSettings& settings) {
    const TransferTracer tracer(mesh, settings.reflections);
    std::vector<Row> rows(mesh.sidedVertexCount());
    std::vector<std::vector<Reflection>> reflections(rows.size());
    parallelFor(rows.size(), 16, [&](std::size_t v) { rows[v] = tracer.trace(v, reflections[v]); });
    if (settings.reflections) bounce(mesh, reflections, rows);
    return pack(mesh, rows, std::clamp(settings.order, 1, kMaxShOrder));
}

}  // namespace vlf
