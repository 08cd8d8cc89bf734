#pragma once
// What is made once for a model and used by all objects of it.

#include "vlf/dynamic/gather_plan.h"
#include "vlf/dynamic/object.h"
#include "vlf/dynamic/object_lines.h"
#include "vlf/dynamic/object_receivers.h"
#include "vlf/dynamic/prt_store.h"

#include <memory>
#include <vector>

namespace vlf {

/// Receivers of light, and how they get it.
struct ObjectPlan {
    std::shared_ptr<const ObjectModel> model;
    Shading shading = Shading::flat;
    GatherSettings settings;
    PrtSettings prt;
    int texels = 0;
    std::unique_ptr<const ObjectReceivers> receivers;  ///< texels for `gather` only
    std::unique_ptr<const Unwrap> emitting;            ///< charts of a model that emits
    GatherPlan gather;                                 ///< of that shading
    std::shared_ptr<const PrtTransfer> transfer;       ///< of shading `prt`
};

struct LinesPlan {
    std::shared_ptr<const ObjectPlan> of;
    int lines = 0;
    float cell = 0;
    ObjectLines data;
};

/// Keeps plans for as long as an object uses them.
class ObjectPlans {
  public:
    /// Of texels of no given size there are about `texels`.
    std::shared_ptr<const ObjectPlan> plan(const DynamicObject& object, int texels);
    std::shared_ptr<const LinesPlan> linesPlan(const std::shared_ptr<const ObjectPlan>& plan,
                                               int lines, float cell);

  private:
    PrtStore transfers_;
    std::vector<std::weak_ptr<const ObjectPlan>> plans_;
    std::vector<std::weak_ptr<const LinesPlan>> lines_;
};

}  // namespace vlf
