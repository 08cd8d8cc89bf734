#include "vlf/scene/import/gltf_material.h"

#include "vlf/scene/import/material_rules.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

namespace vlf {

namespace {

/// A metal smoother than this is a mirror (perceptual roughness of glTF).
constexpr double kMirrorRoughness = 0.05;

Vec3 toVec3(const std::vector<double>& v, const Vec3& otherwise) {
    return v.size() < 3 ? otherwise : Vec3(v[0], v[1], v[2]);
}

double number(const tinygltf::Value& object, const char* key, double otherwise) {
    if (!object.IsObject() || !object.Has(key)) return otherwise;
    const tinygltf::Value& value = object.Get(key);
    return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

/// A whole number; `otherwise` if it is none that fits.
int wholeNumber(const tinygltf::Value& object, const char* key, int otherwise) {
    const double value = number(object, key, otherwise);
    return std::abs(value) <= std::numeric_limits<int>::max() ? static_cast<int>(value) : otherwise;
}

double extensionNumber(const tinygltf::ExtensionMap& extensions, const char* extension,
                       const char* key, double otherwise) {
    const auto found = extensions.find(extension);
    return found == extensions.end() ? otherwise : number(found->second, key, otherwise);
}

Vec2 vec2(const tinygltf::Value& object, const char* key, const Vec2& otherwise) {
    if (!object.IsObject() || !object.Has(key)) return otherwise;
    const tinygltf::Value& value = object.Get(key);
    if (!value.IsArray() || value.ArrayLen() != 2 || !value.Get(0).IsNumber() ||
        !value.Get(1).IsNumber())
        return otherwise;
    return {value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble()};
}

/// KHR_texture_transform: uv' = offset + rotation * scale * uv.
GltfUvMapping uvMapping(const tinygltf::TextureInfo& info) {
    GltfUvMapping mapping;
    mapping.set = info.texCoord;
    const auto found = info.extensions.find("KHR_texture_transform");
    if (found == info.extensions.end()) return mapping;
    const tinygltf::Value& transform = found->second;
    mapping.set = wholeNumber(transform, "texCoord", mapping.set);
    mapping.offset = vec2(transform, "offset", Vec2(0));
    const Vec2 scale = vec2(transform, "scale", Vec2(1));
    const double angle = number(transform, "rotation", 0);
    const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
    mapping.scaleRotate = glm::mat2(c * scale.x, -s * scale.x, s * scale.y, c * scale.y);
    return mapping;
}

Wrap wrapOf(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

/// What the metallic-roughness model says, with KHR_materials_pbrSpecularGlossiness brought into
/// the same form (its specular part left out).
struct Surface {
    Vec3 base{1};
    double alpha = 1, metallic = 1, roughness = 1;
    tinygltf::TextureInfo baseTexture, metallicRoughnessTexture;
};

Surface specularGlossiness(const tinygltf::Value& extension) {
    Surface surface;
    surface.metallic = 0;
    if (!extension.IsObject()) return surface;
    if (extension.Has("diffuseFactor")) {
        const tinygltf::Value& factor = extension.Get("diffuseFactor");
        for (int i = 0; factor.IsArray() && i < 3 && i < static_cast<int>(factor.ArrayLen()); ++i)
            if (factor.Get(i).IsNumber())
                surface.base[i] = static_cast<float>(factor.Get(i).GetNumberAsDouble());
    }
    if (extension.Has("diffuseTexture")) {
        const tinygltf::Value& texture = extension.Get("diffuseTexture");
        surface.baseTexture.index = wholeNumber(texture, "index", -1);
        surface.baseTexture.texCoord = wholeNumber(texture, "texCoord", 0);
    }
    return surface;
}

Surface surfaceOf(const tinygltf::Material& m) {
    const auto glossiness = m.extensions.find("KHR_materials_pbrSpecularGlossiness");
    if (glossiness != m.extensions.end()) return specularGlossiness(glossiness->second);
    const auto& pbr = m.pbrMetallicRoughness;
    const double alpha = pbr.baseColorFactor.size() < 4 ? 1.0 : pbr.baseColorFactor[3];
    return {toVec3(pbr.baseColorFactor, Vec3(1)),
            alpha,
            std::clamp(pbr.metallicFactor, 0.0, 1.0),
            std::clamp(pbr.roughnessFactor, 0.0, 1.0),
            pbr.baseColorTexture,
            pbr.metallicRoughnessTexture};
}

/// Mean of the bytes of the green and blue channels as fractions: roughness and metallic.
glm::dvec2 meanGreenBlue(const DecodedImage& image) {
    glm::dvec2 sum(0);
    for (std::size_t i = 0; i + 3 < image.srgb8.size(); i += 4)
        sum += glm::dvec2(image.srgb8[i + 1], image.srgb8[i + 2]);
    return image.srgb8.empty() ? glm::dvec2(1) : sum * (4.0 / (255.0 * image.srgb8.size()));
}

class MaterialBuilder {
  public:
    MaterialBuilder(Scene& scene, const GltfFile& file, ImportReport& report)
        : scene_(scene), file_(file), report_(report) {}

    GltfMaterial add(int i) {
        const tinygltf::Material& m = file_.model.materials[i];
        const SourceLocation where = file_.at(fmt::format("materials[{}] '{}'", i, m.name));
        const Surface surface = surfaceOf(m);
        GltfMaterial result;
        if (leaveOutTransparent(opacityOf(m, surface), report_, where)) return result;
        if (m.alphaMode == "MASK" || (m.alphaMode == "BLEND" && surface.baseTexture.index >= 0))
            warn(report_, where, "alpha masks are not supported; treated as opaque");
        if (m.extensions.contains("KHR_materials_pbrSpecularGlossiness"))
            warn(report_, where, "specular-glossiness: the specular part is left out");
        if (m.normalTexture.index >= 0)
            warn(report_, where, "normal maps are not supported and left out");
        result.uv = sharedMapping(surface.baseTexture, m.emissiveTexture, where);
        Material material;
        material.name = m.name;
        setReflectance(material, surface, where);
        material.emissionTexture = loadTexture(m.emissiveTexture.index, where);
        material.emission =
            toVec3(m.emissiveFactor, Vec3(0)) *
            static_cast<float>(extensionNumber(m.extensions, "KHR_materials_emissive_strength",
                                               "emissiveStrength", 1));
        material.emitsBothSides = m.doubleSided && material.isEmitter();
        result.index = static_cast<std::uint32_t>(scene_.materials.size());
        scene_.materials.push_back(std::move(material));
        return result;
    }

  private:
    static float opacityOf(const tinygltf::Material& m, const Surface& surface) {
        const double transmission =
            extensionNumber(m.extensions, "KHR_materials_transmission", "transmissionFactor", 0);
        const double alpha = m.alphaMode == "BLEND" ? surface.alpha : 1;
        return static_cast<float>(std::min(alpha, 1 - transmission));
    }

    /// One mapping serves all textures of a material: that of the first.
    GltfUvMapping sharedMapping(const tinygltf::TextureInfo& base,
                                const tinygltf::TextureInfo& emissive,
                                const SourceLocation& where) {
        if (base.index < 0) return uvMapping(emissive);
        const GltfUvMapping mapping = uvMapping(base);
        if (emissive.index >= 0 && !(uvMapping(emissive) == mapping))
            warn(report_, where,
                 "the emissive texture has other texture coordinates than the base "
                 "colour; those of the base colour are used for both");
        return mapping;
    }

    void setReflectance(Material& material, Surface surface, const SourceLocation& where) {
        const int texture = loadTexture(surface.baseTexture.index, where);
        if (surface.metallicRoughnessTexture.index >= 0 && surface.metallic > 0) {
            const glm::dvec2 mean = meanRoughnessMetallic(surface.metallicRoughnessTexture, where);
            surface.roughness *= mean.x;
            surface.metallic *= mean.y;
        }
        const auto metallic = static_cast<float>(surface.metallic);
        material.diffuse = surface.base;
        material.diffuseTexture = texture;
        if (metallic <= 0) return;
        material.mirror = surface.base * metallic;
        material.mirrorTexture = texture;
        material.diffuse = surface.base * (1 - metallic);
        if (surface.roughness >= kMirrorRoughness)
            material.roughness = widthOfRoughness(static_cast<float>(surface.roughness));
    }

    const tinygltf::Texture& checkedTexture(int index, const SourceLocation& where) const {
        if (static_cast<std::size_t>(index) >= file_.model.textures.size())
            throw InputError(where, fmt::format("textures[{}] does not exist", index));
        return file_.model.textures[index];
    }

    /// Decodes the image of a texture; nothing (with a warning) if that is not possible.
    std::optional<DecodedImage> decode(const tinygltf::Texture& texture,
                                       const SourceLocation& where) {
        const auto& images = file_.model.images;
        if (texture.source < 0) {
            warn(report_, where, "a texture has no PNG or JPEG image; its factor alone is used");
            return std::nullopt;
        }
        if (static_cast<std::size_t>(texture.source) >= images.size())
            throw InputError(where, fmt::format("images[{}] does not exist", texture.source));
        const std::vector<std::uint8_t> bytes = imageBytes(file_, texture.source);
        if (bytes.empty()) {
            warn(report_, where,
                 fmt::format("image '{}' not found; its factor alone is used",
                             images[texture.source].uri));
            return std::nullopt;
        }
        try {
            return decodeImage(bytes, fmt::format("images[{}]", texture.source));
        } catch (const Error& error) {
            warn(report_, where, fmt::format("{}; its factor alone is used", error.what()));
            return std::nullopt;
        }
    }

    /// Index into Scene::textures; -1: none.
    int loadTexture(int index, const SourceLocation& where) {
        if (index < 0) return -1;
        const tinygltf::Texture& texture = checkedTexture(index, where);
        const bool hasSampler = texture.sampler >= 0 && static_cast<std::size_t>(texture.sampler) <
                                                            file_.model.samplers.size();
        const tinygltf::Sampler sampler =
            hasSampler ? file_.model.samplers[texture.sampler] : tinygltf::Sampler{};
        const Wrap wrapU = wrapOf(sampler.wrapS), wrapV = wrapOf(sampler.wrapT);
        const auto key = std::make_tuple(texture.source, wrapU, wrapV);
        if (const auto known = textures_.find(key); known != textures_.end()) return known->second;
        int result = -1;
        if (auto image = decode(texture, where)) {
            result = static_cast<int>(scene_.textures.size());
            scene_.textures.push_back(toTexture(std::move(*image),
                                                file_.model.images[texture.source].name, wrapU,
                                                wrapV, report_, where));
        }
        return textures_[key] = result;
    }

    glm::dvec2 meanRoughnessMetallic(const tinygltf::TextureInfo& info,
                                     const SourceLocation& where) {
        const tinygltf::Texture& texture = checkedTexture(info.index, where);
        const auto known = means_.find(texture.source);
        if (known != means_.end()) return known->second;
        const auto image = decode(texture, where);
        return means_[texture.source] = image ? meanGreenBlue(*image) : glm::dvec2(1);
    }

    Scene& scene_;
    const GltfFile& file_;
    ImportReport& report_;
    std::map<std::tuple<int, Wrap, Wrap>, int> textures_;
    std::map<int, glm::dvec2> means_;
};

}  // namespace

std::vector<GltfMaterial> addGltfMaterials(Scene& scene, const GltfFile& file,
                                           ImportReport& report) {
    MaterialBuilder builder(scene, file, report);
    std::vector<GltfMaterial> result;
    for (std::size_t i = 0; i < file.model.materials.size(); ++i)
        result.push_back(builder.add(static_cast<int>(i)));
    return result;
}

}  // namespace vlf
