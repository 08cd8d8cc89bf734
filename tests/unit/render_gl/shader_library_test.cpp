#include "vlf/render/gl/shader_library.h"

#include "vlf/base/error.h"
#include "vlf/render/gl/headless_context.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace vlf::gl::test {

namespace {

namespace fs = std::filesystem;

class ShaderFolder : public ::testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    void write(const std::string& file, const std::string& text) const {
        std::ofstream(folder_ / file) << text;
    }
    std::string messageOf(ShaderLibrary library) const {
        try {
            library.program("surface", {});
        } catch (const InputError& e) {
            return e.what();
        }
        return {};
    }

    HeadlessContext context_;
    // Tests may run at the same time.
    const fs::path folder_ = fs::path(::testing::TempDir()) /
                             (std::string("vlf_shaders_") +
                              ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

}  // namespace

TEST_F(ShaderFolder, EveryVariantOfTheBuiltInShadersCompiles) {
    ShaderLibrary library;
    const char* const field = "\"radiance_field.glsl\"";
    for (const Defines& defines :
         {Defines{}, Defines{{"DIFFUSE_MAP", 1}}, Defines{{"EMISSION", 1}},
          Defines{{"MIRROR", field}}, Defines{{"MIRROR", field}, {"PLAIN", 1}},
          Defines{{"DIFFUSE_MAP", 1}, {"EMISSION", 1}, {"MIRROR", field}},
          Defines{{"MIRROR", field}, {"OBJECTS", 1}, {"PROBES", 1}, {"SHADOWS", 1}},
          Defines{{"MIRROR", field}, {"CHANGED", 1}},
          Defines{{"MIRROR", field}, {"PLAIN", 1}, {"OBJECTS", 1}, {"PROBED", "128"}}})
        EXPECT_NE(library.program("surface", defines), 0u);
    for (const char* mirror : {"\"object_reflection.glsl\"", "\"object_probe.glsl\""})
        for (const Defines& defines :
             {Defines{{"MIRROR", mirror}, {"OBJECTS", 1}},
              Defines{{"MIRROR", mirror}, {"OBJECTS", 1}, {"SHADOWS", 1}, {"BY_TEXEL", 1}}})
            EXPECT_NE(library.program("object", defines), 0u);
}

TEST_F(ShaderFolder, AFileThereIsUsedInPlaceOfTheBuiltInOne) {
    write("surface.frag", "out vec4 color;\nvoid main() { color = vec4(1); }\n");
    EXPECT_EQ(messageOf(ShaderLibrary(folder_.string())), "");
    write("tone_map.glsl", "nonsense\n");
    EXPECT_EQ(messageOf(ShaderLibrary(folder_.string())), "") << "no longer included";
}

TEST_F(ShaderFolder, AMistakeIsReportedWithItsFileAndLine) {
    write("tone_map.glsl", "// one\nvec4 outputColor(vec3 radiance) { return nonsense; }\n");
    const std::string message = messageOf(ShaderLibrary(folder_.string()));
    EXPECT_NE(message.find("surface.frag does not compile"), std::string::npos) << message;
    EXPECT_NE(message.find("3: tone_map.glsl"), std::string::npos) << message;
    EXPECT_NE(message.find("3:2"), std::string::npos) << message;
    EXPECT_NE(message.find("nonsense"), std::string::npos) << message;
}

TEST_F(ShaderFolder, AMissingFileIsNamed) {
    write("surface.frag", "#include \"absent.glsl\"\n");
    EXPECT_NE(messageOf(ShaderLibrary(folder_.string())).find("absent.glsl"), std::string::npos);
}

}  // namespace vlf::gl::test
