#include "vlf/scene/export_obj.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"
#include "vlf/image/image_io.h"

#include <cctype>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vlf {

namespace {

namespace fs = std::filesystem;

using Text = fmt::memory_buffer;

template <class... Args>
void print(Text& out, fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

/// Makes names usable as a word of the file or as a file name, and each unique.
class UniqueNames {
  public:
    std::string operator()(std::string name, const std::string& otherwise) {
        for (char& c : name)
            if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_') c = '-';
        if (name.empty()) name = otherwise;
        std::string unique = name;
        for (int i = 2; !used_.insert(unique).second; ++i) unique = fmt::format("{}-{}", name, i);
        return unique;
    }

  private:
    std::set<std::string> used_;
};

void checkRepresentable(const Scene& scene) {
    for (const Material& m : scene.materials)
        if (m.emitsBothSides)
            throw InputError(fmt::format(
                "material '{}' emits on both sides, which OBJ cannot say; give it two surfaces",
                m.name));
    for (const Texture& t : scene.textures)
        if (t.wrapU != t.wrapV || t.wrapU == Wrap::mirror)
            throw InputError(fmt::format(
                "texture '{}' wraps in a way that OBJ cannot say; use repeat or clamp", t.name));
}

std::vector<std::string> materialNames(const Scene& scene) {
    UniqueNames unique;
    std::vector<std::string> names;
    for (const Material& m : scene.materials) names.push_back(unique(m.name, "material"));
    return names;
}

std::vector<std::string> textureFiles(const Scene& scene, const std::string& sceneName) {
    UniqueNames unique;
    std::vector<std::string> files;
    for (const Texture& t : scene.textures)
        files.push_back(fmt::format("{}-{}.{}", sceneName,
                                    unique(fs::path(t.name).stem().string(), "texture"),
                                    t.linear.empty() ? "png" : "exr"));
    return files;
}

void writeTexture(const Texture& texture, const std::string& path) {
    Image image(texture.width, texture.height);
    for (int y = 0; y < texture.height; ++y)
        for (int x = 0; x < texture.width; ++x) image.at(x, y) = texture.pixel(x, y);
    texture.linear.empty() ? writePng(path, image) : writeExr(path, image);
}

void printMap(Text& out, const char* statement, const Scene& scene, int texture,
              const std::vector<std::string>& files) {
    if (texture < 0) return;
    const bool clamp = scene.textures[texture].wrapU == Wrap::clamp;
    print(out, "{} {}{}\n", statement, clamp ? "-clamp on " : "", files[texture]);
}

void printColour(Text& out, const char* statement, const Vec3& c) {
    print(out, "{} {} {} {}\n", statement, c.x, c.y, c.z);
}

Text materialText(const Scene& scene, const std::vector<std::string>& names,
                  const std::vector<std::string>& files) {
    constexpr int kIllumDiffuse = 1, kIllumGlossy = 2, kIllumMirror = 3, kIllumGlass = 7;
    Text out;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        const int model = m.isGlass()    ? kIllumGlass
                          : m.isGlossy() ? kIllumGlossy
                          : m.isMirror() ? kIllumMirror
                                         : kIllumDiffuse;
        print(out, "newmtl {}\nillum {}\n", names[i], model);
        printColour(out, "Kd", m.diffuse);
        printMap(out, "map_Kd", scene, m.diffuseTexture, files);
        if (m.isGlossy()) print(out, "Pr {}\n", std::sqrt(m.roughness));
        if (m.isMirror()) {
            printColour(out, "Ks", m.mirror);
            printMap(out, "map_Ks", scene, m.mirrorTexture, files);
        }
        if (m.isGlass()) {
            // A body's filter is that of both its surfaces.
            printColour(out, "Tf", m.thin ? m.transmission : m.transmission * m.transmission);
            print(out, "Ni {}\n", m.ior);
        }
        if (m.isEmitter()) {
            printColour(out, "Ke", m.emission);
            printMap(out, "map_Ke", scene, m.emissionTexture, files);
        }
        print(out, "\n");
    }
    return out;
}

void printTriangles(Text& out, const Scene& scene, const Mesh& mesh,
                    const std::vector<std::string>& materials) {
    const Triangle* previous = nullptr;
    for (std::uint32_t i = 0; i < mesh.triangleCount; ++i) {
        const Triangle& t = scene.triangles[mesh.firstTriangle + i];
        if (!previous || previous->material != t.material)
            print(out, "usemtl {}\n", materials[t.material]);
        previous = &t;
        print(out, "f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", t.vertex[0] + 1, t.vertex[1] + 1,
              t.vertex[2] + 1);
    }
}

Text geometryText(const Scene& scene, const std::string& name,
                  const std::vector<std::string>& materials) {
    Text out;
    print(out, "mtllib {}.mtl\n", name);
    for (const Vec3& p : scene.positions) print(out, "v {} {} {}\n", p.x, p.y, p.z);
    for (const Vec2& uv : scene.uvs) print(out, "vt {} {}\n", uv.x, uv.y);
    for (const Vec3& n : scene.normals) print(out, "vn {} {} {}\n", n.x, n.y, n.z);
    UniqueNames unique;
    for (const Mesh& mesh : scene.meshes) {
        print(out, "o {}\n", unique(mesh.name, "mesh"));
        printTriangles(out, scene, mesh, materials);
    }
    return out;
}

/// The shortest decimal number that reads back as `value`.
nlohmann::ordered_json toJson(float value) {
    return nlohmann::ordered_json::parse(fmt::format("{}", value));
}

nlohmann::ordered_json toJson(const Vec3& v) {
    return {toJson(v.x), toJson(v.y), toJson(v.z)};
}

Text cameraText(const std::vector<Camera>& cameras) {
    auto list = nlohmann::ordered_json::array();
    for (const Camera& c : cameras)
        list.push_back({{"name", c.name},
                        {"eye", toJson(c.eye)},
                        {"look", toJson(c.look)},
                        {"up", toJson(c.up)},
                        {"verticalFov", toJson(c.verticalFov)}});
    Text out;
    print(out, "{}\n", nlohmann::ordered_json{{"cameras", list}}.dump(2));
    return out;
}

void writeText(const fs::path& path, const Text& text) {
    writeFile(path.string(), {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace

void exportObj(const Scene& scene, const std::string& folder, const std::string& name) {
    checkRepresentable(scene);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw FileError(folder, "cannot make this folder: " + error.message());

    const fs::path base = fs::path(folder) / name;
    const std::vector<std::string> files = textureFiles(scene, name);
    for (std::size_t i = 0; i < files.size(); ++i)
        writeTexture(scene.textures[i], (fs::path(folder) / files[i]).string());
    const std::vector<std::string> materials = materialNames(scene);
    writeText(base.string() + ".mtl", materialText(scene, materials, files));
    if (!scene.cameras.empty())
        writeText(base.string() + ".cameras.json", cameraText(scene.cameras));
    writeText(base.string() + ".obj", geometryText(scene, name, materials));
}

}  // namespace vlf
