#pragma once
// An object in a baked room: its mesh, where it is, and how it is lit and gives light back.

#include "vlf/dynamic/object_model.h"
#include "vlf/math/pose.h"

#include <memory>
#include <string>

namespace vlf {

/// How the light on an object is found (Wither 2005; design of each in its own file).
enum class Shading {
    flat,    ///< the room's mean irradiance everywhere
    lights,  ///< point lights that stand for the emitters, and an ambient term
    gather,  ///< gathered from what the field says leaves the surfaces around
    prt,     ///< precomputed transfer of the incident light, in spherical harmonics
};

/// What of its shadow and light the room gets.
enum class ShadowKind {
    none,
    hard,   ///< a shadow map from the brightest point light, laid over the finished picture
    soft,   ///< the direct light that the object blocks, emitters sampled
    field,  ///< that, and all indirect light blocked and given back: delta transport
};

enum class GatherPoints { vertices, texels };

struct GatherSettings {
    GatherPoints points = GatherPoints::texels;
    int subdivision = 0;        ///< of the mesh, where it is lit at vertices; in [0, 3]
    float texelSize = 0;        ///< metres in the world at scale 1; 0: by the object's size
    int lines = 513;            ///< of the direction set: 2·4ⁿ + 1
    int step = 1;               ///< only every step-th direction: biased, as in Wither 2005
    int importanceSamples = 0;  ///< this many directions chosen by importance instead; 0: all
    bool emittersByDirections = false;  ///< emitters met by the directions alone, not sampled apart
    bool cache = false;                 ///< reuses light gathered near by at a like normal
    bool onlyVisible = true;            ///< only what a viewer can see (DynamicRoom::setViewers)

    friend bool operator==(const GatherSettings&, const GatherSettings&) = default;
};

struct PrtSettings {
    int order = 5;            ///< of the spherical harmonics, in [1, 5]
    bool reflections = true;  ///< of light between parts of the object

    friend bool operator==(const PrtSettings&, const PrtSettings&) = default;
};

struct HardShadowSettings {
    int mapSize = 512;     ///< texels along a side, in [16, 8192]
    float opacity = 0.5f;  ///< of black, in [0, 1]

    friend bool operator==(const HardShadowSettings&, const HardShadowSettings&) = default;
};

struct ObjectSettings {
    Shading shading = Shading::gather;
    ShadowKind shadow = ShadowKind::field;
    int directSamples = 16;  ///< shadow rays to the emitters from each lit point, in [1, 1024]
    GatherSettings gather;
    PrtSettings prt;
    HardShadowSettings hard;

    friend bool operator==(const ObjectSettings&, const ObjectSettings&) = default;
};

struct DynamicObject {
    std::string name;
    std::shared_ptr<const ObjectModel> model;
    Pose pose;
    ObjectSettings settings;
    bool visible = true;  ///< false: as if it were not there
};

}  // namespace vlf
