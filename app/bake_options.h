#pragma once
// How well a scene is to be baked.

#include "commands.h"

#include "vlf/propagate/bake.h"

#include <string>

#include <CLI/CLI.hpp>

namespace vlf::app {

/// A preset, and single settings over it; 0, and -1 where 0 means something: the preset's.
struct QualityOptions {
    std::string preset = "standard", bounces = "auto";
    int directions = 0, cells = 0, tile = 0, samples = 0;
    int radianceDirections = -1, radianceCells = 0;
    int glossDirections = -1, glossCells = 0, glossSamples = 0;
    float texel = 0;
    double error = 0, seconds = 0;  // of a refinement
    int refinements = 0;
};

/// The group of the options; `options` must outlive the parsing.
CLI::Option_group* addQualityOptions(CLI::App& command, QualityOptions& options);

BakeParams bakeParams(const QualityOptions& options, const Globals& globals);

/// The parameters with the single settings that are given in place of theirs.
BakeParams withSettings(const QualityOptions& options, BakeParams params);

}  // namespace vlf::app
