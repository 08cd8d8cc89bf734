#include "vlf/scene/import/gltf_material.h"

#include "vlf/scene/import/material_rules.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>

namespace vlf {

namespace {

/// A metal smoother than this is a mirror (perceptual roughness of glTF).
constexpr double kMirrorRoughness = 0.05;

/// Opacity from which on a surface that is to be blended is solid.
constexpr double kBlendCutoff = 0.5;

/// Transmission from which on a surface is glass.
constexpr double kGlassTransmission = 0.5;

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
        if (texture.Has("extensions") && texture.Get("extensions").IsObject())
            surface.baseTexture.extensions =
                texture.Get("extensions").Get<tinygltf::Value::Object>();
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

bool isKtx2(const GltfBytes& bytes) {
    constexpr std::string_view kStart = "\xabKTX 20\xbb";
    return bytes.size() >= kStart.size() &&
           std::equal(kStart.begin(), kStart.end(), bytes.begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

class MaterialBuilder {
  public:
    MaterialBuilder(Scene& scene, MaskedMaterials& masked, const GltfFile& file,
                    ImportReport& report)
        : scene_(scene), masked_(masked), file_(file), report_(report) {}

    GltfMaterial add(int i) {
        const tinygltf::Material& m = file_.model.materials[i];
        const SourceLocation where = file_.at(fmt::format("materials[{}] '{}'", i, m.name));
        const Surface surface = surfaceOf(m);
        GltfMaterial result;
        const double transmission = transmissionOf(m, surface, where);
        const bool emits = maxComponent(toVec3(m.emissiveFactor, Vec3(0))) > 0;
        const bool glass = transmission >= kGlassTransmission && !emits;
        if (!glass && !emits &&
            leaveOutTransparent(opacityOf(m, surface, transmission), report_, where))
            return result;
        if (m.extensions.contains("KHR_materials_pbrSpecularGlossiness"))
            warn(report_, where, "specular-glossiness: the specular part is left out");
        if (m.normalTexture.index >= 0)
            warn(report_, where, "normal maps are not supported and left out");
        Material material;
        material.name = m.name;
        setReflectance(material, surface, where);
        material.emissionTexture = loadTexture(m.emissiveTexture.index, where);
        material.emission =
            toVec3(m.emissiveFactor, Vec3(0)) *
            static_cast<float>(extensionNumber(m.extensions, "KHR_materials_emissive_strength",
                                               "emissiveStrength", 1));
        material.emitsBothSides = m.doubleSided && material.isEmitter();
        const GltfUvMapping baseUv = uvMapping(surface.baseTexture),
                            emissionUv = uvMapping(m.emissiveTexture);
        const bool emissionAlone = material.diffuseTexture < 0 && material.emissionTexture >= 0;
        result.uv = emissionAlone ? emissionUv : baseUv;
        if (material.emissionTexture >= 0 && !(emissionUv == result.uv))
            result.emissionUv = emissionUv;
        if (glass) setGlass(material, m, surface, static_cast<float>(transmission), where);
        const auto index = static_cast<std::uint32_t>(scene_.materials.size());
        if (!addMask(m, surface, index, where)) return result;
        result.index = index;
        scene_.materials.push_back(std::move(material));
        return result;
    }

  private:
    /// Share of the light that a surface lets through, of what it neither reflects as a metal nor
    /// as glass.
    double transmissionOf(const tinygltf::Material& m, const Surface& surface,
                          const SourceLocation& where) {
        const auto found = m.extensions.find("KHR_materials_transmission");
        if (found == m.extensions.end()) return 0;
        const double factor = std::clamp(number(found->second, "transmissionFactor", 0), 0.0, 1.0);
        return factor * (1 - surface.metallic) * meanRed(found->second, where);
    }

    /// Mean of the transmission texture; 1 if there is none.
    double meanRed(const tinygltf::Value& extension, const SourceLocation& where) {
        if (!extension.IsObject() || !extension.Has("transmissionTexture")) return 1;
        const int index = wholeNumber(extension.Get("transmissionTexture"), "index", -1);
        if (index < 0 || index >= static_cast<int>(file_.model.textures.size()))
            throw InputError(where, fmt::format("textures[{}] does not exist", index));
        const auto image = decode(imageOf(file_.model.textures[index], where), where);
        if (!image || image->srgb8.empty()) return 1;
        double sum = 0;
        for (std::size_t i = 0; i < image->srgb8.size(); i += 4) sum += image->srgb8[i];
        return sum * 4 / (255.0 * static_cast<double>(image->srgb8.size()));
    }

    /// Thin-walled unless the volume has a thickness; one tint for the whole surface.
    void setGlass(Material& material, const tinygltf::Material& m, const Surface& surface,
                  float transmission, const SourceLocation& where) {
        const Vec3 tint = material.diffuseTexture < 0
                              ? Vec3(1)
                              : scene_.textures[material.diffuseTexture].average();
        if (transmission < 1)
            warn(report_, where, "glass in part: what it does not let through is absorbed");
        makeGlass(
            material, transmission * surface.base * tint,
            static_cast<float>(extensionNumber(m.extensions, "KHR_materials_ior", "ior", 1.5)),
            widthOfRoughness(static_cast<float>(surface.roughness)), report_, where);
        material.thin =
            !(extensionNumber(m.extensions, "KHR_materials_volume", "thicknessFactor", 0) > 0);
        const auto volume = m.extensions.find("KHR_materials_volume");
        if (volume != m.extensions.end() && volume->second.IsObject() &&
            volume->second.Has("attenuationDistance"))
            warn(report_, where, "attenuation within glass is left out");
    }

    static float opacityOf(const tinygltf::Material& m, const Surface& surface,
                           double transmission) {
        const bool isBlended = m.alphaMode == "BLEND" && surface.baseTexture.index < 0;
        const double alpha = isBlended ? surface.alpha : 1;
        return static_cast<float>(std::min(alpha, 1 - transmission));
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

    /// The image of a texture: the one in a format that every reader knows, if there is such; -1:
    /// none.
    int imageOf(const tinygltf::Texture& texture, const SourceLocation& where) const {
        if (texture.source >= 0) return texture.source;
        for (const char* extension : {"EXT_texture_webp", "KHR_texture_basisu"}) {
            const double source = extensionNumber(texture.extensions, extension, "source", -1);
            if (source >= static_cast<double>(file_.images.size()))
                throw InputError(where, fmt::format("images[{}] does not exist", source));
            if (source >= 0) return static_cast<int>(source);
        }
        return -1;
    }

    std::string nameOf(int image) const {
        const auto& [name, uri, bufferView] = file_.images[image];
        const bool isFile = bufferView < 0 && !uri.starts_with("data:");
        return fmt::format("images[{}] '{}'", image, isFile ? uri : name);
    }

    /// Decodes an image; nothing (with a warning) if that is not possible. -1: a texture has none.
    std::optional<DecodedImage> decode(int image, const SourceLocation& where) {
        const auto warnOf = [&](const std::string& fault) {
            warn(report_, where, fault + "; its factor alone is used");
            return std::nullopt;
        };
        if (image < 0) return warnOf("a texture has no image");
        const GltfBytes bytes = imageBytes(file_, image);
        if (bytes.empty()) return warnOf(nameOf(image) + " not found");
        if (isKtx2(bytes))
            return warnOf(nameOf(image) + ": KTX2 is not decoded, export PNG or JPEG");
        try {
            return decodeImage(bytes, nameOf(image));
        } catch (const Error& error) {
            return warnOf(error.what());
        }
    }

    /// Index into Scene::textures; -1: none.
    int loadTexture(int index, const SourceLocation& where) {
        if (index < 0) return -1;
        const tinygltf::Texture& texture = file_.model.textures[index];
        const tinygltf::Sampler sampler =
            texture.sampler < 0 ? tinygltf::Sampler{} : file_.model.samplers[texture.sampler];
        const Wrap wrapU = wrapOf(sampler.wrapS), wrapV = wrapOf(sampler.wrapT);
        const int source = imageOf(texture, where);
        const auto key = std::make_tuple(source, wrapU, wrapV);
        if (const auto known = textures_.find(key); known != textures_.end()) return known->second;
        int result = -1;
        if (auto image = decode(source, where)) {
            result = static_cast<int>(scene_.textures.size());
            scene_.textures.push_back(toTexture(std::move(*image), file_.images[source].name, wrapU,
                                                wrapV, report_, where));
        }
        return textures_[key] = result;
    }

    glm::dvec2 meanRoughnessMetallic(const tinygltf::TextureInfo& info,
                                     const SourceLocation& where) {
        const int source = imageOf(file_.model.textures[info.index], where);
        const auto known = means_.find(source);
        if (known != means_.end()) return known->second;
        const auto image = decode(source, where);
        return means_[source] = image ? meanGreenBlue(*image) : glm::dvec2(1);
    }

    /// The mask of a material, if it has one; false if nothing of its surfaces is solid.
    bool addMask(const tinygltf::Material& m, const Surface& surface, std::uint32_t material,
                 const SourceLocation& where) {
        const bool isBlended = m.alphaMode == "BLEND";
        const int texture = surface.baseTexture.index;
        if (m.alphaMode != "MASK" && !(isBlended && texture >= 0)) return true;
        if (isBlended)
            warn(report_, where,
                 "blending is not supported; what is less than half opaque is left out, the rest "
                 "is opaque");
        const double cutoff = isBlended ? kBlendCutoff : m.alphaCutoff;
        if (surface.alpha < cutoff) {
            warn(report_, where, "transparent all over; its surfaces are left out");
            return false;
        }
        const int image = cutoff > 0 ? loadMask(texture, where) : -1;
        if (image >= 0)
            masked_.masks[material] = {image, static_cast<float>(cutoff / surface.alpha)};
        return true;
    }

    /// Index of the alpha channel of a texture; -1: it has none.
    int loadMask(int index, const SourceLocation& where) {
        if (index < 0) return -1;
        const tinygltf::Texture& texture = file_.model.textures[index];
        const tinygltf::Sampler sampler =
            texture.sampler < 0 ? tinygltf::Sampler{} : file_.model.samplers[texture.sampler];
        const Wrap wrapU = wrapOf(sampler.wrapS), wrapV = wrapOf(sampler.wrapT);
        const auto key = std::make_tuple(imageOf(texture, where), wrapU, wrapV);
        const auto [entry, isNew] = masks_.try_emplace(key, -1);
        if (!isNew) return entry->second;
        const auto image = decode(std::get<0>(key), where);
        if (!image || !image->hasAlpha) return -1;
        masked_.images.emplace_back(*image, AlphaSource::alpha, wrapU, wrapV);
        return entry->second = static_cast<int>(masked_.images.size()) - 1;
    }

    Scene& scene_;
    MaskedMaterials& masked_;
    const GltfFile& file_;
    ImportReport& report_;
    std::map<std::tuple<int, Wrap, Wrap>, int> textures_, masks_;
    std::map<int, glm::dvec2> means_;
};

}  // namespace

std::vector<GltfMaterial> addGltfMaterials(Scene& scene, MaskedMaterials& masked,
                                           const GltfFile& file, ImportReport& report) {
    MaterialBuilder builder(scene, masked, file, report);
    std::vector<GltfMaterial> result;
    for (std::size_t i = 0; i < file.model.materials.size(); ++i)
        result.push_back(builder.add(static_cast<int>(i)));
    return result;
}

}  // namespace vlf
