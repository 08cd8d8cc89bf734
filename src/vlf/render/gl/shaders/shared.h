#pragma once
// Read by C++ and GLSL: constants and structures that both sides must agree on.

#ifdef __cplusplus
#include "vlf/math/vector.h"

namespace vlf::shared {
#define VLF_INT inline constexpr int
using vec4 = Vec4;
using ivec4 = glm::ivec4;
using mat4 = Mat4;
#else
#define VLF_INT const int
#endif

// Attributes of a vertex.
VLF_INT kPositionAttribute = 0;
VLF_INT kGeometricNormalAttribute = 1;  // octahedral
VLF_INT kUvAttribute = 2;
VLF_INT kAtlasUvAttribute = 3;
VLF_INT kMirrorAttribute = 4;  // number of the mirror chart; of objects, of the vertex
VLF_INT kMirrorNormalAttribute = 5;

// Texture units.
VLF_INT kIrradianceUnit = 0;
VLF_INT kDiffuseUnit = 1;
VLF_INT kEmissionUnit = 2;
VLF_INT kElementUnit = 3;  // elements of the radiance field
VLF_INT kRecordUnit = 4;   // where they are
VLF_INT kBvhNodeUnit = 5;  // of traced reflections alone, from here on
VLF_INT kBvhTriangleUnit = 6;
VLF_INT kHitRecordUnit = 7;
VLF_INT kHitTexelUnit = 8;
VLF_INT kMirrorTriangleUnit = 9;  // the scene's triangles by those of the mirrors' batches
VLF_INT kObjectUnit = 10;         // where objects are, and what of theirs lies where
VLF_INT kVertexLightUnit = 11;    // irradiance at their vertices
VLF_INT kObjectAtlasUnit = 12;    // and at their texels
VLF_INT kMirrorMapUnit = 13;
VLF_INT kChangeUnit = 14;         // how objects change the irradiance atlas
VLF_INT kProbeUnit = 15;          // reflection probes of mirror objects
VLF_INT kShadowUnit = 16;         // of hard shadows: distances of objects, opacity, of the room
VLF_INT kSkyUnit = 17;
VLF_INT kUnits = 18;
VLF_INT kPictureUnit = 0;  // of picture_mean.frag, as are these uniforms
VLF_INT kSizeLocation = 0;
VLF_INT kWeightLocation = 1;

// Uniform blocks.
VLF_INT kViewBlock = 0;
VLF_INT kMaterialBlock = 1;
VLF_INT kObjectsBlock = 4;
VLF_INT kShadowBlock = 5;
VLF_INT kRadianceBlock = 6;

// Uniforms of shaders of objects.
VLF_INT kPlaceLocation = 0;    // from the object's space to the world's
VLF_INT kLightLocation = 1;    // place in the atlas; first irradiance by vertex; the object's number
VLF_INT kOpacityLocation = 2;  // of shadow.frag

// Texels of an object in kObjectUnit; floats are held by their bits.
//     three rows of the matrix from its space to the world's
//     sphere around it in the world: centre, radius
//     1 / scale^2; first node, nodes, first triangle of its hierarchy
//     first of its records, first of its texels (hit_surfaces.h); first record of a vertex; first of
//     its vertices' irradiances
//     place in the atlas; flags; irradiances from those of the front sides to those of the back
VLF_INT kObjectTexels = 7;
VLF_INT kLitByTexel = 1;  // the flag
VLF_INT kProbeShift = 8;  // bits from here on: layer of the reflection probe + 1; 0: none

// Before the objects in kObjectUnit: four cells a texel of the grid of receivers, see
// receiver_grid.h.
VLF_INT kGridSide = 32;
VLF_INT kGridTexels = 8192;

VLF_INT kMostReceivers = 32;

// An element of the radiance field, from the lowest bit: the distance (0: none), then the sum of
// red, green and blue on a logarithmic scale, then the shares of red and blue in it.
VLF_INT kDistanceBits = 8;
VLF_INT kSumBits = 9;
VLF_INT kRedBits = 8;
VLF_INT kBlueBits = 7;

// Flags of a chart and modes of a texture in hit_surfaces.h.
VLF_INT kPlanarChart = 1;
VLF_INT kEmitsBothSides = 2;
VLF_INT kGlassChart = 4;
VLF_INT kPaneChart = 8;  // of glass
VLF_INT kWrapClamp = 1;
VLF_INT kWrapMirror = 2;

// How colours leave the shader.
VLF_INT kWriteRadiance = 0;
VLF_INT kWriteFilmic = 1;
VLF_INT kWriteClamped = 2;
VLF_INT kWriteLinear = 3;  // of drawings: as kWriteFilmic, but not sRGB-encoded

// std140.
struct ViewData {
    mat4 clipFromWorld;
    vec4 eye;         // world; w: how far rays start off surfaces, metres
    vec4 tone;        // factor, kind of output (kWrite...), bias of the level of detail of textures,
                      // factor after the tone curve
    ivec4 trace;      // nodes of the room's hierarchy
    vec4 skyRight;    // a pixel at (x, y) of the clip space looks along x right + y up + ahead;
    vec4 skyUp;       // w of the first: turn of the environment's picture, of the whole circle
    vec4 skyAhead;
};

// A radiance field.
struct RadianceData {
    vec4 frame;        // centre, cells a metre
    vec4 field;        // rings of the direction set, lines, cells (minus 1) / 2, tolerance (metres)
    vec4 elementCode;  // metres of the longest distance, log2 of the sum at code 0, its step
    vec4 shareCode;    // share of red at code 0, its step, and the same of blue
};

struct MaterialData {
    vec4 diffuse;   // reflectance
    vec4 mirror;    // reflectance
    vec4 emission;  // W m^-2 sr^-1
    vec4 glass;     // transmission, index of refraction
    vec4 flags;     // x: whether the back is black; y: the batch's first triangle among mirrors'
};

// A chart whose light the objects change, as in dynamic/changed_charts.h.
struct ReceiverData {
    vec4 uAxis;   // texel coordinates: axis and offset
    vec4 vAxis;
    vec4 normal;  // and the least coordinate along it
    vec4 range;   // first and last of the texel coordinates that have changed
    vec4 place;   // in the atlas; greatest coordinate along the normal; whether it is a plane
};

// The light that hard shadows fall away from.
struct ShadowData {
    mat4 clipFromWorld;
    vec4 light;   // position; w: of a spot the cosine of its outer cone, else 0
    vec4 normal;  // zero where it shines all round; w: width of a texel a metre from the light
};

// Of all objects.
struct ObjectsData {
    vec4 sphere;     // around all of them: centre, radius
    ivec4 counts;    // x: objects
    vec4 tolerance;  // metres between a surface and where the radiance field tells it
    vec4 gridOrigin;
    vec4 gridScale;  // cells a metre
    ReceiverData receivers[kMostReceivers];
};

#ifdef __cplusplus
#undef VLF_INT
static_assert(4 * kGridTexels == kGridSide * kGridSide * kGridSide);
static_assert(sizeof(ShadowData) == 64 + 2 * 16);
static_assert(sizeof(ObjectsData) == 5 * 16 + kMostReceivers * 5 * 16);
static_assert(sizeof(ViewData) == 64 + 6 * 16);
static_assert(sizeof(RadianceData) == 4 * 16);
static_assert(sizeof(MaterialData) == 5 * 16);
}  // namespace vlf::shared
#endif
