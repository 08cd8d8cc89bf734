#include "unit/scene/import_support.h"
#include "vlf/image/image_io.h"

namespace vlf {
namespace {

/// Materials of MTL files: each test describes one.
class ImportMtl : public test::ImportTest {
  protected:
    Material importMaterial(const std::string& statements) {
        write("m.mtl", "newmtl paint\n" + statements);
        scene_ = import(write(
            "a.obj",
            "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 4\nusemtl paint\nf 1 2 3\n"));
        const Material* paint = test::findMaterial(scene_, "paint");
        return paint ? *paint : Material{};
    }

    Scene scene_;
};

TEST_F(ImportMtl, IsDiffuseWithoutSpecularReflectance) {
    const Material m = importMaterial("Kd 0.6 0.5 0.4\nKs 0 0 0\nNs 10\nillum 2\n");
    test::expectNear(m.diffuse, {0.6f, 0.5f, 0.4f});
    EXPECT_FALSE(m.isMirror());
    EXPECT_FALSE(m.isEmitter());
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportMtl, EmitsNoMoreThanCanBeReckonedWith) {
    const Material m = importMaterial("Ke 1e29 3 0\n");
    EXPECT_EQ(m.emission, Vec3(1e9f, 3, 0));
    EXPECT_EQ(warningsWith("material 'paint': emits more than"), 1);
}

TEST_F(ImportMtl, IsAMirrorIfTheIlluminationModelSaysSo) {
    for (const char* model : {"3", "5"}) {
        const Material m =
            importMaterial(std::string("Kd 0.3 0.3 0.3\nKs 0.5 0.4 0.3\nNs 20\nillum ") + model);
        test::expectNear(m.diffuse, Vec3(0.3f));
        test::expectNear(m.mirror, {0.5f, 0.4f, 0.3f});
    }
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportMtl, IsAMirrorIfNothingMakesItRough) {
    for (const char* rest : {"", "illum 2\nNs 1000\n", "illum 2\nPr 0\nNs 10\n"})
        test::expectNear(importMaterial(std::string("Kd 0 0 0\nKs 0.9 0.9 0.9\n") + rest).mirror,
                         Vec3(0.9f));
}

TEST_F(ImportMtl, HasNoHighlightInTheLambertianModels) {
    for (const char* model : {"0", "1"})
        EXPECT_FALSE(importMaterial(std::string("Kd 0.5 0.5 0.5\nKs 0.4 0.4 0.4\nillum ") + model)
                         .isMirror());
    EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(ImportMtl, MakesGlossyReflectionARoughMirror) {
    const std::pair<const char*, float> rough[] = {
        {"Ns 98\n", std::sqrt(0.02f)}, {"Ns 1000\nPr 0.3\n", 0.09f}, {"Ns 0\n", 1}};
    for (const auto& [rest, width] : rough) {
        report_ = {};
        const Material m =
            importMaterial(std::string("Kd 0.5 0.5 0.5\nKs 0.1 0.2 0.3\nillum 2\n") + rest);
        test::expectNear(m.diffuse, Vec3(0.5f));
        test::expectNear(m.mirror, {0.1f, 0.2f, 0.3f});
        EXPECT_FLOAT_EQ(m.roughness, width);
        EXPECT_TRUE(report_.warnings.empty());
    }
}

TEST_F(ImportMtl, ScalesReflectancesThatSumToMoreThanOne) {
    const Material m = importMaterial("Kd 0.8 0.4 0.2\nKs 0.8 0.8 0.8\nillum 3\n");
    test::expectNear(m.diffuse, Vec3(0.5f, 0.25f, 0.125f));
    test::expectNear(m.mirror, Vec3(0.5f));
    EXPECT_EQ(warningsWith("'paint': reflects 1.60 times"), 1);
}

TEST_F(ImportMtl, RepairsUnusableValues) {
    const Material m = importMaterial("Kd 0.5 -0.5 0.5\nKe -1 nan 0\nNs -5\nillum 99\nd 2\n");
    test::expectNear(m.diffuse, {0.5f, 0, 0.5f});
    test::expectNear(m.emission, Vec3(0));
    EXPECT_EQ(warningsWith("m.mtl:3: 'nan'"), 1);
    EXPECT_EQ(warningsWith("m.mtl:5: unknown illumination model '99'"), 1);
    EXPECT_EQ(warningsWith("negative"), 1);
}

TEST_F(ImportMtl, EmitsKeTimesItsTexture) {
    writePng(path("t.png"), Image(2, 2, Vec3(0, 1, 0)));
    importMaterial("Ke 4 5 6\nmap_Ke t.png\n");
    const Material* paint = test::findMaterial(scene_, "paint");
    test::expectNear(emittedRadiance(scene_, *paint, Vec2(0)), {0, 5, 0});
    test::expectNear(paint->diffuse, Vec3(0));
    EXPECT_FALSE(paint->emitsBothSides);
}

TEST_F(ImportMtl, TakesATextureAloneAsItsReflectance) {
    writePng(path("t.png"), Image(2, 2, Vec3(1, 0, 1)));
    importMaterial("map_Kd t.png\n");
    test::expectNear(diffuseReflectance(scene_, *test::findMaterial(scene_, "paint"), Vec2(0)),
                     {1, 0, 1});
}

TEST_F(ImportMtl, LeavesOutWhatIsTransparentWithoutBeingGlass) {
    for (const char* clear : {"d 0.1\n", "Tr 0.9\n"}) {
        report_ = {};
        importMaterial(std::string("Kd 0 0 0\nKs 1 1 1\n") + clear);
        EXPECT_EQ(scene_.triangles.size(), 1u) << clear;
        EXPECT_EQ(warningsWith("material 'paint': transparency is not supported"), 1) << clear;
    }
}

TEST_F(ImportMtl, MakesTheModelsOfGlassGlass) {
    for (const char* model : {"4", "6", "7", "9"}) {
        const Material m = importMaterial(
            std::string("Kd 0.5 0.5 0.5\nKs 1 1 1\nTf 0.9 0.8 0.7\nNi 1.33\nd 0.1\nillum ") +
            model);
        test::expectNear(m.transmission, {0.9f, 0.8f, 0.7f});
        EXPECT_FLOAT_EQ(m.ior, 1.33f);
        EXPECT_TRUE(m.isPane());
        EXPECT_EQ(maxComponent(m.diffuse + m.mirror), 0);
    }
    EXPECT_TRUE(report_.warnings.empty());
    const Material plain = importMaterial("illum 7\n");
    EXPECT_EQ(plain.transmission, Vec3(1));
    EXPECT_FLOAT_EQ(plain.ior, 1.5f);
}

TEST_F(ImportMtl, LimitsTheIndexOfRefraction) {
    EXPECT_FLOAT_EQ(importMaterial("illum 7\nNi 0.5\n").ior, 1);
    EXPECT_EQ(warningsWith("index of refraction 0.5 is limited to 1 to 4"), 1);
}

TEST_F(ImportMtl, WarnsOfRoughGlass) {
    EXPECT_TRUE(importMaterial("illum 7\nPr 0.3\n").isGlass());
    EXPECT_EQ(warningsWith("rough glass is shown as smooth"), 1);
}

TEST_F(ImportMtl, TakesGlassThatEmitsForALamp) {
    const Material m = importMaterial("Ke 1 1 1\nillum 7\n");
    EXPECT_TRUE(m.isEmitter());
    EXPECT_FALSE(m.isGlass());
}

TEST_F(ImportMtl, MakesClosedGlassSolid) {
    write("m.mtl", "newmtl glass\nillum 7\nTf 0.25 0.25 0.25\n");
    const Scene scene =
        import(write("a.obj",
                     "mtllib m.mtl\nusemtl glass\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                     "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"));
    EXPECT_TRUE(scene.material(0).isSolidGlass());
    test::expectNear(scene.material(0).transmission, Vec3(0.5f));
}

TEST_F(ImportMtl, PrefersDToTr) {
    importMaterial("Kd 0.5 0.5 0.5\nd 1\nTr 1\n");
    EXPECT_EQ(scene_.triangles.size(), 2u);
    importMaterial("Kd 0.5 0.5 0.5\nTr 1\nd 1\n");
    EXPECT_EQ(scene_.triangles.size(), 2u);
    EXPECT_TRUE(report_.warnings.empty());
}

/// A mask whose left half is transparent, on a unit square.
class ImportMask : public test::ImportTest {
  protected:
    float solidArea(const std::string& statements) {
        Image half(32, 32, Vec3(1));
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 16; ++x) half.at(x, y) = Vec3(0);
        writePng(path("half.png"), half);
        write("m.mtl", "newmtl paint\nKd 0.5 0.5 0.5\n" + statements);
        return test::totalArea(
            import(write("a.obj",
                         "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\n"
                         "vt 1 1\nvt 0 1\nusemtl paint\nf 1/1 2/2 3/3 4/4\n")));
    }
};

TEST_F(ImportMask, CutsHolesByTheLuminanceOfMapD) {
    EXPECT_NEAR(solidArea("map_d -clamp on half.png\n"), 0.5f, 0.01f);
    EXPECT_EQ(warningsWith("alpha masks: 2 triangles are cut into"), 1);
    EXPECT_TRUE(std::any_of(report_.files.begin(), report_.files.end(),
                            [](const FileStamp& f) { return f.path.ends_with("half.png"); }));
}

TEST_F(ImportMask, TakesTheChannelOfImfchan) {
    EXPECT_NEAR(solidArea("map_d -clamp on -imfchan g half.png\n"), 0.5f, 0.01f);
    EXPECT_NEAR(solidArea("map_d -clamp on -imfchan m half.png\n"), 1.0f, 0.0f);
}

TEST_F(ImportMask, AppliesItsTextureTransform) {
    EXPECT_NEAR(solidArea("map_d -clamp on -s 0.5 1 1 -o 0.3 0 0 half.png\n"), 0.6f, 0.01f);
    EXPECT_NEAR(solidArea("map_d -clamp on -o 0.25 0 0 half.png\n"), 0.75f, 0.01f);
}

TEST_F(ImportMask, WarnsOfMasksThatAreMissing) {
    EXPECT_EQ(solidArea("map_d leaf.png\n"), 1.0f);
    EXPECT_EQ(warningsWith("'paint': alpha mask 'leaf.png' not found; opaque"), 1);
}

TEST_F(ImportMask, IsNoMatterOfTheDiffuseTexture) {
    EXPECT_EQ(solidArea("map_Kd half.png\n"), 1.0f);
}

}  // namespace
}  // namespace vlf
