#pragma once
// Baking: from a scene to its virtual light field. bake() does it all; the calls beneath it are
// the same loop in steps, for previews, tests and tools.

#include "vlf/base/progress.h"
#include "vlf/field/light_field.h"
#include "vlf/propagate/bake_solution.h"
#include "vlf/propagate/bent_texels.h"
#include "vlf/propagate/bundle_faces.h"
#include "vlf/propagate/bundle_sweep.h"
#include "vlf/propagate/light_sources.h"
#include "vlf/propagate/mirror_view.h"
#include "vlf/propagate/radiance_bake.h"
#include "vlf/scene/scene.h"
#include "vlf/trace/ray_scene.h"
#include "vlf/unwrap/unwrap.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace vlf {

struct BakeParams {
    std::string preset = "standard";
    int directions = 2049;  ///< lines l of the last sweep: 2·4ⁿ + 1
    int cells = 256;        ///< N: rays along one side of a bundle
    float texelSize = 0;    ///< metres; 0: from texelBudget
    double texelBudget = 75000;
    int directSamples = 4;       ///< shadow rays per texel outside penumbrae
    int coarseDirections = 129;  ///< of the sweeps before the last
    int coarseCells = 128;
    int maxBounces = 0;             ///< 0: until converged
    double tolerance = 1e-3;        ///< of the light still missing, relative
    int settlingSweeps = 8;         ///< twice as many follow; the mean of the later half goes on
    int radianceDirections = 2049;  ///< of the radiance field of mirror charts; 0: none
    int radianceCells = 256;
    int glossDirections = 513;  ///< of that of rough mirror charts; 0: none
    int glossCells = 128;
    GlossSamples gloss{};
    int tileSize = 4;  ///< m, a power of two
    // Refinement: fine sweeps and samples of direct light are added until one of these is met.
    double error = 0;     ///< estimated error of the texels, relative; 0: none
    double seconds = 0;   ///< in all, as far as can be foretold; 0: none
    int refinements = 0;  ///< so many steps, as a bake that ended in time has taken; 0: none
    bool adaptiveTexels = false;  ///< whether `pieces` are to be planned, see texel_plan.h
    TexelPieces pieces{};         ///< of the scene's surfaces; empty: even texels
    std::uint64_t seed = 0;
};

/// Parameters of "draft", "standard" or "high". Throws InputError for another name.
BakeParams presetParams(const std::string& name);

/// Of the radiance fields that a bake makes: that of perfect mirrors and that of rough ones.
std::array<RadianceParams, 2> radianceParams(const BakeParams& params);

/// A bake under way. Reflectances are per entry of unwrap.texels.
struct BakeState : BakeSolution {
    /// To go on from `solution`, which is of the same scene, parameters and instruction set.
    BakeState(const Scene& sceneToBake, const BakeParams& bakeParams, BakeSolution solution = {})
        : BakeSolution(std::move(solution)),
          scene(sceneToBake),
          params(bakeParams),
          rays(sceneToBake) {}

    const Scene& scene;
    BakeParams params;
    RayScene rays;
    Unwrap unwrap;
    FieldFrame frame;
    BundleFaces faces;
    LightSources sources;
    std::vector<BentTexel> bentTexels;
    std::vector<Vec3> reflectance;  ///< diffuse
    std::vector<Vec3> absorptance;  ///< 1 - diffuse - mirror reflectance
    RefinementClock clock;
};

/// Is shown the states on the way, by the thread that bakes and between its parallel loops: when
/// the charts are known and a stage is reached, whenever a pause was due (Progress::pauseDue), and
/// by bake() once more before it throws Cancelled. A copy of the state's solution is always fit to
/// go on from.
using BakeObserver = std::function<void(const BakeState&)>;
inline void unobserved(const BakeState&) {}

/// Charts, texels and direct light: the field after zero bounces. `scene` must outlive the state.
BakeState makeState(const Scene& scene, const BakeParams& params, Progress& progress,
                    const BakeObserver& observe = unobserved);

/// One bounce: every texel gathers the light that the others reflect, over `directions` lines (in
/// random rotation `sweep`, or as they are if sweep < 0) of cells² rays. Goes on with a sweep that
/// was left.
void propagateOnce(BakeState& state, int directions, int cells, int sweep, Progress& progress,
                   const BakeObserver& observe = unobserved);

/// Another fine sweep, over a random rotation of `directions` lines, whose samples are added to
/// those of the ones before: the state's irradiance becomes that of all of them.
void refineOnce(BakeState& state, int directions, Progress& progress,
                const BakeObserver& observe = unobserved);

/// Coarse bounces until the light still missing is below the tolerance (or for
/// params.maxBounces), then one fine one or, with a refinement, as many as it takes.
void propagate(BakeState& state, Progress& progress, const BakeObserver& observe = unobserved);

/// Where the state's light field lies, its charts and of its record the parameters; no light (see
/// fillAtlas).
LightField unlitField(const BakeState& state);

/// The light field of the present solution.
LightField finish(BakeState& state, Progress& progress, const BakeObserver& observe = unobserved);

/// All of it, or what `solution` leaves to do of it, to the same bits. Throws InputError for
/// parameters or a scene that cannot be baked or a solution of another one, Cancelled.
LightField bake(const Scene& scene, const BakeParams& params, Progress& progress,
                BakeReport* report = nullptr, const BakeObserver& observe = unobserved,
                BakeSolution solution = {});

}  // namespace vlf
