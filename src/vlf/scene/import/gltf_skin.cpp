#include "vlf/scene/import/gltf_skin.h"

#include <fmt/format.h>

#include <cmath>

namespace vlf {

namespace {

/// Bind matrices of a skin, the identity where the file has none.
std::vector<glm::dmat4> jointFromBound(const GltfFile& file, const tinygltf::Skin& skin,
                                       const std::string& element) {
    std::vector<glm::dmat4> matrices(skin.joints.size(), glm::dmat4(1));
    if (skin.inverseBindMatrices < 0) return matrices;
    const std::string where = element + ".inverseBindMatrices";
    const std::vector<float> numbers = readNumbers(file, skin.inverseBindMatrices, 16, where);
    if (numbers.size() < 16 * matrices.size())
        throw InputError(file.at(where), fmt::format("{} matrices for {} joints",
                                                     numbers.size() / 16, matrices.size()));
    for (std::size_t j = 0; j < matrices.size(); ++j)
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row)
                matrices[j][column][row] = numbers[16 * j + 4 * static_cast<std::size_t>(column) +
                                                   static_cast<std::size_t>(row)];
    return matrices;
}

/// worldFromBound of every joint.
std::vector<glm::dmat4> jointMatrices(const GltfFile& file, int index, const GltfPose& pose) {
    const tinygltf::Skin& skin = file.model.skins[index];
    const std::string element = fmt::format("skins[{}]", index);
    std::vector<glm::dmat4> matrices = jointFromBound(file, skin, element);
    for (std::size_t j = 0; j < matrices.size(); ++j) {
        const auto& worldFromJoint = pose[skin.joints[j]];
        if (!worldFromJoint)
            throw InputError(file.at(element), fmt::format("its joint nodes[{}] is not part of the "
                                                           "scene",
                                                           skin.joints[j]));
        matrices[j] = *worldFromJoint * matrices[j];
    }
    return matrices;
}

/// Sums of the joints' matrices and of their weights, per vertex.
class Blend {
  public:
    Blend(const GltfFile& file, const tinygltf::Primitive& primitive, std::size_t vertices,
          const std::string& element)
        : file_(file),
          primitive_(primitive),
          element_(element),
          sums_(vertices, glm::dmat4(0)),
          weights_(vertices, 0) {}

    /// Adds JOINTS_set and WEIGHTS_set; false if there are no such joints.
    bool add(int set, const std::vector<glm::dmat4>& matrices) {
        const std::string jointsName = fmt::format("JOINTS_{}", set),
                          weightsName = fmt::format("WEIGHTS_{}", set);
        if (!primitive_.attributes.contains(jointsName)) return false;
        const std::vector<float> joints = read(jointsName), weights = read(weightsName);
        for (std::size_t i = 0; i < weights.size(); ++i) {
            if (!(weights[i] > 0)) continue;
            const auto joint = static_cast<std::size_t>(joints[i]);
            if (joint >= matrices.size())
                throw InputError(file_.at(element_ + "." + jointsName),
                                 fmt::format("joint {} of vertex {} is not among the {} of the "
                                             "skin",
                                             joint, i / 4, matrices.size()));
            sums_[i / 4] += static_cast<double>(weights[i]) * matrices[joint];
            weights_[i / 4] += weights[i];
        }
        return true;
    }

    std::vector<glm::dmat4> means(const glm::dmat4& otherwise) {
        for (std::size_t v = 0; v < sums_.size(); ++v)
            sums_[v] = weights_[v] > 0 ? sums_[v] / weights_[v] : otherwise;
        return std::move(sums_);
    }

  private:
    /// Four numbers per vertex.
    std::vector<float> read(const std::string& attribute) const {
        const SourceLocation where = file_.at(element_ + "." + attribute);
        const auto found = primitive_.attributes.find(attribute);
        if (found == primitive_.attributes.end())
            throw InputError(where, "missing; the mesh has joints without weights");
        std::vector<float> numbers = readNumbers(file_, found->second, 4, where.element);
        if (numbers.size() != 4 * sums_.size())
            throw InputError(where, fmt::format("{} elements for {} vertices", numbers.size() / 4,
                                                sums_.size()));
        return numbers;
    }

    const GltfFile& file_;
    const tinygltf::Primitive& primitive_;
    const std::string& element_;
    std::vector<glm::dmat4> sums_;
    std::vector<double> weights_;
};

}  // namespace

std::vector<glm::dmat4> worldFromSkinnedVertices(const GltfFile& file, int node,
                                                 const tinygltf::Primitive& primitive,
                                                 const GltfPose& pose, const std::string& element) {
    const std::vector<glm::dmat4> joints = jointMatrices(file, file.model.nodes[node].skin, pose);
    const std::size_t vertices = file.model.accessors[primitive.attributes.at("POSITION")].count;
    Blend blend(file, primitive, vertices, element);
    for (int set = 0; blend.add(set, joints); ++set) continue;
    return blend.means(pose[node].value_or(glm::dmat4(1)));
}

}  // namespace vlf
