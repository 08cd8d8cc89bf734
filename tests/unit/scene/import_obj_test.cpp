#include "unit/scene/import_support.h"

#include "vlf/image/image_io.h"

namespace vlf {
namespace {

class ImportObj : public test::ImportTest {};

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(ImportObj, TriangulatesPolygonsKeepingTheirWinding) {
    const Scene scene = import(write("a.obj", kSquare + "f 1 2 3 4\n"));
    ASSERT_EQ(scene.triangles.size(), 2u);
    EXPECT_EQ(scene.positions.size(), 4u);
    EXPECT_NEAR(test::totalArea(scene), 1, 1e-6);
    for (std::uint32_t t = 0; t < 2; ++t) test::expectNear(geometricNormal(scene, t), {0, 0, 1});
}

TEST_F(ImportObj, CountsNegativeIndicesFromTheLatestVertexBack) {
    const Scene scene = import(write("a.obj", kSquare + "f -4 -3 -2 -1\nv 5 5 5\n"));
    EXPECT_NEAR(test::totalArea(scene), 1, 1e-6);
    EXPECT_EQ(scene.positions.size(), 4u) << "the unused vertex must go";
}

TEST_F(ImportObj, ReadsEveryKindOfLineEnd) {
    const std::string unix = kSquare + "f 1 2 \\\n 3 4";
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        std::string text = "\xef\xbb\xbf";
        for (const char c : unix) text += c == '\n' ? end : std::string(1, c);
        EXPECT_NEAR(test::totalArea(import(write("a.obj", text))), 1, 1e-6) << int(end[0]);
    }
}

TEST_F(ImportObj, ReadsNumbersAsExportersWriteThem) {
    const Scene scene = import(
        write("a.obj",
              "v .0 -.0 +0\nv\t1.E0   0. 0e+007\nv 10e-1 100E-002 0 0.5 0.5 0.5\nf 1// 2// 3//\n"));
    EXPECT_NEAR(test::totalArea(scene), 0.5, 1e-6);
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportObj, RejectsNumbersThatAreNotFiniteWithTheirLine) {
    for (const char* word : {"nan", "-inf", "1e400", "1.#QNAN", "-1.#IND", "1e39", "x", ""}) {
        const std::string file = write("a.obj", kSquare + "v 0 0 " + word + "\nf 1 2 3\n");
        EXPECT_NE(errorOf(file).find("a.obj:5:"), std::string::npos) << word;
    }
    EXPECT_NE(errorOf(write("b.obj", kSquare + "vn 0 nan 1\nf 1 2 3\n")).find("b.obj:5:"),
              std::string::npos);
}

TEST_F(ImportObj, RejectsIndicesOutOfRangeWithTheirLine) {
    for (const char* face : {"f 1 2 5", "f 0 1 2", "f -5 1 2", "f 1 2 99999999999999999999",
                             "f 1 2 3x", "f /1 2 3", "f 1/1/1/1 2 3"}) {
        const std::string file = write("a.obj", kSquare + "# comment\n" + face + "\n");
        EXPECT_NE(errorOf(file).find("a.obj:6:"), std::string::npos) << face;
    }
}

TEST_F(ImportObj, TakesMissingTextureCoordinatesAndNormalsAsNotGiven) {
    const Scene scene = import(write("a.obj", kSquare + "vt 1 1\nf 1/1/1 2/-2/0 3/9/-1\n"));
    test::expectNear(scene.normals[0], {0, 0, 1});
    EXPECT_EQ(warningsWith("a.obj:6: indices of texture coordinates"), 1);
    EXPECT_EQ(warningsWith("a.obj:6: indices of normals"), 1);
}

TEST_F(ImportObj, RefusesCoordinatesOfFacesThatAreAbsurdlyLarge) {
    EXPECT_NE(errorOf(write("a.obj", kSquare + "v 0 1e10 0\nv 1e10 0 0\nf 1 6 5\n"))
                  .find("scale the scene"),
              std::string::npos);
    EXPECT_EQ(import(write("b.obj", kSquare + "v 0 1e10 0\nf 1 2 3\n")).triangles.size(), 1u);
}

TEST_F(ImportObj, GivesFacesWithoutNormalsFlatOnes) {
    const Scene scene =
        import(write("a.obj", kSquare + "v 0 0 1\nv 1 0 1\nf 1 2 3 4\nf 2 1 5 6\n"));
    EXPECT_EQ(scene.positions.size(), 8u) << "vertices of the edge must not be shared";
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        for (const std::uint32_t v : scene.triangles[t].vertex)
            test::expectNear(scene.normals[v], geometricNormal(scene, t));
}

TEST_F(ImportObj, SmoothsWithinASmoothingGroupOnly) {
    // Three squares round a corner: two in group 1 meet in the x axis, one in group 2.
    const std::string text = kSquare +
                             "v 0 0 1\nv 1 0 1\nv 0 1 1\n"
                             "s 1\nf 1 2 3 4\nf 1 5 6 2\ns 2\nf 1 4 7 5\ns off\n";
    const Scene scene = import(write("a.obj", text));
    EXPECT_EQ(scene.positions.size(), 6u + 4u);
    const float half = std::sqrt(0.5f);
    int smoothed = 0;
    for (std::size_t v = 0; v < scene.positions.size(); ++v)
        if (glm::distance(scene.normals[v], Vec3(0, half, half)) < 1e-5f) ++smoothed;
    EXPECT_EQ(smoothed, 2);
}

TEST_F(ImportObj, WeighsSmoothNormalsByArea) {
    const Scene scene = import(write("a.obj",
                                     "v 0 0 0\nv 1 0 0\nv 1 3 0\nv 0 3 0\nv 0 0 1\nv 1 0 1\n"
                                     "s 1\nf 1 2 3 4\nf 1 5 6 2\n"));
    for (std::size_t v = 0; v < scene.positions.size(); ++v) {
        if (scene.positions[v] == Vec3(0))
            test::expectNear(scene.normals[v], glm::normalize(Vec3(0, 1, 3)));
    }
}

TEST_F(ImportObj, KeepsGivenNormalsAtUnitLength) {
    const Scene scene = import(
        write("a.obj", kSquare + "vn 0 3 4\nvn 0 0 0\nf 1//1 2//1 3//1\nf 1//2 3//2 4//2\n"));
    ASSERT_EQ(scene.normals.size(), 6u);
    test::expectNear(scene.normals[0], {0, 0.6f, 0.8f});
    test::expectNear(scene.normals[3], {0, 0, 1});
}

TEST_F(ImportObj, SkipsWhatIsNotAFaceAndSaysSo) {
    const Scene scene = import(write("a.obj", kSquare + "l 1 2\np 1\nf 1 2\nf 1 2 3\ng\nvp 1 2\n"));
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(warningsWith("a.obj:5: lines and points skipped (2 of them)"), 1);
    EXPECT_EQ(warningsWith("a.obj:7: faces of fewer than three corners"), 1);
}

TEST_F(ImportObj, NamesMeshesAfterObjectsAndGroups) {
    const Scene scene =
        import(write("room.obj", kSquare + "f 1 2 3\no table\nf 1 3 4\ng unused\n"));
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[0].name, "room");
    EXPECT_EQ(scene.meshes[1].name, "table");
    EXPECT_EQ(scene.meshes[1].firstTriangle, 1u);
    EXPECT_EQ(scene.meshes[1].triangleCount, 1u);
}

TEST_F(ImportObj, ReportsUnknownMaterialsAndMissingLibrariesWithTheirLine) {
    const Scene scene =
        import(write("a.obj", "mtllib gone.mtl\n" + kSquare + "usemtl brick\nf 1 2 3 4\n"));
    EXPECT_EQ(warningsWith("a.obj:1: material library 'gone.mtl' not found"), 1);
    EXPECT_EQ(warningsWith("a.obj:6: unknown material 'brick'"), 1);
    test::expectNear(scene.material(0).diffuse, Vec3(0.5f));
}

TEST_F(ImportObj, FindsLibrariesWithBlanksBackslashesAndSeveralNames) {
    write("sub/my room.mtl", "newmtl a\nKd 0.1 0.2 0.3\n");
    write("my other room.mtl", "newmtl d\nKd 0.2\n");
    write("one.mtl", "newmtl b\nKd 0.4 0.5 0.6\n");
    write("two.mtl", "  newmtl  c \nKd 0.7\n");
    const Scene scene = import(write(
        "a.obj",
        "mtllib sub\\my room.mtl\nmtllib one.mtl my other room.mtl two.mtl\n" + kSquare +
            "usemtl a\nf 1 2 3\nusemtl\t b \nf 1 3 4\nusemtl c\nf 1 2 4\nusemtl d\nf 2 3 4\n"));
    ASSERT_EQ(scene.materials.size(), 4u);
    test::expectNear(scene.materials[0].diffuse, {0.1f, 0.2f, 0.3f});
    test::expectNear(scene.materials[1].diffuse, {0.4f, 0.5f, 0.6f});
    test::expectNear(scene.materials[2].diffuse, Vec3(0.7f));
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportObj, RefusesCountlessLibraries) {
    std::string words, lines;
    for (int i = 0; i < 501; ++i) words += "a ";
    for (int i = 0; i < 501; ++i) lines += "mtllib " + std::to_string(i) + "\n";
    for (const std::string& text : {"mtllib " + words + "b\n", lines})
        EXPECT_NE(errorOf(write("a.obj", text + kSquare + "f 1 2 3\n")).find("mtllib names more"),
                  std::string::npos);
}

TEST_F(ImportObj, TakesALibraryThatIsNamedAgainAndAgainAsOne) {
    std::string lines;
    for (int i = 0; i < 2000; ++i) lines += "mtllib a.mtl\n";
    write("a.mtl", "newmtl a\nKd 1e99 1 1\nKd 0.3 0.3 0.3\n");
    const Scene scene = import(write("a.obj", lines + "usemtl a\n" + kSquare + "f 1 2 3\n"));
    test::expectNear(scene.material(0).diffuse, Vec3(0.3f));
}

TEST_F(ImportObj, MakesAThousandRemarksAtMost) {
    std::string materials;
    for (int i = 0; i < 1500; ++i) materials += "usemtl m" + std::to_string(i) + "\n";
    import(write("a.obj", kSquare + materials + "f 1 2 3\n"));
    ASSERT_EQ(report_.warnings.size(), 1001u);
    EXPECT_NE(report_.warnings.back().find("further remarks are left out"), std::string::npos);
}

TEST_F(ImportObj, KeepsTheMaterialAcrossObjects) {
    write("m.mtl", "newmtl a\nKd 0.1 0.2 0.3\n");
    const Scene scene =
        import(write("a.obj", "mtllib m.mtl\nusemtl a\no thing\n" + kSquare + "f 1 2 3\n"));
    EXPECT_EQ(scene.material(0).name, "a");
}

TEST_F(ImportObj, RefusesTextThatIsNotEightBit) {
    EXPECT_NE(errorOf(write("a.obj", std::string("\xff\xfev\0 \0", 6))).find("UTF-16"),
              std::string::npos);
    EXPECT_NE(errorOf(write("b.obj", std::string("v 0 0 0\n\0\0", 10))).find("binary"),
              std::string::npos);
}

TEST_F(ImportObj, RefusesScenesWithoutArea) {
    for (const std::string& text : {std::string(), kSquare, kSquare + "f 1 2 2\nf 1 1 1\n"})
        EXPECT_NE(errorOf(write("a.obj", text)).find("no triangle"), std::string::npos);
}

TEST_F(ImportObj, SaysWhichFileCannotBeRead) {
    EXPECT_THROW(import(path("none.obj")), FileError);
    EXPECT_THROW(import(folder_.string() + "/"), Error);
    EXPECT_NE(errorOf(write("a.fbx", "x")).find(".fbx"), std::string::npos);
}

TEST_F(ImportObj, MergesSceneFiles) {
    const std::string room = write("room.obj", kSquare + "f 1 2 3\n");
    write("lights.mtl", "newmtl lamp\nKe 5 5 5\n");
    const std::string lights =
        write("lights.obj", "mtllib lights.mtl\nusemtl lamp\nv 0 0 1\nv 1 0 1\nv 1 1 1\nf 1 2 3\n");
    const Scene scene = importScene({room, lights}, report_);
    ASSERT_EQ(scene.triangles.size(), 2u);
    EXPECT_FALSE(scene.material(0).isEmitter());
    EXPECT_TRUE(scene.material(1).isEmitter());
}

TEST_F(ImportObj, GivesTheSameSceneEveryTime) {
    std::string text = kSquare + "s 1\n";
    for (int i = 0; i < 50; ++i) text += "v 0 " + std::to_string(i) + " 2\nf 1 2 -1\nf 3 4 -1\n";
    const Scene a = import(write("a.obj", text)), b = import(path("a.obj"));
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.normals, b.normals);
}

TEST_F(ImportObj, LoadsTexturesWithBlanksInTheirNamesOnce) {
    writePng(path("my picture.png"), Image(2, 2, Vec3(1, 0, 0)));
    write("m.mtl",
          "newmtl a\nmap_Kd my picture.png\nnewmtl b\nKe 3 3 3\nmap_Ke .\\my picture.png\n");
    const Scene scene =
        import(write("a.obj", "mtllib m.mtl\nusemtl a\n" + kSquare +
                                  "vt 0 0\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 3/1 4/1\n"));
    test::expectNear(diffuseReflectance(scene, scene.material(0), Vec2(0)), {1, 0, 0});
    test::expectNear(emittedRadiance(scene, scene.material(1), Vec2(0)), {3, 0, 0});
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportObj, BakesTextureOptionsIntoTheCoordinates) {
    writePng(path("t.png"), Image(2, 2, Vec3(1)));
    write("m.mtl",
          "newmtl a\nmap_Kd -blendu on -s 2 3 1 -o 0.5 0.25 -clamp on t.png\nnewmtl b\nmap_Kd "
          "t.png\n");
    const Scene scene =
        import(write("a.obj", "mtllib m.mtl\nusemtl a\n" + kSquare +
                                  "vt 1 1\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 3/1 4/1\n"));
    const Vec2 scaled = uvAt(scene, 0, Vec2(0)), plain = uvAt(scene, 1, Vec2(0));
    EXPECT_EQ(scaled, Vec2(2.5f, 3.25f));
    EXPECT_EQ(plain, Vec2(1, 1));
    EXPECT_EQ(scene.textures[scene.material(0).diffuseTexture].wrapU, Wrap::clamp);
    EXPECT_EQ(scene.textures[scene.material(1).diffuseTexture].wrapU, Wrap::repeat);
}

TEST_F(ImportObj, UsesTheFactorWhereATextureIsMissingOrDamaged) {
    write("bad.png", "not a picture");
    write("m.mtl",
          "newmtl a\nKd 0.3 0.3 0.3\nmap_Kd gone.png\nnewmtl b\nKd 0.4 0.4 0.4\nmap_Kd bad.png\n");
    const Scene scene = import(
        write("a.obj", "mtllib m.mtl\nusemtl a\n" + kSquare + "f 1 2 3\nusemtl b\nf 1 3 4\n"));
    test::expectNear(diffuseReflectance(scene, scene.material(0), Vec2(0)), Vec3(0.3f));
    test::expectNear(diffuseReflectance(scene, scene.material(1), Vec2(0)), Vec3(0.4f));
    EXPECT_EQ(warningsWith("m.mtl:3: material 'a': texture 'gone.png' not found"), 1);
    EXPECT_EQ(warningsWith("m.mtl:6: material 'b'"), 1);
}

TEST_F(ImportObj, ReplacesPixelsThatAreNoLight) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Image wild(2, 1);
    wild.pixels = {{-1, kInfinity, std::numeric_limits<float>::quiet_NaN()},
                   {1e38f, 0.5f, -kInfinity}};
    writeExr(path("wild.exr"), wild);
    write("m.mtl", "newmtl a\nKe 1 1 1\nmap_Ke wild.exr\n");
    const Scene scene =
        import(write("a.obj", "mtllib m.mtl\nusemtl a\n" + kSquare + "vt 0 0\nf 1/1 2/1 3/1\n"));
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].linear, (std::vector<Vec3>{{0, 1e9f, 0}, {1e9f, 0.5f, 0}}));
    EXPECT_EQ(warningsWith("m.mtl:3: material 'a': texture 'wild.exr': values that are"), 1);
}

TEST_F(ImportObj, ReplacesTextureCoordinatesThatOverflow) {
    writePng(path("t.png"), Image(2, 2, Vec3(1)));
    write("m.mtl", "newmtl a\nmap_Kd -s 1e5 1 t.png\n");
    const Scene scene = import(write(
        "a.obj", "mtllib m.mtl\nusemtl a\n" + kSquare + "vt 1e38 0\nvt 1 0\nf 1/1 2/2 3/2\n"));
    EXPECT_EQ(scene.uvs, (std::vector<Vec2>{{0, 0}, {1e5f, 0}, {1e5f, 0}}));
    EXPECT_EQ(warningsWith("texture coordinates: those that are not finite"), 1);
}

TEST_F(ImportObj, ReadsTheCamerasBesideIt) {
    write("a.cameras.json", R"({"cameras": [{"name": "front", "eye": [1, 2, 3], "look": [0, 0, 0]},
        {"name": "top", "eye": [0, 5, 0], "look": [0, 0, 0], "up": [0, 0, -1], "verticalFov": 30}]})");
    const Scene scene = import(write("a.obj", kSquare + "f 1 2 3\n"));
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "front");
    test::expectNear(scene.cameras[0].eye, {1, 2, 3});
    EXPECT_EQ(scene.cameras[0].verticalFov, 50);
    test::expectNear(scene.cameras[1].up, {0, 0, -1});
    EXPECT_EQ(scene.cameras[1].verticalFov, 30);
}

TEST_F(ImportObj, NamesTheElementOfABadCamera) {
    const std::string file = write("a.obj", kSquare + "f 1 2 3\n");
    const auto camera = [](const std::string& rest) {
        return R"({"cameras": [{"name": "a", "eye": [0, 0, 0], )" + rest + "}]}";
    };
    const std::pair<std::string, std::string> cases[] = {
        {camera(R"("look": [0, 0])"), "cameras[0].look"},
        {camera(R"("look": [0, 0, "x"])"), "cameras[0].look"},
        {camera(R"("look": [0, 0, 1], "verticalFov": 180)"), "cameras[0].verticalFov"},
        {camera(R"("look": [0, 0, 0])"), "cameras[0]"},
        {camera(R"("look": [0, 1, 0])"), "cameras[0]"},
        {camera(R"("look": [3e38, 0, 3e38])"), "cameras[0]"},
        {camera(R"("look": [0, 0, 1e-30])"), "cameras[0]"},
        {camera(R"("look": [0, 0, 1e999])"), "a.cameras.json"},
        {"[", "a.cameras.json"},
        {"[]", "a.cameras.json"}};
    for (const auto& [text, element] : cases) {
        write("a.cameras.json", text);
        EXPECT_NE(errorOf(file).find(element), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace vlf
