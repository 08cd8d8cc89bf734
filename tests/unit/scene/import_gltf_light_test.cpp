#include "unit/scene/gltf_document.h"

namespace vlf::test {
namespace {

class ImportGltfLight : public GltfTest {
  protected:
    /// A document whose node holds the light.
    static Document documentWith(const json& light) {
        Document document;
        document.root["extensions"] = {{"KHR_lights_punctual", {{"lights", json::array({light})}}}};
        document.node()["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
        return document;
    }

    std::string errorOfLight(const json& light) { return errorOf(documentWith(light)); }
};

TEST_F(ImportGltfLight, TakesCandelaForWattsPerSteradianUnderTheNodesTransform) {
    Document document =
        documentWith({{"type", "spot"},
                      {"name", "lamp"},
                      {"color", {1, 0.5, 0.25}},
                      {"intensity", 8},
                      {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.6}}}});
    document.node()["translation"] = {1, 2, 3};
    document.node()["rotation"] = {0, std::sqrt(0.5), 0, std::sqrt(0.5)};
    document.node()["scale"] = {2, 2, -2};
    const Scene scene = import(document);
    ASSERT_EQ(scene.lights.size(), 1u);
    const PunctualLight& light = scene.lights[0];
    EXPECT_EQ(light.name, "lamp");
    EXPECT_EQ(light.kind, PunctualKind::spot);
    EXPECT_EQ(light.position, Vec3(1, 2, 3));
    EXPECT_LT(glm::distance(light.direction, Vec3(1, 0, 0)), 1e-5f);  // -Z, turned, and mirrored
    EXPECT_EQ(light.intensity, Vec3(8, 4, 2));
    EXPECT_FLOAT_EQ(light.innerCone, 0.2f);
    EXPECT_FLOAT_EQ(light.outerCone, 0.6f);
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportGltfLight, HasTheExtensionsDefaults) {
    const PunctualLight point = import(documentWith({{"type", "point"}})).lights.at(0);
    EXPECT_EQ(point.kind, PunctualKind::point);
    EXPECT_EQ(point.intensity, Vec3(1));
    const PunctualLight spot =
        import(documentWith({{"type", "spot"}, {"spot", json::object()}})).lights.at(0);
    EXPECT_EQ(spot.innerCone, 0);
    EXPECT_NEAR(spot.outerCone, kPi / 4, 1e-6);
    const PunctualLight sun =
        import(documentWith({{"type", "directional"}, {"intensity", 68300}})).lights.at(0);
    EXPECT_EQ(sun.kind, PunctualKind::directional);
    EXPECT_EQ(sun.direction, Vec3(0, 0, -1));
    EXPECT_EQ(sun.intensity, Vec3(68300));
}

TEST_F(ImportGltfLight, IsPutWhereverANodeHoldsIt) {
    Document document = documentWith({{"type", "point"}});
    document.root["nodes"].push_back(
        {{"translation", {0, 5, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    document.root["scenes"][0]["nodes"] = {0, 1};
    EXPECT_EQ(import(document).lights.size(), 2u);
}

TEST_F(ImportGltfLight, SaysThatItsRangeIsLeftOut) {
    EXPECT_EQ(import(documentWith({{"type", "point"}, {"range", 3}})).lights.size(), 1u);
    EXPECT_EQ(warningsWith("lights[0].range: left out"), 1);
}

TEST_F(ImportGltfLight, IsRefusedWhereItIsNone) {
    const auto refuses = [&](const json& light, const std::string& element) {
        const std::string message = errorOfLight(light);
        EXPECT_NE(message.find("KHR_lights_punctual.lights[0]" + element), std::string::npos)
            << message;
    };
    refuses(3, "");
    refuses(json::object(), ".type");
    refuses({{"type", "laser"}}, ".type");
    refuses({{"type", 7}}, ".type");
    refuses({{"type", "point"}, {"intensity", -1}}, ".intensity");
    refuses({{"type", "point"}, {"intensity", 1e30}}, ".intensity");
    refuses({{"type", "point"}, {"intensity", "much"}}, ".intensity");
    refuses({{"type", "point"}, {"color", {1, -1, 1}}}, ".color");
    refuses({{"type", "point"}, {"color", {1, 1}}}, ".color");
    refuses({{"type", "spot"}}, ".spot");
    refuses({{"type", "spot"}, {"spot", {{"outerConeAngle", 4}}}}, ".outerConeAngle");
    refuses({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.9}}}}, ".spot");
    Document document = documentWith({{"type", "point"}});
    document.node()["extensions"]["KHR_lights_punctual"]["light"] = 1;
    EXPECT_NE(errorOf(document).find("lights[1] does not exist"), std::string::npos);
    document.node()["extensions"]["KHR_lights_punctual"]["light"] = -1;
    EXPECT_NE(errorOf(document).find("does not exist"), std::string::npos);
}

TEST_F(ImportGltfLight, IsLeftOutWhereItIsDarkOrHasNoDirection) {
    EXPECT_TRUE(import(documentWith({{"type", "point"}, {"intensity", 0}})).lights.empty());
    EXPECT_EQ(warningsWith("it is dark"), 1);
    Document document = documentWith({{"type", "directional"}});
    document.root["nodes"].push_back(document.node());
    document.node().erase("extensions");
    document.root["nodes"][1].erase("mesh");
    document.root["nodes"][1]["scale"] = {0, 0, 0};
    document.root["scenes"][0]["nodes"] = {0, 1};
    EXPECT_TRUE(import(document).lights.empty());
    EXPECT_EQ(warningsWith("transform is singular"), 1);
}

}  // namespace
}  // namespace vlf::test
