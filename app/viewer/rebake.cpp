#include "rebake.h"

#include "vlf/base/parallel.h"
#include "vlf/dynamic/posed_scene.h"
#include "vlf/dynamic/rebake.h"

#include <chrono>
#include <utility>

#include <fmt/format.h>

namespace vlf::app {

namespace {

constexpr int kNiceness = 10;

}  // namespace

void Rebake::Activity::stage(const std::string& name) {
    const std::lock_guard lock(mutex_);
    name_ = name;
    fraction_ = 0;
}

std::string Rebake::Activity::text() const {
    const std::lock_guard lock(mutex_);
    return fmt::format("baking again with the objects: {} {:.0f} %", name_, 100 * fraction_);
}

Rebake::Rebake(std::shared_ptr<const BakedRoom> room, std::vector<DynamicObject> objects) {
    result_ = std::async(
        std::launch::async, [this, room = std::move(room), objects = std::move(objects)] {
            auto baked = std::make_shared<BakedRoom>();
            runInBackground(kNiceness, 0, [&] {
                baked->scene = posedScene(room->scene, objects);
                baked->field = bake(baked->scene, paramsOf(room->field.record), progress_);
            });
            return std::shared_ptr<const BakedRoom>(std::move(baked));
        });
}

bool Rebake::done() const {
    return result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::string Rebake::activity() const {
    return progress_.text();
}

}  // namespace vlf::app
