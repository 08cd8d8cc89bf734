#include "fuzz/scratch.h"
#include "fuzz/seeds.h"

#include <string>

namespace vlf::fuzz {

namespace {

const std::string kCamera = R"("camera": [
  {"seconds": 0, "eye": [0, 1.6, 4], "yaw": 0, "pitch": -5, "verticalFov": 50},
  {"seconds": 1, "eye": [0.5, 1.6, 4], "yaw": 350, "pitch": 0, "verticalFov": 50},
  {"seconds": 2.5, "eye": [1, 1.6, 2], "yaw": 90, "pitch": 80, "verticalFov": 60}])";

const std::string kObjects = R"("objects": [
  {"shape": "cube", "position": [1, 0.05, 2], "scale": 0.1,
   "motion": {"turn": {"axis": [0, 1, 1], "degreesPerSecond": 90}}},
  {"name": "lamp", "shape": "cube",
   "material": {"diffuse": [0.5, 0.4, 0.3], "mirror": [0.1, 0.1, 0.1], "emission": [9, 9, 9]},
   "rotation": {"axis": [0, 2, 0], "degrees": 90},
   "visible": false, "shading": "prt", "shadow": "hard", "directSamples": 4,
   "gather": {"points": "vertices", "subdivision": 2, "texelSize": 0.02, "lines": 129, "step": 2,
              "importanceSamples": 64, "emittersByDirections": true, "cache": true,
              "onlyVisible": false},
   "prt": {"order": 3, "reflections": false}, "hard": {"mapSize": 256, "opacity": 0.25},
   "motion": {"circle": {"centre": [0, 1, 0], "axis": [0, 0, 1], "degreesPerSecond": 30,
                         "turns": false}}},
  {"file": "model.obj",
   "motion": {"interpolation": "smooth", "loop": true, "keyframes": [
     {"seconds": 0, "position": [0, 0, 0]}, {"seconds": 1, "position": [1, 0, 0]},
     {"seconds": 2.5, "rotation": {"axis": [1, 0, 0], "degrees": -45}, "scale": 2,
      "visible": false}, {"seconds": 3, "position": [0, 0, 0]}]}}])";

}  // namespace

std::vector<Blob> cameraPathSeeds() {
    return {toBlob(R"({"format": "vlf camera path", "version": 1, )" + kCamera + "}"),
            toBlob(R"({"format": "vlf camera path", "version": 2, )" + kCamera + ",\n" + kObjects +
                   "}")};
}

std::vector<Blob> scenarioSeeds() {
    return {toBlob(R"({"format": "vlf scenario", "version": 1, )" + kObjects + "}")};
}

void putModelFile() {
    putFile("model.obj", toBlob("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n"));
}

}  // namespace vlf::fuzz
