#pragma once
// Wavefront MTL as written.

#include "vlf/math/vector.h"
#include "vlf/scene/import/import.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vlf {

/// A map_ statement: file name and the options that matter here.
struct MtlTexture {
    std::string file;  ///< as written; empty: none
    int line = 0;
    Vec2 scale{1}, offset{0};  ///< of the texture coordinates: uv' = scale * uv + offset
    bool clamp = false;
    char channel = 0;  ///< of -imfchan: r, g, b, m (alpha), l (luminance) or z; 0: none
};

/// One material; what the file does not say is left unset.
struct MtlMaterial {
    std::string name;
    std::string path;                                 ///< of the MTL file
    int line = 0;                                     ///< of newmtl
    std::optional<Vec3> diffuse, specular, emission;  ///< Kd, Ks, Ke
    std::optional<Vec3> filter;                       ///< Tf
    std::optional<float> ior;                         ///< Ni
    std::optional<float> exponent;                    ///< Ns
    std::optional<float> roughness;                   ///< Pr
    std::optional<float> opacity;                     ///< d, else 1 - Tr
    std::optional<int> illumination;                  ///< illum
    MtlTexture diffuseMap, specularMap, emissionMap, opacityMap;
};

/// Parses the text of an MTL file. Numbers that are missing or not finite are reported and
/// left unset.
std::vector<MtlMaterial> parseMtl(const std::string& path, std::string_view text,
                                  ImportReport& report);

}  // namespace vlf
