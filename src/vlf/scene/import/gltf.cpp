// glTF 2.0 to Scene: nodes with their meshes, cameras and lights.

#include "vlf/scene/camera_view.h"
#include "vlf/scene/import/alpha_mask.h"
#include "vlf/scene/import/file_bytes.h"
#include "vlf/scene/import/gltf_file.h"
#include "vlf/scene/import/gltf_material.h"
#include "vlf/scene/import/gltf_paint.h"
#include "vlf/scene/import/gltf_primitive.h"
#include "vlf/scene/import/gltf_skin.h"
#include "vlf/scene/import/import.h"
#include "vlf/scene/import/limits.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <optional>
#include <span>

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

/// The nodes of the scene to import: the default scene, else the first, else all root nodes.
std::vector<int> rootNodes(const GltfFile& file) {
    const tinygltf::Model& model = file.model;
    if (!model.scenes.empty()) return model.scenes[std::max(model.defaultScene, 0)].nodes;
    std::vector<char> isChild(model.nodes.size(), 0);
    for (const auto& node : model.nodes)
        for (const int child : node.children) isChild[child] = 1;
    std::vector<int> roots;
    for (std::size_t i = 0; i < isChild.size(); ++i)
        if (!isChild[i]) roots.push_back(static_cast<int>(i));
    return roots;
}

template <class T>
void extend(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

class GltfImporter {
  public:
    GltfImporter(const GltfFile& file, ImportReport& report) : file_(file), report_(report) {}

    ImportedScene run() {
        visitNodes();
        checkTriangleCount(triangleCount(), file_.path);
        materials_ = addGltfMaterials(scene_, masked_, file_, report_);
        for (const int index : nodes_) {
            const tinygltf::Node& node = file_.model.nodes[index];
            if (node.mesh >= 0) addMesh(index);
            if (node.camera >= 0) addCamera(node, *pose_[index]);
            if (file_.lights.ofNode[index] >= 0) addLight(index);
        }
        if (!file_.model.animations.empty())
            warn(report_, file_.at("animations"),
                 fmt::format("{} animations are left out; everything is as at rest",
                             file_.model.animations.size()));
        return {std::move(scene_), std::move(masked_)};
    }

  private:
    /// Finds all nodes of the scene, depth first, and their places. Every node has one parent at
    /// most, so none is met twice unless the nodes form a cycle or are shared.
    void visitNodes() {
        struct Visit {
            int node;
            Transform worldFromParent;
        };
        std::vector<Visit> stack;
        const auto push = [&](const std::vector<int>& nodes, const Transform& worldFromParent) {
            for (auto it = nodes.rbegin(); it != nodes.rend(); ++it)
                stack.push_back({*it, worldFromParent});
        };
        pose_.resize(file_.model.nodes.size());
        push(rootNodes(file_), Transform(1));
        while (!stack.empty()) {
            const auto [index, worldFromParent] = stack.back();
            stack.pop_back();
            const SourceLocation where = file_.at(fmt::format("nodes[{}]", index));
            if (pose_[index])
                throw InputError(where, "the node has several parents or is its own ancestor");
            pose_[index] = worldFromParent * localTransform(file_.model.nodes[index], where);
            nodes_.push_back(index);
            push(file_.model.nodes[index].children, *pose_[index]);
        }
    }

    /// Elements of an accessor; 0 if it claims more than any file has, which reading it will say.
    std::size_t vertexCount(int accessor) const {
        const std::size_t count = file_.model.accessors[accessor].count;
        return count <= kMaxFileBytes ? count : 0;
    }

    /// Number of triangles of all nodes, before anything is read; of vertices that no triangle
    /// uses, as many as they would make.
    std::size_t triangleCount() const {
        const tinygltf::Model& model = file_.model;
        std::size_t count = 0;
        for (const int index : nodes_) {
            const int mesh = model.nodes[index].mesh;
            if (mesh < 0) continue;
            for (const tinygltf::Primitive& primitive : model.meshes[mesh].primitives) {
                const auto positions = primitive.attributes.find("POSITION");
                if (positions == primitive.attributes.end()) continue;
                const int corners = primitive.indices < 0 ? positions->second : primitive.indices;
                const bool list = primitive.mode < 0 || primitive.mode == TINYGLTF_MODE_TRIANGLES;
                const std::size_t triangles = model.accessors[corners].count / (list ? 3 : 1);
                // Saturates: a single count can claim anything.
                count += std::min(std::max(triangles, vertexCount(positions->second) / 3),
                                  kMaxTriangles + 1);
            }
        }
        return count;
    }

    void addMesh(int index) {
        const tinygltf::Node& node = file_.model.nodes[index];
        const tinygltf::Mesh& mesh = file_.model.meshes[node.mesh];
        std::string name = node.name.empty() ? mesh.name : node.name;
        if (name.empty()) name = fmt::format("mesh {}", node.mesh);
        scene_.meshes.push_back({name, static_cast<std::uint32_t>(scene_.triangles.size()), 0});
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i)
            addPrimitive(index, mesh.primitives[i],
                         fmt::format("meshes[{}].primitives[{}]", node.mesh, i));
    }

    GltfMaterial materialOf(const tinygltf::Primitive& primitive) {
        if (primitive.material < 0) return {defaultMaterial(), {}, {}};
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

    void addPrimitive(int node, const tinygltf::Primitive& source, const std::string& element) {
        const SourceLocation where = file_.at(element);
        if (source.mode >= 0 && source.mode < TINYGLTF_MODE_TRIANGLES)
            return warn(report_, where, "points and lines are skipped");
        if (source.mode > TINYGLTF_MODE_TRIANGLE_FAN)
            throw InputError(where, fmt::format("mode {} does not exist", source.mode));
        if (!source.attributes.contains("POSITION"))
            return warn(report_, where, "skipped: it has no positions");
        const GltfMaterial material = materialOf(source);
        if (!material.index) return;
        GltfPrimitive primitive =
            readPrimitive(file_, source, morphWeights(node), material, element);
        const std::uint32_t painted = paint(primitive, *material.index, source);
        if (file_.model.nodes[node].skin >= 0 && source.attributes.contains("JOINTS_0"))
            place(primitive, worldFromSkinnedVertices(file_, node, source, pose_, element), where);
        else
            place(primitive, std::span(&*pose_[node], 1), where);
        if (primitive.normals.empty()) primitive.unshare();
        append(primitive, painted);
    }

    /// Painting gives the primitive a material and texture coordinates of its own; masks keep
    /// theirs.
    std::uint32_t paint(GltfPrimitive& primitive, std::uint32_t material,
                        const tinygltf::Primitive& source) {
        const auto mask = masked_.masks.find(material);
        if (mask != masked_.masks.end()) primitive.maskUvs = primitive.uvs;
        const std::uint32_t painted = painter_.paint(primitive, material, source);
        if (painted == material)
            primitive.maskUvs.clear();
        else if (mask != masked_.masks.end())
            masked_.masks[painted] = AlphaMask(mask->second);
        return painted;
    }

    /// The node's, else the mesh's.
    const std::vector<double>& morphWeights(int index) const {
        const tinygltf::Node& node = file_.model.nodes[index];
        return node.weights.empty() ? file_.model.meshes[node.mesh].weights : node.weights;
    }

    /// Missing normals are zero here, see cleanScene.
    void append(GltfPrimitive& primitive, std::uint32_t material) {
        const auto first = static_cast<std::uint32_t>(scene_.positions.size());
        primitive.normals.resize(primitive.positions.size(), Vec3(0));
        extend(scene_.positions, primitive.positions);
        extend(scene_.normals, primitive.normals);
        extend(scene_.uvs, primitive.uvs);
        for (std::size_t i = 0; i < primitive.maskUvs.size(); ++i)
            masked_.uvs[first + static_cast<std::uint32_t>(i)] = primitive.maskUvs[i];
        const std::vector<std::uint32_t>& corners = primitive.corners;
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
            scene_.triangles.push_back(
                {{first + corners[i], first + corners[i + 1], first + corners[i + 2]}, material});
        scene_.meshes.back().triangleCount += static_cast<std::uint32_t>(corners.size() / 3);
    }

    void addCamera(const tinygltf::Node& node, const Transform& worldFromNode) {
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

    /// Shines along the node's -Z; its scale means nothing to it.
    void addLight(int index) {
        const Transform& worldFromNode = *pose_[index];
        PunctualLight light = file_.lights.lights[file_.lights.ofNode[index]];
        const SourceLocation where = file_.at(fmt::format("nodes[{}]", index));
        if (maxComponent(light.intensity) <= 0)
            return warn(report_, where, "its light is left out: it is dark");
        const glm::dvec3 back(worldFromNode[2]);
        light.position = Vec3(glm::dvec3(worldFromNode[3]));
        light.direction = Vec3(-back / glm::length(back));
        if (!isFinite(light.position) || maxComponent(glm::abs(light.position)) > kMaxCoordinate)
            throw InputError(
                where,
                fmt::format("its light lies farther than {:g} m from the origin", kMaxCoordinate));
        if (!isFinite(light.direction)) {
            if (light.kind != PunctualKind::point)
                return warn(report_, where, "its light is left out: its transform is singular");
            light.direction = {0, 0, -1};
        }
        const std::string& name = file_.model.nodes[index].name;
        if (light.name.empty() || !name.empty()) light.name = name;
        if (light.name.empty()) light.name = fmt::format("light {}", scene_.lights.size());
        scene_.lights.push_back(std::move(light));
    }

    const GltfFile& file_;
    ImportReport& report_;
    Scene scene_;
    MaskedMaterials masked_;
    std::vector<int> nodes_;  ///< of the scene
    GltfPose pose_;
    GltfPainter painter_{scene_};
    std::vector<GltfMaterial> materials_;
    std::optional<std::uint32_t> default_;
};

}  // namespace

ImportedScene importGltf(const std::string& path, ImportReport& report) {
    return GltfImporter(readGltf(path, report), report).run();
}

}  // namespace vlf
