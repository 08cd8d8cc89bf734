#include "fuzz/readers.h"
#include "fuzz/require.h"
#include "fuzz/scratch.h"
#include "fuzz/seeds.h"

#include "vlf/display/camera_path_file.h"
#include "vlf/dynamic/scenario_file.h"

#include <string>
#include <vector>

namespace vlf::fuzz {

namespace {

/// Times in seconds that fall before, into and after what motions take.
constexpr double kTimes[] = {0, 0.3, 1, 2.5, 7.77, 86400, 1e9};

void requireSound(const Scenario& scenario) {
    for (const ScenarioObject& object : scenario.objects) {
        requireAccepted([&] { requireValid(object.motion); });
        require(object.object.model != nullptr, "with a model for every object");
    }
    for (const double seconds : kTimes)
        for (const DynamicObject& object : objectsAt(scenario, seconds))
            require(isValid(object.pose), "with objects in valid poses");
}

void requireSound(const CameraPath& path) {
    for (const double seconds : kTimes) {
        const CameraPose pose = path.at(seconds);
        require(isFinite(pose.eye) && isFinite(pose.forward()), "leading to finite places");
        require(pose.verticalFov > 0 && pose.verticalFov < 180, "of fields of view up to 180°");
    }
}

}  // namespace

bool readCameraPath(Bytes bytes) {
    static const bool ready = (putModelFile(), true);
    return ready && isAccepted([&] {
               ModelLibrary library;
               std::vector<std::string> warnings;
               const std::string path = putFile("path.json", bytes);
               const Walk walk = readWalk(path, library, warnings);
               requireSound(walk.camera);
               requireSound(walk.objects);
               requireAccepted([&] { parseWalk(toText(walk, path), path); });
           });
}

bool readScenario(Bytes bytes) {
    static const bool ready = (putModelFile(), true);
    return ready && isAccepted([&] {
               ModelLibrary library;
               std::vector<std::string> warnings;
               const std::string path = putFile("scenario.json", bytes);
               const Scenario scenario = vlf::readScenario(path, {}, library, warnings);
               requireSound(scenario);
               requireAccepted([&] { parseScenario(toText(scenario, path), path); });
           });
}

}  // namespace vlf::fuzz
