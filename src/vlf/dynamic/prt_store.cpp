#include "vlf/dynamic/prt_store.h"

namespace vlf {

bool PrtStore::Key::operator<(const Key& other) const {
    if (model.owner_before(other.model)) return true;
    if (other.model.owner_before(model)) return false;
    return std::tuple(subdivision, settings.order, settings.reflections) <
           std::tuple(other.subdivision, other.settings.order, other.settings.reflections);
}

std::shared_ptr<const PrtTransfer> PrtStore::transfer(
    const std::shared_ptr<const ObjectModel>& model, int subdivision, const PrtSettings& settings) {
    const std::lock_guard lock(mutex_);
    const Key key{model, subdivision, settings};
    if (const auto found = transfers_.find(key); found != transfers_.end()) return found->second;
    std::erase_if(transfers_, [](const auto& entry) { return entry.first.model.expired(); });
    auto made =
        std::make_shared<const PrtTransfer>(computeTransfer(model->mesh(subdivision), settings));
    transfers_.emplace(key, made);
    return made;
}

std::size_t PrtStore::size() const {
    const std::lock_guard lock(mutex_);
    return transfers_.size();
}

}  // namespace vlf
