#pragma once
// A still picture of a baked room on the CPU, in each of the display modes.

#include "vlf/dynamic/dynamic_room.h"
#include "vlf/render/cpu/diagram.h"
#include "vlf/render/cpu/radiance_lookup.h"

#include <cstdint>

namespace vlf {

enum class DisplayMode {
    raytraced,    ///< diffuse light from the atlas, reflections traced
    field,        ///< diffuse light from the atlas, mirrors looked up in the radiance field
    progressive,  ///< field while the view moves, raytraced once it rests: a still is raytraced
    wireframe,    ///< a line drawing
    diagram,      ///< the structure of the field
};

/// Whether pictures of a mode are radiance; otherwise they are display-linear colours in [0, 1].
inline bool showsRadiance(DisplayMode mode) {
    return mode != DisplayMode::wireframe && mode != DisplayMode::diagram;
}

struct StillParams {
    Camera camera;
    int width = 640, height = 480;  ///< pixels
    DisplayMode mode = DisplayMode::raytraced;
    int antialias = 4;  ///< n in [1, 16]: up to n x n rays per pixel; wireframes ignore it
    LookupKind lookup = LookupKind::depthCorrected;  ///< of mode field
    bool normals = false;                            ///< draw them in mode wireframe
    DiagramParams diagram;
    const DynamicRoom* objects = nullptr;  ///< in the room, up to date; null: none
};

struct StillReport {
    double seconds = 0;
    std::uint64_t rays = 0;
};

/// The picture: radiance (W·m⁻²·sr⁻¹) or colours, see showsRadiance. The same for any number of
/// threads. Throws Cancelled, and InputError if the camera has no view, a number is out of range,
/// the field is not of this scene, or it lacks what the mode shows.
Image renderStill(const Scene& scene, const RayScene& rays, const LightField& field,
                  const StillParams& params, Progress& progress, StillReport* report = nullptr);

}  // namespace vlf
