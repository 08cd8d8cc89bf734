#pragma once
// What vlf compare-dynamic has found, for people and as JSON.

#include "vlf/dynamic/rebake.h"
#include "vlf/image/flip.h"
#include "vlf/render/cpu/object_faces.h"

#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

namespace vlf::app {

/// Of maps of the error: FLIP that is shown brightest.
inline constexpr float kBrightestError = 0.5f;

struct DynamicReport {
    double updateSeconds = 0;  ///< lighting the objects
    double truthSeconds = 0;
    float exposure = 0;  ///< EV
    double relMse = 0;
    FlipResult flip;
    std::vector<FaceRadiance> faces;
    std::optional<RoomLightError> light;  ///< where the truth has irradiance
};

nlohmann::ordered_json toJson(const DynamicReport& report, const DynamicRoom& objects);

void printReport(const DynamicReport& report, const DynamicRoom& objects);

}  // namespace vlf::app
