#include "vlf/live/live_board.h"

#include <utility>

namespace vlf {

std::optional<LiveUpdate> LiveBoard::takeUpdate() {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    return lock ? std::exchange(update_, std::nullopt) : std::nullopt;
}

LiveStatus LiveBoard::status() const {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock) lastRead_ = status_;
    return lastRead_;
}

std::shared_ptr<const BakedRoom> LiveBoard::finished() const {
    const std::lock_guard lock(mutex_);
    return finished_;
}

void LiveBoard::post(LiveUpdate update) {
    const std::lock_guard lock(mutex_);
    if (!update.room && update_) update.room = update_->room;
    update_ = std::move(update);
}

void LiveBoard::setFinished(std::shared_ptr<const BakedRoom> room) {
    const std::lock_guard lock(mutex_);
    finished_ = std::move(room);
}

}  // namespace vlf
