#pragma once
// Transfers once computed, for all objects of the same model.

#include "vlf/dynamic/prt_transfer.h"

#include <map>
#include <memory>
#include <mutex>
#include <tuple>

namespace vlf {

/// Safe to use from several threads. Models are not kept alive by it; transfers of those gone are
/// dropped when the next one is computed.
class PrtStore {
  public:
    /// Of model->mesh(subdivision); computed when first asked for.
    std::shared_ptr<const PrtTransfer> transfer(const std::shared_ptr<const ObjectModel>& model,
                                                int subdivision, const PrtSettings& settings);

    std::size_t size() const;

  private:
    struct Key {
        std::weak_ptr<const ObjectModel> model;
        int subdivision;
        PrtSettings settings;

        bool operator<(const Key& other) const;
    };

    mutable std::mutex mutex_;
    std::map<Key, std::shared_ptr<const PrtTransfer>> transfers_;
};

}  // namespace vlf
