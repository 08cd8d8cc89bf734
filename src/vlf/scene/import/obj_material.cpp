#include "vlf/scene/import/obj_material.h"

#include "vlf/scene/import/file_bytes.h"
#include "vlf/scene/import/material_rules.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>

namespace vlf {

namespace {

namespace fs = std::filesystem;

const Vec3 kUnknownGrey(0.5f);

/// Index of refraction of glass that says none.
constexpr float kUsualIor = 1.5f;

/// Phong exponent from which on a highlight counts as a mirror image, and the roughness (Pr) below
/// which it does.
constexpr float kMirrorExponent = 500;
constexpr float kMirrorRoughness = 0.05f;

/// The file that `name`, as written in the file `from`, means: relative to its folder, with
/// backslashes for slashes, or, of a path of another machine, the bare name.
std::optional<fs::path> findBeside(const std::string& from, std::string name) {
    const fs::path folder = fs::path(from).parent_path();
    std::vector<fs::path> candidates{folder / name};
    std::replace(name.begin(), name.end(), '\\', '/');
    candidates.push_back(folder / name);
    candidates.push_back(folder / fs::path(name).relative_path());
    candidates.push_back(folder / fs::path(name).filename());
    for (const fs::path& candidate : candidates) {
        std::error_code ignored;
        if (fs::is_regular_file(candidate, ignored)) return candidate;
    }
    return std::nullopt;
}

/// findBeside of a file that is to be read: the report notes it, or where it was expected.
std::optional<fs::path> findNoted(const std::string& from, const std::string& name,
                                  ImportReport& report) {
    const auto path = findBeside(from, name);
    noteFile(report, path ? path->string() : (fs::path(from).parent_path() / name).string());
    return path;
}

bool isPositive(const std::optional<Vec3>& colour) {
    return colour && maxComponent(*colour) > 0;
}

/// Opacity d times that of map_d from which on a surface is solid.
constexpr float kMaskThreshold = 0.5f;

/// What -imfchan says, or nothing ('\0').
AlphaSource alphaSource(char channel) {
    switch (channel) {
        case 'r':
            return AlphaSource::red;
        case 'g':
            return AlphaSource::green;
        case 'b':
            return AlphaSource::blue;
        case 'm':
            return AlphaSource::alpha;
        case 'l':
            return AlphaSource::luminance;
        default:
            return AlphaSource::alphaOrLuminance;
    }
}

enum class Specular { none, mirror, glossy };

Specular specularKind(const MtlMaterial& m) {
    if (!isPositive(m.specular) && m.specularMap.file.empty()) return Specular::none;
    const int model = m.illumination.value_or(2);
    if (model <= 1) return Specular::none;
    if (model == 3 || model == 5) return Specular::mirror;
    if (m.roughness) return *m.roughness < kMirrorRoughness ? Specular::mirror : Specular::glossy;
    return m.exponent.value_or(kMirrorExponent) < kMirrorExponent ? Specular::glossy
                                                                  : Specular::mirror;
}

bool isGlass(const MtlMaterial& m) {
    const int model = m.illumination.value_or(2);
    return model == 4 || model == 6 || model == 7 || model == 9;
}

/// A factor that the file leaves out is 1 where there is a texture, else `otherwise`.
Vec3 factorOf(const std::optional<Vec3>& factor, int texture, const Vec3& otherwise) {
    return factor.value_or(texture >= 0 ? Vec3(1) : otherwise);
}

class MaterialBuilder {
  public:
    MaterialBuilder(ImportedScene& imported, ImportReport& report)
        : scene_(imported.scene),
          masked_(imported.masked),
          glass_(imported.glass),
          report_(report) {}

    ObjMaterial add(const MtlMaterial& m) {
        const SourceLocation where{m.path, m.line, fmt::format("material '{}'", m.name)};
        ObjMaterial result;
        if (!isGlass(m) && leaveOutTransparent(m.opacity.value_or(1), report_, where))
            return result;
        setTextureTransform(result, m, where);
        Material material;
        material.name = m.name;
        material.diffuseTexture = loadTexture(m, m.diffuseMap);
        material.emissionTexture = loadTexture(m, m.emissionMap);
        const bool special = isPositive(m.specular) || isPositive(m.emission);
        material.diffuse =
            factorOf(m.diffuse, material.diffuseTexture, special ? Vec3(0) : kUnknownGrey);
        material.emission = factorOf(m.emission, material.emissionTexture, Vec3(0));
        const bool glass = isGlass(m) && !material.isEmitter();
        if (glass)
            makeGlass(material, m.filter.value_or(Vec3(1)), m.ior.value_or(kUsualIor),
                      widthOfRoughness(m.roughness.value_or(0)), report_, where);
        else
            addSpecular(material, m);
        result.index = addMaterial(std::move(material));
        if (glass) glass_.push_back(*result.index);
        if (const int mask = loadMask(m); mask >= 0)
            masked_.masks[*result.index] = {mask,
                                            kMaskThreshold / (glass ? 1 : m.opacity.value_or(1))};
        return result;
    }

    ObjMaterial addGrey(const std::string& name) {
        Material material;
        material.name = name;
        material.diffuse = kUnknownGrey;
        return {addMaterial(std::move(material)), Vec2(1), Vec2(0)};
    }

  private:
    std::uint32_t addMaterial(Material material) {
        scene_.materials.push_back(std::move(material));
        return static_cast<std::uint32_t>(scene_.materials.size() - 1);
    }

    void addSpecular(Material& material, const MtlMaterial& m) {
        const Specular kind = specularKind(m);
        if (kind == Specular::none) return;
        material.mirrorTexture = loadTexture(m, m.specularMap);
        material.mirror = factorOf(m.specular, material.mirrorTexture, Vec3(0));
        if (kind == Specular::glossy)
            material.roughness = m.roughness ? widthOfRoughness(*m.roughness)
                                             : widthOfExponent(m.exponent.value_or(0));
    }

    /// One transform serves all textures of a material: that of the first.
    void setTextureTransform(ObjMaterial& result, const MtlMaterial& m,
                             const SourceLocation& where) {
        const MtlTexture* first = nullptr;
        for (const MtlTexture* map :
             {&m.diffuseMap, &m.emissionMap, &m.specularMap, &m.opacityMap}) {
            if (map->file.empty()) continue;
            if (!first) {
                first = map;
                result.uvScale = map->scale;
                result.uvOffset = map->offset;
            } else if (map->scale != first->scale || map->offset != first->offset) {
                warn(report_, where,
                     "textures with different -s or -o options; those of the first "
                     "texture are used for all");
            }
        }
    }

    /// Index of the texture, -1 if there is none or (with a warning) it cannot be read.
    int loadTexture(const MtlMaterial& m, const MtlTexture& map) {
        if (map.file.empty()) return -1;
        const SourceLocation where{m.path, map.line, fmt::format("material '{}'", m.name)};
        const auto path = findNoted(m.path, map.file, report_);
        if (!path) {
            warn(report_, where,
                 fmt::format("texture '{}' not found; its factor alone is used", map.file));
            return -1;
        }
        const auto [entry, isNew] = textures_.try_emplace({path->string(), map.clamp}, -1);
        if (isNew) entry->second = readTexture(path->string(), map.clamp, where);
        return entry->second;
    }

    int readTexture(const std::string& path, bool clamp, const SourceLocation& where) {
        const Wrap wrap = clamp ? Wrap::clamp : Wrap::repeat;
        try {
            scene_.textures.push_back(toTexture(readTextureImage(path),
                                                fs::path(path).filename().string(), wrap, wrap,
                                                report_, where));
        } catch (const Error& error) {
            warn(report_, where, fmt::format("{}; its factor alone is used", error.what()));
            return -1;
        }
        return static_cast<int>(scene_.textures.size()) - 1;
    }

    /// Index of the alpha mask, -1 if there is none or (with a warning) it cannot be read.
    int loadMask(const MtlMaterial& m) {
        const MtlTexture& map = m.opacityMap;
        if (map.file.empty()) return -1;
        const SourceLocation where{m.path, map.line, fmt::format("material '{}'", m.name)};
        const auto path = findNoted(m.path, map.file, report_);
        if (!path) {
            warn(report_, where, fmt::format("alpha mask '{}' not found; opaque", map.file));
            return -1;
        }
        const auto key = std::tuple(path->string(), map.clamp, map.channel);
        const auto [entry, isNew] = masks_.try_emplace(key, -1);
        if (isNew) entry->second = readMask(path->string(), map, where);
        return entry->second;
    }

    int readMask(const std::string& path, const MtlTexture& map, const SourceLocation& where) {
        const Wrap wrap = map.clamp ? Wrap::clamp : Wrap::repeat;
        try {
            masked_.images.emplace_back(readTextureImage(path), alphaSource(map.channel), wrap,
                                        wrap);
        } catch (const Error& error) {
            warn(report_, where, fmt::format("{}; opaque", error.what()));
            return -1;
        }
        return static_cast<int>(masked_.images.size()) - 1;
    }

    Scene& scene_;
    MaskedMaterials& masked_;
    std::vector<std::uint32_t>& glass_;
    ImportReport& report_;
    std::map<std::pair<std::string, bool>, int> textures_;
    std::map<std::tuple<std::string, bool, char>, int> masks_;
};

/// The operand of mtllib is one name or several, each perhaps with blanks in it: the longest runs
/// of words that are files count as names.
std::vector<std::string> libraryNames(const std::string& objPath, const std::string& operand) {
    std::vector<std::string> names;
    std::string_view rest = operand;
    while (!rest.empty()) {
        std::size_t end = rest.size();
        const std::size_t firstWord = std::min(rest.find_first_of(" \t"), end);
        while (end > firstWord && !findBeside(objPath, std::string(rest.substr(0, end))))
            end = std::max(firstWord, rest.find_last_of(" \t", end - 1));
        names.emplace_back(rest.substr(0, end));
        const std::size_t next = rest.find_first_not_of(" \t", end);
        rest.remove_prefix(std::min(next, rest.size()));
    }
    return names;
}

/// The operands of mtllib, each once. Throws InputError if they hold so many words that looking for
/// files among them would take long.
std::vector<ObjName> distinctLibraries(const ObjFile& file) {
    constexpr std::ptrdiff_t kMostWords = 500;
    std::vector<ObjName> distinct;
    std::set<std::string> seen;
    std::ptrdiff_t words = 0;
    for (const ObjName& library : file.libraries) {
        if (!seen.insert(library.name).second) continue;
        words += 1 + std::count_if(library.name.begin(), library.name.end(),
                                   [](char c) { return c == ' ' || c == '\t'; });
        if (words > kMostWords)
            throw InputError({file.path, library.line, ""},
                             fmt::format("mtllib names more than {} material libraries; put the "
                                         "materials into fewer",
                                         kMostWords));
        distinct.push_back(library);
    }
    return distinct;
}

/// All materials of the file's libraries by name; the first of a name counts.
std::unordered_map<std::string, MtlMaterial> readLibraries(const ObjFile& file,
                                                           ImportReport& report) {
    std::unordered_map<std::string, MtlMaterial> materials;
    for (const ObjName& library : distinctLibraries(file)) {
        for (const std::string& name : libraryNames(file.path, library.name)) {
            const auto path = findNoted(file.path, name, report);
            if (!path) {
                warn(report, {file.path, library.line, ""},
                     fmt::format("material library '{}' not found", name));
                continue;
            }
            for (MtlMaterial& m : parseMtl(path->string(), readFileText(path->string()), report))
                materials.try_emplace(m.name, m);
        }
    }
    return materials;
}

}  // namespace

std::vector<ObjMaterial> addObjMaterials(ImportedScene& imported, const ObjFile& file,
                                         ImportReport& report) {
    const auto library = readLibraries(file, report);
    MaterialBuilder builder(imported, report);
    std::vector<ObjMaterial> result;
    for (const ObjName& used : file.materials) {
        const auto found = library.find(used.name);
        if (found == library.end())
            warn(report, {file.path, used.line, ""},
                 fmt::format("unknown material '{}': grey of reflectance 0.5 is used", used.name));
        result.push_back(found == library.end() ? builder.addGrey(used.name)
                                                : builder.add(found->second));
    }
    const bool needsDefault = std::any_of(file.faces.begin(), file.faces.end(),
                                          [](const ObjFace& face) { return face.material < 0; });
    result.push_back(needsDefault ? builder.addGrey("default") : ObjMaterial{});
    return result;
}

}  // namespace vlf
