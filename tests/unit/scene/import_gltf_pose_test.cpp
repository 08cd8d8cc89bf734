// Morph targets and skins: meshes are read in the pose of the file.

#include "unit/scene/gltf_document.h"

namespace vlf {
namespace {

using nlohmann::json;
using test::bytesOf;
using test::Document;

constexpr int kByte = 5121;

class ImportGltfPose : public test::GltfTest {
  protected:
    /// The square of the document, the vertices at its left (x = 0) held by joint 0, those at its
    /// right by joint 1: nodes[1] and its child nodes[2].
    static Document skinned() {
        Document document;
        document.root["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                                  {{"children", {2}}, {"translation", {0, 0, 5}}},
                                  {{"translation", {2, 0, 0}}}};
        document.root["scenes"][0]["nodes"] = {0, 1};
        document.root["skins"] = {{{"joints", {1, 2}}}};
        hold(document, {0, 1, 1, 0}, {1, 1, 1, 1});
        return document;
    }

    /// Every vertex held by one joint.
    static void hold(Document& document, const std::vector<std::uint8_t>& joints,
                     const std::vector<float>& weights) {
        std::vector<std::uint8_t> fourJoints;
        std::vector<float> fourWeights;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            fourJoints.insert(fourJoints.end(), {joints[i], 0, 0, 0});
            fourWeights.insert(fourWeights.end(), {weights[i], 0, 0, 0});
        }
        json& attributes = document.primitive()["attributes"];
        attributes["JOINTS_0"] =
            document.addAccessor(bytesOf(fourJoints), kByte, joints.size(), "VEC4");
        attributes["WEIGHTS_0"] = document.addFloats(fourWeights, "VEC4");
    }

    /// Corners of the box around the vertices.
    void expectBounds(const Document& document, const Vec3& lower, const Vec3& upper) {
        const Bounds bounds = boundsOf(import(document));
        test::expectNear(bounds.lower, lower);
        test::expectNear(bounds.upper, upper);
    }

    /// A matrix that moves, in columns.
    static std::vector<float> translation(float x, float y, float z) {
        return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
    }
};

TEST_F(ImportGltfPose, MovesVerticesWithTheirJointsAndNotWithTheNode) {
    expectBounds(skinned(), {0, 0, 5}, {3, 1, 5});
}

TEST_F(ImportGltfPose, AppliesBindMatrices) {
    Document document = skinned();
    std::vector<float> matrices = translation(0, 0, -5);
    for (const float x : translation(-2, 0, -5)) matrices.push_back(x);
    document.root["skins"][0]["inverseBindMatrices"] = document.addFloats(matrices, "MAT4");
    expectBounds(document, {0, 0, 0}, {1, 1, 0});
}

TEST_F(ImportGltfPose, WeighsJointsAndScalesWeightsToOne) {
    Document document = skinned();
    json& attributes = document.primitive()["attributes"];
    attributes["JOINTS_1"] =
        document.addAccessor(bytesOf(std::vector<std::uint8_t>(16, 1)), kByte, 4, "VEC4");
    attributes["WEIGHTS_1"] =
        document.addFloats({3, 0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0}, "VEC4");
    // Those of joint 0 are now moved by a quarter of its place and three quarters of the other's.
    expectBounds(document, {1.5f, 0, 5}, {3, 1, 5});
}

TEST_F(ImportGltfPose, LeavesVerticesWithoutWeightsToTheNode) {
    Document document = skinned();
    hold(document, {0, 0, 0, 0}, {0, 0, 0, 0});
    expectBounds(document, {100, 0, 0}, {101, 1, 0});
}

TEST_F(ImportGltfPose, KeepsTheFrontUnderJointsThatMirror) {
    Document document = skinned();
    document.primitive()["attributes"]["NORMAL"] =
        document.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    document.root["nodes"][1]["scale"] = {-1, 1, 1};
    const Scene scene = import(document);
    for (std::uint32_t t = 0; t < 2; ++t) {
        test::expectNear(geometricNormal(scene, t), {0, 0, 1});
        test::expectNear(shadingNormalAt(scene, t, Vec2(0.3f)), {0, 0, 1});
    }
}

TEST_F(ImportGltfPose, NamesTheFaultOfASkin) {
    Document document = skinned();
    hold(document, {0, 1, 2, 0}, {1, 1, 1, 1});
    expectError(document, "meshes[0].primitives[0].JOINTS_0: joint 2 of vertex 2");
    document = skinned();
    document.root["scenes"][0]["nodes"] = {0};
    expectError(document, "skins[0]: its joint nodes[1] is not part of the scene");
    document = skinned();
    document.root["skins"][0]["inverseBindMatrices"] =
        document.addFloats(translation(0, 0, 0), "MAT4");
    expectError(document, "skins[0].inverseBindMatrices: 1 matrices for 2 joints");
    document = skinned();
    document.primitive()["attributes"].erase("WEIGHTS_0");
    expectError(document, "meshes[0].primitives[0].WEIGHTS_0: missing");
    document = skinned();
    document.root["skins"][0]["joints"] = {1, 7};
    expectError(document, "skins[0].joints[1]: nodes[7] does not exist");
    document = skinned();
    document.node()["skin"] = 1;
    expectError(document, "nodes[0].skin: skins[1] does not exist");
}

/// A second target lifts the far edge of the square by one.
Document morphing() {
    Document document;
    document.material()["pbrMetallicRoughness"] = {{"metallicFactor", 0}};
    const int none = document.addFloats(std::vector<float>(12, 7), "VEC3");
    const int lift = document.addFloats({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1}, "VEC3");
    document.primitive()["targets"] = {{{"POSITION", none}}, {{"POSITION", lift}}};
    return document;
}

TEST_F(ImportGltfPose, AppliesMorphTargetsByTheWeightsOfMeshOrNode) {
    Document document = morphing();
    expectBounds(document, {0, 0, 0}, {1, 1, 0});
    document.root["meshes"][0]["weights"] = {0, 0.5};
    expectBounds(document, {0, 0, 0}, {1, 1, 0.5f});
    document.node()["weights"] = {0, 1};
    expectBounds(document, {0, 0, 0}, {1, 1, 1});
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportGltfPose, MorphsNormals) {
    Document document = morphing();
    json& attributes = document.primitive()["attributes"];
    attributes["NORMAL"] = document.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    document.primitive()["targets"][1]["NORMAL"] =
        document.addFloats({0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0}, "VEC3");
    document.node()["weights"] = {0, 1};
    const Scene scene = import(document);
    test::expectNear(scene.normals[0], glm::normalize(Vec3(0, -1, 1)));
}

TEST_F(ImportGltfPose, NamesTheMorphTargetThatDoesNotFit) {
    Document document = morphing();
    document.primitive()["targets"][1]["POSITION"] = document.addFloats({0, 0, 0}, "VEC3");
    document.node()["weights"] = {0, 1};
    expectError(document, "meshes[0].primitives[0].targets[1].POSITION: 1 elements for 4 vertices");
}

TEST_F(ImportGltfPose, SaysThatAnimationsAreLeftOut) {
    Document document;
    document.root["animations"] = {{{"channels", json::array()}, {"samplers", json::array()}}};
    EXPECT_EQ(import(document).triangles.size(), 2u);
    EXPECT_EQ(warningsWith("animations: 1 animations are left out"), 1);
}

}  // namespace
}  // namespace vlf
