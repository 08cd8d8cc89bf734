#pragma once
// Small files of every kind, made by this program: where fuzzers and tests/hostile begin.

#include "fuzz/readers.h"

namespace vlf::fuzz {

std::vector<Blob> objSeeds();
std::vector<Blob> mtlSeeds();
std::vector<Blob> cameraSeeds();
std::vector<Blob> gltfSeeds();
std::vector<Blob> pictureSeeds();
std::vector<Blob> fieldSeeds();
std::vector<Blob> cameraPathSeeds();
std::vector<Blob> scenarioSeeds();

/// An OBJ file with the materials a, b and c of input.mtl.
Blob objOfMaterials();

/// Puts what scene files refer to beside them: library.mtl, texture.png, texture.hdr, buffer.bin,
/// cameras, and wild.exr, of which some pixels are negative, infinite or not a number.
void putSceneFiles();

/// Puts model.obj, which objects may be made of, beside scenarios.
void putModelFile();

}  // namespace vlf::fuzz
