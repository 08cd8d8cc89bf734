#include "fuzz/readers.h"
#include "fuzz/seeds.h"

#include <array>

namespace vlf::fuzz {

std::span<const Format> formats() {
    static constexpr std::array kFormats{
        Format{"obj", readObj, objSeeds},
        Format{"mtl", readMtl, mtlSeeds},
        Format{"cameras", readCameras, cameraSeeds},
        Format{"gltf", readGltf, gltfSeeds},
        Format{"picture", readPicture, pictureSeeds},
        Format{"field", readFieldFile, fieldSeeds},
        Format{"camera_path", readCameraPath, cameraPathSeeds},
        Format{"scenario", readScenario, scenarioSeeds},
    };
    return kFormats;
}

}  // namespace vlf::fuzz
