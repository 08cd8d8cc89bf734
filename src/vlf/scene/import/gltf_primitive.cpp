#include "vlf/scene/import/gltf_primitive.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace vlf {

namespace {

/// Corners of the triangles of a primitive: lists, strips and fans alike as lists.
std::vector<std::uint32_t> asTriangleList(std::vector<std::uint32_t> indices, int mode) {
    if (mode != TINYGLTF_MODE_TRIANGLE_STRIP && mode != TINYGLTF_MODE_TRIANGLE_FAN) {
        indices.resize(indices.size() / 3 * 3);
        return indices;
    }
    std::vector<std::uint32_t> list;
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
        const bool strip = mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        const std::size_t a = strip ? i : 0, odd = strip ? i % 2 : 0;
        list.insert(list.end(), {indices[a], indices[i + 1 + odd], indices[i + 2 - odd]});
    }
    return list;
}

class PrimitiveReader {
  public:
    PrimitiveReader(const GltfFile& file, const tinygltf::Primitive& source,
                    const std::string& element)
        : file_(file), source_(source), element_(element) {}

    GltfPrimitive read(std::span<const double> weights, const GltfMaterial& material) const {
        GltfPrimitive primitive;
        const std::string& position = element_ + ".POSITION";
        primitive.positions = readVec3s(file_, source_.attributes.at("POSITION"), position);
        const std::size_t count = primitive.positions.size();
        if (const auto normals = source_.attributes.find("NORMAL");
            normals != source_.attributes.end())
            primitive.normals = checked(readVec3s(file_, normals->second, element_ + ".NORMAL"),
                                        count, element_ + ".NORMAL");
        for (std::size_t t = 0; t < source_.targets.size() && t < weights.size(); ++t)
            if (weights[t] != 0) morph(primitive, t, static_cast<float>(weights[t]));
        primitive.uvs = readUvs(material.uv, count);
        if (material.emissionUv) primitive.emissionUvs = readUvs(*material.emissionUv, count);
        primitive.colors = readColors(count);
        primitive.corners = asTriangleList(readCorners(count), source_.mode);
        return primitive;
    }

  private:
    template <class T>
    std::vector<T> checked(std::vector<T> values, std::size_t count,
                           const std::string& element) const {
        if (values.size() != count)
            throw InputError(file_.at(element),
                             fmt::format("{} elements for {} vertices", values.size(), count));
        return values;
    }

    void morph(GltfPrimitive& primitive, std::size_t target, float weight) const {
        const auto add = [&](const char* attribute, std::vector<Vec3>& values) {
            const auto found = source_.targets[target].find(attribute);
            if (found == source_.targets[target].end() || values.empty()) return;
            const std::string element =
                fmt::format("{}.targets[{}].{}", element_, target, attribute);
            const std::vector<Vec3> offsets =
                checked(readVec3s(file_, found->second, element), values.size(), element);
            for (std::size_t i = 0; i < values.size(); ++i) values[i] += weight * offsets[i];
        };
        add("POSITION", primitive.positions);
        add("NORMAL", primitive.normals);
    }

    std::vector<Vec2> readUvs(const GltfUvMapping& mapping, std::size_t count) const {
        const std::string attribute = fmt::format("TEXCOORD_{}", mapping.set);
        const auto found = source_.attributes.find(attribute);
        if (found == source_.attributes.end()) return std::vector<Vec2>(count, Vec2(0));
        const std::string element = element_ + "." + attribute;
        std::vector<Vec2> uvs = checked(readVec2s(file_, found->second, element), count, element);
        for (std::size_t i = 0; i < uvs.size(); ++i) {
            uvs[i] = mapping.offset + mapping.scaleRotate * uvs[i];
            uvs[i].y = 1 - uvs[i].y;
            if (!std::isfinite(uvs[i].x) || !std::isfinite(uvs[i].y))
                throw InputError(file_.at(element), fmt::format("element {} is not finite", i));
        }
        return uvs;
    }

    /// COLOR_0 without its alpha.
    std::vector<Vec3> readColors(std::size_t count) const {
        const auto found = source_.attributes.find("COLOR_0");
        if (found == source_.attributes.end()) return {};
        const std::string element = element_ + ".COLOR_0";
        const bool hasAlpha = file_.model.accessors[found->second].type == TINYGLTF_TYPE_VEC4;
        const std::size_t stride = hasAlpha ? 4 : 3;
        const std::vector<float> numbers =
            readNumbers(file_, found->second, static_cast<int>(stride), element);
        std::vector<Vec3> colors(numbers.size() / stride);
        for (std::size_t i = 0; i < colors.size(); ++i) {
            const float* const n = &numbers[stride * i];
            colors[i] = glm::clamp(Vec3(n[0], n[1], n[2]), Vec3(0), Vec3(1));
            if (!isFinite(Vec3(n[0], n[1], n[2])))
                throw InputError(file_.at(element), fmt::format("element {} is not finite", i));
        }
        return checked(std::move(colors), count, element);
    }

    std::vector<std::uint32_t> readCorners(std::size_t count) const {
        if (source_.indices >= 0)
            return readIndices(file_, source_.indices, count, element_ + ".indices");
        std::vector<std::uint32_t> indices(count);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }

    const GltfFile& file_;
    const tinygltf::Primitive& source_;
    const std::string& element_;
};

/// A matrix of points, and the one that takes normals along: the cofactors, det(M) M⁻ᵀ, turned so
/// that normals keep their side of a surface whose winding is restored after a reflection. Exists
/// for singular M too.
struct Placement {
    glm::dmat4 points;
    glm::dmat3 normals;
    bool mirrors;

    explicit Placement(const glm::dmat4& m) : points(m) {
        const glm::dmat3 linear(m);
        mirrors = glm::determinant(linear) < 0;
        normals = glm::dmat3(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                             glm::cross(linear[0], linear[1]));
        if (mirrors) normals = -normals;
    }
};

template <class T>
void gather(std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
    if (values.empty()) return;
    std::vector<T> gathered(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) gathered[i] = values[indices[i]];
    values = std::move(gathered);
}

}  // namespace

void GltfPrimitive::unshare() {
    gather(positions, corners);
    gather(normals, corners);
    gather(uvs, corners);
    gather(emissionUvs, corners);
    gather(maskUvs, corners);
    gather(colors, corners);
    std::iota(corners.begin(), corners.end(), 0u);
}

GltfPrimitive readPrimitive(const GltfFile& file, const tinygltf::Primitive& source,
                            std::span<const double> weights, const GltfMaterial& material,
                            const std::string& element) {
    return PrimitiveReader(file, source, element).read(weights, material);
}

void place(GltfPrimitive& primitive, std::span<const glm::dmat4> worldFromVertex,
           const SourceLocation& where) {
    const std::vector<Placement> placements(worldFromVertex.begin(), worldFromVertex.end());
    const auto placementOf = [&](std::size_t vertex) -> const Placement& {
        return placements[placements.size() == 1 ? 0 : vertex];
    };
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        Vec3& position = primitive.positions[i];
        position = Vec3(placementOf(i).points * glm::dvec4(position, 1));
        if (!isFinite(position))
            throw InputError(where, fmt::format("the position of vertex {} is not finite", i));
    }
    for (std::size_t i = 0; i < primitive.normals.size(); ++i) {
        const glm::dvec3 normal = placementOf(i).normals * glm::dvec3(primitive.normals[i]);
        const double length = glm::length(normal);
        primitive.normals[i] = length > 0 ? Vec3(normal / length) : Vec3(0);
    }
    for (std::size_t i = 0; i + 2 < primitive.corners.size(); i += 3)
        if (placementOf(primitive.corners[i]).mirrors)
            std::swap(primitive.corners[i + 1], primitive.corners[i + 2]);
}

}  // namespace vlf
