#pragma once
// Scene files for the import tests, written into a folder of their own.

#include "vlf/base/error.h"
#include "vlf/scene/import/import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace vlf::test {

/// A folder that is empty at the beginning of each test and gone at its end.
class ImportTest : public ::testing::Test {
  protected:
    void SetUp() override {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        std::string name = std::string(info->test_suite_name()) + "-" + info->name();
        std::replace(name.begin(), name.end(), '/', '-');
        folder_ = std::filesystem::temp_directory_path() / ("vlf-import-" + name);
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    std::string write(const std::string& name, const std::string& content) const {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return path(name);
    }

    Scene import(const std::string& file) { return importScene({file}, report_); }

    /// The message of the InputError that importing the file must throw; fails the test otherwise.
    std::string errorOf(const std::string& file) {
        try {
            import(file);
        } catch (const InputError& error) {
            return error.what();
        }
        ADD_FAILURE() << file << " was imported without an InputError";
        return {};
    }

    int warningsWith(const std::string& text) const {
        return static_cast<int>(
            std::count_if(report_.warnings.begin(), report_.warnings.end(),
                          [&](const std::string& w) { return w.find(text) != std::string::npos; }));
    }

    std::filesystem::path folder_;
    ImportReport report_;
};

inline float totalArea(const Scene& scene) {
    float sum = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) sum += area(scene, t);
    return sum;
}

inline const Material* findMaterial(const Scene& scene, const std::string& name) {
    for (const Material& m : scene.materials)
        if (m.name == name) return &m;
    return nullptr;
}

inline void expectNear(const Vec3& a, const Vec3& b, float tolerance = 1e-5f) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

}  // namespace vlf::test
