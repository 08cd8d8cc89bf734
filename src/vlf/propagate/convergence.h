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

    /// Takes note of one more bounce and, every few, extrapolates the state: the light still to
    /// come to a chart is about its last growth times r / (1 - r), r being the ratio of successive
    /// growths of the flux (Lyusternik's acceleration of a Jacobi iteration).
    void update(BakeState& state);

    /// Whether `maxBounces` are done or, if it is 0, the light still to come is estimated below
    /// `tolerance`, relative.
    bool reached(int maxBounces, double tolerance) const;

    /// Estimated light still missing, relative, once `sweeps` more have followed the last that was
    /// watched: the geometric continuation of the growth.
    double residualAfter(int sweeps) const;

  private:
    std::vector<double> chartIrradiance(const BakeState& state) const;
    void judge(BakeState& state, const std::vector<double>& now);
    void extrapolate(BakeState& state, const std::vector<double>& now);

    /// Of one bounce: mean relative growth of the charts, and relative growth of the whole flux.
    struct Growth {
        double relative, flux;
    };

    std::vector<double> chartArea_, previous_;
    double totalArea_ = 0;
    std::vector<Growth> growth_;  ///< of the last bounces, none before an extrapolation
    int bounces_ = 0;
    double residual_ = 1;
    double rate_ = 0.7;  ///< of one bounce's growth to that before
};

}  // namespace vlf
