#pragma once
// When the light has come to rest.

#include "vlf/propagate/bake.h"

#include <vector>

namespace vlf {

/// Watches the mean relative growth of the charts' irradiance from bounce to bounce. The mean over
/// charts, by area and relative to each chart's own light, keeps dark rooms from being forgotten;
/// being signed, the sweeps' noise cancels in it.
class Convergence {
  public:
    explicit Convergence(const BakeState& state);

    /// Takes note of one more bounce.
    void update(const BakeState& state);

    /// Whether `maxBounces` are done or, if it is 0, the light still to come is estimated below
    /// `tolerance`, relative.
    bool reached(int maxBounces, double tolerance) const;

    /// Estimated light still missing, relative: the geometric continuation of the growth.
    double residual() const;

  private:
    std::vector<double> chartIrradiance(const BakeState& state) const;

    std::vector<double> chartArea_, previous_;
    double totalArea_ = 0;
    std::vector<double> growth_;
};

}  // namespace vlf
