#include "vlf/dynamic/dynamic_room.h"
#include "vlf/dynamic/scenario.h"

namespace vlf {

void moveTo(DynamicRoom& room, const Scenario& scenario, double seconds) {
    for (std::size_t i = 0; i < scenario.objects.size(); ++i) {
        const ScenarioObject& moving = scenario.objects[i];
        if (!moves(moving.motion)) continue;
        room.setPose(i, poseAt(moving.motion, moving.object.pose, seconds));
        room.setVisible(i, visibleAt(moving.motion, moving.object.visible, seconds));
    }
}

}  // namespace vlf
