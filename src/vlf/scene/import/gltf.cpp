// glTF 2.0 to Scene: node transforms, triangles of primitives, cameras.

#include "vlf/scene/camera_view.h"
#include "vlf/scene/import/file_bytes.h"
#include "vlf/scene/import/gltf_file.h"
#include "vlf/scene/import/gltf_material.h"
#include "vlf/scene/import/import.h"
#include "vlf/scene/import/limits.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <filesystem>
#include <numeric>

namespace vlf {

namespace {

using Transform = glm::dmat4;

/// worldFromNode of a node relative to its parent.
Transform localTransform(const tinygltf::Node& node, const SourceLocation& where) {
    const auto bad = [](const std::vector<double>& v, std::size_t n) {
        return !v.empty() && v.size() != n;
    };
    if (bad(node.matrix, 16) || bad(node.translation, 3) || bad(node.rotation, 4) ||
        bad(node.scale, 3))
        throw InputError(where, "the transform has the wrong number of values");
    Transform transform(1);
    if (!node.matrix.empty()) {
        for (int i = 0; i < 16; ++i) transform[i / 4][i % 4] = node.matrix[i];
        return transform;
    }
    if (!node.translation.empty())
        transform[3] = {node.translation[0], node.translation[1], node.translation[2], 1};
    if (!node.rotation.empty()) {
        const auto& r = node.rotation;
        const glm::dquat rotation(r[3], r[0], r[1], r[2]);
        if (!(glm::length(rotation) > 1e-6))
            throw InputError(where, "the rotation is not a unit quaternion");
        transform = transform * glm::mat4_cast(glm::normalize(rotation));
    }
    if (!node.scale.empty())
        for (int i = 0; i < 3; ++i) transform[i] *= node.scale[i];
    return transform;
}

/// Matrix that takes normals along: the cofactors, det(M) M⁻ᵀ, turned so that they keep their side
/// of a surface whose winding is restored after a reflection. Exists for singular M too.
glm::dmat3 normalTransform(const glm::dmat3& m) {
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                               glm::cross(m[0], m[1]));
    return glm::determinant(m) < 0 ? -cofactors : cofactors;
}

/// The nodes of the scene to import: the default scene, else the first, else all root nodes.
std::vector<int> rootNodes(const GltfFile& file) {
    const tinygltf::Model& model = file.model;
    if (!model.scenes.empty()) {
        const int index = std::max(model.defaultScene, 0);
        if (static_cast<std::size_t>(index) >= model.scenes.size())
            throw InputError(file.at("scene"), fmt::format("scenes[{}] does not exist", index));
        return model.scenes[index].nodes;
    }
    std::vector<char> isChild(model.nodes.size(), 0);
    for (const auto& node : model.nodes)
        for (const int child : node.children)
            if (child >= 0 && static_cast<std::size_t>(child) < isChild.size()) isChild[child] = 1;
    std::vector<int> roots;
    for (std::size_t i = 0; i < isChild.size(); ++i)
        if (!isChild[i]) roots.push_back(static_cast<int>(i));
    return roots;
}

/// Corners of the triangles of a primitive: lists, strips and fans alike as lists.
std::vector<std::uint32_t> asTriangleList(const std::vector<std::uint32_t>& indices, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        std::vector<std::uint32_t> list = indices;
        list.resize(indices.size() / 3 * 3);
        return list;
    }
    std::vector<std::uint32_t> list;
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
        const bool strip = mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        const std::size_t a = strip ? i : 0, odd = strip ? i % 2 : 0;
        list.insert(list.end(), {indices[a], indices[i + 1 + odd], indices[i + 2 - odd]});
    }
    return list;
}

/// Vertices and triangle corners of a primitive in the space of its node.
struct PrimitiveData {
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<std::uint32_t> corners;

    /// Gives every corner a vertex and its triangle's normal: what glTF wants of missing normals.
    void makeFlat() {
        PrimitiveData flat;
        for (const std::uint32_t corner : corners) {
            flat.corners.push_back(static_cast<std::uint32_t>(flat.positions.size()));
            flat.positions.push_back(positions[corner]);
            flat.uvs.push_back(uvs[corner]);
        }
        for (std::size_t i = 0; i + 2 < flat.positions.size(); i += 3) {
            const glm::dvec3 a = flat.positions[i], b = flat.positions[i + 1];
            const glm::dvec3 n = glm::cross(b - a, glm::dvec3(flat.positions[i + 2]) - a);
            const double length = glm::length(n);
            flat.normals.insert(flat.normals.end(), 3, length > 0 ? Vec3(n / length) : Vec3(0));
        }
        *this = std::move(flat);
    }
};

class GltfImporter {
  public:
    GltfImporter(const GltfFile& file, ImportReport& report) : file_(file), report_(report) {}

    Scene run() {
        const std::vector<Instance> instances = visitNodes();
        checkTriangleCount(triangleCount(instances), file_.path);
        materials_ = addGltfMaterials(scene_, file_, report_);
        for (const auto& [index, worldFromNode] : instances) {
            const tinygltf::Node& node = file_.model.nodes[index];
            const SourceLocation where = file_.at(fmt::format("nodes[{}]", index));
            if (node.mesh >= 0) addMesh(node, worldFromNode, where);
            if (node.camera >= 0) addCamera(node, worldFromNode, where);
        }
        if (!file_.model.lights.empty())
            warn(report_, file_.at("extensions"),
                 fmt::format("{} lights of KHR_lights_punctual are not supported and left out",
                             file_.model.lights.size()));
        return std::move(scene_);
    }

  private:
    struct Instance {
        int node;
        Transform worldFromNode;
    };

    /// All nodes of the scene, depth first. Every node has one parent at most, so none is met
    /// twice unless the nodes form a cycle or are shared.
    std::vector<Instance> visitNodes() const {
        std::vector<Instance> result, stack;  // on the stack, worldFromNode is still the parent's
        const auto push = [&](const std::vector<int>& nodes, const Transform& worldFromParent) {
            for (auto it = nodes.rbegin(); it != nodes.rend(); ++it)
                stack.push_back({*it, worldFromParent});
        };
        std::vector<char> visited(file_.model.nodes.size(), 0);
        push(rootNodes(file_), Transform(1));
        while (!stack.empty()) {
            auto [index, transform] = stack.back();
            stack.pop_back();
            const SourceLocation where = file_.at(fmt::format("nodes[{}]", index));
            if (index < 0 || static_cast<std::size_t>(index) >= visited.size())
                throw InputError(where, "the node does not exist");
            if (visited[index])
                throw InputError(where, "the node has several parents or is its own ancestor");
            visited[index] = 1;
            transform = transform * localTransform(file_.model.nodes[index], where);
            result.push_back({index, transform});
            push(file_.model.nodes[index].children, transform);
        }
        return result;
    }

    /// Elements of an accessor; 0 if there is no such accessor or it claims more than any file has,
    /// which reading it will say.
    std::size_t vertexCount(int accessor) const {
        const auto& accessors = file_.model.accessors;
        const bool exists = accessor >= 0 && static_cast<std::size_t>(accessor) < accessors.size();
        const std::size_t count = exists ? accessors[accessor].count : 0;
        return count <= kMaxFileBytes ? count : 0;
    }

    /// Number of triangles of all instances, before anything is read; of vertices that no triangle
    /// uses, as many as they would make.
    std::size_t triangleCount(const std::vector<Instance>& instances) const {
        const tinygltf::Model& model = file_.model;
        std::size_t count = 0;
        for (const Instance& instance : instances) {
            const int mesh = model.nodes[instance.node].mesh;
            if (mesh < 0 || static_cast<std::size_t>(mesh) >= model.meshes.size()) continue;
            for (const tinygltf::Primitive& primitive : model.meshes[mesh].primitives) {
                const auto positions = primitive.attributes.find("POSITION");
                if (positions == primitive.attributes.end()) continue;
                const int corners = primitive.indices < 0 ? positions->second : primitive.indices;
                if (corners < 0 || static_cast<std::size_t>(corners) >= model.accessors.size())
                    continue;
                const bool list = primitive.mode < 0 || primitive.mode == TINYGLTF_MODE_TRIANGLES;
                const std::size_t triangles = model.accessors[corners].count / (list ? 3 : 1);
                // Saturates: a single count can claim anything.
                count += std::min(std::max(triangles, vertexCount(positions->second) / 3),
                                  kMaxTriangles + 1);
            }
        }
        return count;
    }

    void addMesh(const tinygltf::Node& node, const Transform& worldFromNode,
                 const SourceLocation& where) {
        if (static_cast<std::size_t>(node.mesh) >= file_.model.meshes.size())
            throw InputError(where, fmt::format("meshes[{}] does not exist", node.mesh));
        const tinygltf::Mesh& mesh = file_.model.meshes[node.mesh];
        if (node.skin >= 0) warn(report_, where, "the skin is left out; the mesh is not posed");
        std::string name = node.name.empty() ? mesh.name : node.name;
        if (name.empty()) name = fmt::format("mesh {}", node.mesh);
        scene_.meshes.push_back({name, static_cast<std::uint32_t>(scene_.triangles.size()), 0});
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i)
            addPrimitive(mesh.primitives[i], worldFromNode,
                         fmt::format("meshes[{}].primitives[{}]", node.mesh, i));
    }

    GltfMaterial materialOf(const tinygltf::Primitive& primitive, const std::string& element) {
        if (primitive.material < 0) return {defaultMaterial(), {}};
        if (static_cast<std::size_t>(primitive.material) >= materials_.size())
            throw InputError(file_.at(element),
                             fmt::format("materials[{}] does not exist", primitive.material));
        return materials_[primitive.material];
    }

    /// Of primitives without a material.
    std::uint32_t defaultMaterial() {
        if (!default_) {
            default_ = static_cast<std::uint32_t>(scene_.materials.size());
            scene_.materials.emplace_back();
            scene_.materials.back().name = "default";
            scene_.materials.back().diffuse = Vec3(0.5f);
        }
        return *default_;
    }

    void addPrimitive(const tinygltf::Primitive& primitive, const Transform& worldFromNode,
                      const std::string& element) {
        const SourceLocation where = file_.at(element);
        const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
        if (mode < TINYGLTF_MODE_TRIANGLES || mode > TINYGLTF_MODE_TRIANGLE_FAN)
            return warn(report_, where, "points and lines are skipped");
        if (!primitive.attributes.contains("POSITION"))
            return warn(report_, where, "skipped: it has no positions");
        if (!primitive.targets.empty()) warn(report_, where, "morph targets are left out");
        const GltfMaterial material = materialOf(primitive, element);
        if (!material.index) return;
        append(readPrimitive(primitive, mode, material.uv, element), worldFromNode, *material.index,
               where);
    }

    PrimitiveData readPrimitive(const tinygltf::Primitive& primitive, int mode,
                                const GltfUvMapping& mapping, const std::string& element) const {
        PrimitiveData data;
        data.positions =
            readVec3s(file_, primitive.attributes.at("POSITION"), element + ".POSITION");
        const std::size_t count = data.positions.size();
        data.uvs = readUvs(primitive, mapping, count, element);
        const auto normals = primitive.attributes.find("NORMAL");
        if (normals != primitive.attributes.end()) {
            data.normals = readVec3s(file_, normals->second, element + ".NORMAL");
            checkCount(data.normals.size(), count, element + ".NORMAL");
        }
        std::vector<std::uint32_t> indices(primitive.indices < 0 ? count : 0);
        std::iota(indices.begin(), indices.end(), 0u);
        if (primitive.indices >= 0)
            indices = readIndices(file_, primitive.indices, count, element + ".indices");
        data.corners = asTriangleList(indices, mode);
        if (data.normals.empty()) data.makeFlat();
        return data;
    }

    /// Texture coordinates with v up; zeros where the mesh has none.
    std::vector<Vec2> readUvs(const tinygltf::Primitive& primitive, const GltfUvMapping& mapping,
                              std::size_t count, const std::string& element) const {
        const std::string attribute = fmt::format("TEXCOORD_{}", mapping.set);
        const auto found = primitive.attributes.find(attribute);
        if (found == primitive.attributes.end()) return std::vector<Vec2>(count, Vec2(0));
        std::vector<Vec2> uvs = readVec2s(file_, found->second, element + "." + attribute);
        checkCount(uvs.size(), count, element + "." + attribute);
        for (Vec2& uv : uvs) {
            uv = mapping.offset + mapping.scaleRotate * uv;
            uv.y = 1 - uv.y;
        }
        return uvs;
    }

    void checkCount(std::size_t count, std::size_t expected, const std::string& element) const {
        if (count != expected)
            throw InputError(file_.at(element),
                             fmt::format("{} elements for {} vertices", count, expected));
    }

    /// Puts the primitive into the world; reflections turn the winding round again.
    void append(const PrimitiveData& data, const Transform& worldFromNode, std::uint32_t material,
                const SourceLocation& where) {
        const glm::dmat3 linear(worldFromNode), normalMatrix = normalTransform(linear);
        const bool mirrored = glm::determinant(linear) < 0;
        const auto first = static_cast<std::uint32_t>(scene_.positions.size());
        for (std::size_t i = 0; i < data.positions.size(); ++i) {
            const Vec3 position(worldFromNode * glm::dvec4(data.positions[i], 1));
            if (!isFinite(position))
                throw InputError(where, fmt::format("the position of vertex {} is not finite", i));
            scene_.positions.push_back(position);
            const glm::dvec3 normal = normalMatrix * glm::dvec3(data.normals[i]);
            const double length = glm::length(normal);
            scene_.normals.push_back(length > 0 ? Vec3(normal / length) : Vec3(0));
            scene_.uvs.push_back(data.uvs[i]);
        }
        for (std::size_t i = 0; i + 2 < data.corners.size(); i += 3) {
            const std::uint32_t a = data.corners[i], b = data.corners[i + 1],
                                c = data.corners[i + 2];
            scene_.triangles.push_back(
                {{first + a, first + (mirrored ? c : b), first + (mirrored ? b : c)}, material});
        }
        scene_.meshes.back().triangleCount += static_cast<std::uint32_t>(data.corners.size() / 3);
    }

    void addCamera(const tinygltf::Node& node, const Transform& worldFromNode,
                   const SourceLocation& where) {
        if (static_cast<std::size_t>(node.camera) >= file_.model.cameras.size())
            throw InputError(where, fmt::format("cameras[{}] does not exist", node.camera));
        const tinygltf::Camera& source = file_.model.cameras[node.camera];
        const SourceLocation at = file_.at(fmt::format("cameras[{}]", node.camera));
        const double fov = glm::degrees(source.perspective.yfov);
        if (source.type != "perspective")
            return warn(report_, at, "orthographic cameras are left out");
        if (!(fov > 0 && fov < 180)) return warn(report_, at, "left out: yfov must lie in (0, π)");
        const glm::dvec3 eye(worldFromNode[3]), back(worldFromNode[2]), up(worldFromNode[1]);
        const glm::dvec3 look = eye - back / glm::length(back);
        std::string name = node.name.empty() ? source.name : node.name;
        if (name.empty()) name = fmt::format("camera {}", scene_.cameras.size());
        const Camera camera{name, Vec3(eye), Vec3(look), Vec3(up / glm::length(up)),
                            static_cast<float>(fov)};
        if (!hasView(camera)) return warn(report_, at, "left out: its transform is singular");
        scene_.cameras.push_back(camera);
    }

    const GltfFile& file_;
    ImportReport& report_;
    Scene scene_;
    std::vector<GltfMaterial> materials_;
    std::optional<std::uint32_t> default_;
};

}  // namespace

Scene importGltf(const std::string& path, ImportReport& report) {
    return GltfImporter(readGltf(path, report), report).run();
}

}  // namespace vlf
