#pragma once
// When the light has come to rest.

#include <vector>

namespace vlf {

struct BakeState;

/// What is known of the bounces so far.
struct ConvergenceHistory {
    /// Of one bounce: mean relative growth of the charts, and relative growth of the whole flux.
    struct Growth {
        double relative = 0, flux = 0;
    };

    std::vector<double> charts;  ///< irradiance times area after the last bounce; empty: none yet
    std::vector<Growth> growth;  ///< of the last bounces, none before an extrapolation
    int bounces = 0;
    double residual = 1;
    double rate = 0.7;  ///< of one bounce's growth to that before
};

/// Watches the mean relative growth of the charts' irradiance from bounce to bounce. The mean over
/// charts, by area and relative to each chart's own light, keeps dark rooms from being forgotten;
/// being signed, the sweeps' noise cancels in it.
class Convergence {
  public:
    /// Goes on from the state's history.
    explicit Convergence(BakeState& state);

    /// Takes note of one more bounce and, every few, extrapolates the state: the light still to
    /// come to a chart is about its last growth times r / (1 - r), r being the ratio of successive
    /// growths of the flux (Lyusternik's acceleration of a Jacobi iteration).
    void update();

    /// Whether `maxBounces` are done or, if it is 0, the light still to come is estimated below
    /// `tolerance`, relative.
    bool reached(int maxBounces, double tolerance) const;

    /// Estimated light still missing, relative, once `sweeps` more have followed the last that was
    /// watched: the geometric continuation of the growth.
    double residualAfter(int sweeps) const;

  private:
    std::vector<double> chartIrradiance() const;
    void judge(const std::vector<double>& now);
    void extrapolate(const std::vector<double>& now);

    BakeState& state_;
    ConvergenceHistory& history_;
    std::vector<double> chartArea_;
    double totalArea_ = 0;
};

}  // namespace vlf
