#pragma once
// The virtual light field: everything the light transport found, as plain data. Two
// representations exist: the irradiance atlas (diffuse light; read by every renderer) and the
// radiance field (mirror charts; read in `field` mode), of which there are two: what perfect
// mirrors show is sharp, what rough ones show is not and needs fewer directions and cells.

#include "vlf/field/chart.h"
#include "vlf/field/irradiance_atlas.h"
#include "vlf/field/parallel_subfield.h"
#include "vlf/field/radiance_field.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vlf {

/// Light power balance of a bake, W per channel.
struct EnergyReport {
    Vec3 emitted{0};   ///< by all emitters and punctual lights within the scene; what comes from
                       ///< outside (environment, directional lights) and meets any of it
    Vec3 absorbed{0};  ///< by surfaces
    Vec3 unshot{0};    ///< still under way when the bounces stopped
    Vec3 escaped{0};   ///< left an open scene: emitted - absorbed - unshot
};

/// How the field was made: enough to make it again.
struct BakeRecord {
    std::string programVersion;
    std::string instructionSet;  ///< of the transport kernels, e.g. "AVX2"
    std::string sceneHash;       ///< of the imported scene
    std::string preset;
    std::uint64_t seed = 0;
    int directions = 0;          ///< lines l
    int cells = 0;               ///< N
    int radianceDirections = 0;  ///< lines of the radiance field; 0: no mirrors
    int radianceCells = 0;
    int glossDirections = 0;  ///< the same of rough mirrors
    int glossCells = 0;
    int tileSize = 0;              ///< m
    float texelSize = 0;           ///< metres
    int directSamples = 0;         ///< per texel
    int bounces = 0;               ///< sweeps done
    double residual = 0;           ///< estimated light still missing, relative
    double texelError = 0;         ///< estimated relative RMSE of the texels' irradiance
    double interpolatedError = 0;  ///< the same, with what interpolation between them misses
    EnergyReport energy;
};

struct LightField {
    FieldFrame frame;
    std::vector<Chart> charts;
    std::vector<TriangleCharts> triangleCharts;  ///< one per display triangle
    IrradianceAtlas atlas;
    RadianceField radiance;  ///< of perfect mirrors
    RadianceField gloss;     ///< of rough ones
    BakeRecord record;
};

}  // namespace vlf
