#pragma once
// The irradiance mode of vlf reference.

#include "commands.h"
#include "environment_options.h"

#include <string>
#include <vector>

namespace vlf::app {

struct IrradianceOptions {
    std::vector<std::string> scenes;
    EnvironmentOptions environment;
    std::string field;   ///< .vlf to be measured
    std::string output;  ///< .json
    int samplesPerTexel = 1024;
    int texels = 0;       ///< how many to look at, spread evenly; 0: all
    bool points = false;  ///< report the surface points of each texel too
    /// Measure what is shown, interpolated between texels, at a random point of each instead of the
    /// texels' means.
    bool interpolated = false;
};

/// Path-traces the irradiance of a field's texels and reports how far the field is off.
void runIrradianceReference(const IrradianceOptions& options, const Globals& globals);

}  // namespace vlf::app
