// Which files an import says it has read.

#include "unit/scene/import_support.h"

namespace vlf {
namespace {

class ImportFiles : public test::ImportTest {
  protected:
    /// Names in the test's folder, sorted, of the files that importing `name` reports.
    std::vector<std::string> filesOf(const std::string& name) {
        report_ = {};
        try {
            import(path(name));
        } catch (const Error&) {
            failed_ = true;
        }
        std::vector<std::string> names;
        for (const FileStamp& file : report_.files)
            names.push_back(std::filesystem::path(file.path).lexically_relative(folder_).string());
        std::sort(names.begin(), names.end());
        return names;
    }

    using Names = std::vector<std::string>;
    bool failed_ = false;
};

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";

TEST_F(ImportFiles, OfAnObjAreItsLibrariesTexturesAndCameras) {
    write("a.obj", "mtllib a.mtl sub/b.mtl\n" + kTriangle + "usemtl m\nf 1 2 3\n");
    write("a.mtl", "newmtl m\nmap_Kd no image.png\nmap_Ke gone.png\n");
    write("sub/b.mtl", "newmtl unused\nmap_Kd unused.png\n");
    write("no image.png", "x");
    const Names expected{"a.cameras.json", "a.mtl",        "a.obj",
                         "gone.png",       "no image.png", "sub/b.mtl"};
    EXPECT_EQ(filesOf("a.obj"), expected) << "those that are missing, too";
    EXPECT_FALSE(failed_);
}

TEST_F(ImportFiles, OfAGltfAreItsBuffersAndImages) {
    write("a.gltf", R"({"asset": {"version": "2.0"},
        "buffers": [{"uri": "my%20buffer.bin", "byteLength": 4}], "images": [{"uri": "gone.png"}]})");
    write("my buffer.bin", "1234");
    EXPECT_EQ(filesOf("a.gltf"), (Names{"a.gltf", "gone.png", "my buffer.bin"}));
}

TEST_F(ImportFiles, OfAFailureAreThoseUpToIt) {
    EXPECT_EQ(filesOf("gone.obj"), Names{"gone.obj"});
    write("a.obj", "mtllib a.mtl\n" + kTriangle + "f 1 2 4\n");
    EXPECT_EQ(filesOf("a.obj"), Names{"a.obj"});
    write("a.gltf", R"({"asset": {"version": "2.0"},
        "buffers": [{"uri": "gone.bin", "byteLength": 4}]})");
    EXPECT_EQ(filesOf("a.gltf"), (Names{"a.gltf", "gone.bin"}));
    EXPECT_TRUE(failed_);
}

TEST_F(ImportFiles, AreAsTheyWereWhenTheyWereRead) {
    write("a.obj", kTriangle + "f 1 2 3\n");
    filesOf("a.obj");
    const FileStamp before = report_.files.front();
    EXPECT_EQ(before, stampOf(path("a.obj")));
    write("a.obj", kTriangle + "f 1 2 3\n\n");
    EXPECT_FALSE(before == stampOf(path("a.obj")));
}

}  // namespace
}  // namespace vlf
