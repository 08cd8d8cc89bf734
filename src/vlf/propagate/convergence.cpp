#include "vlf/propagate/convergence.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {
constexpr int kMaxSweeps = 300;
}

Convergence::Convergence(const BakeState& state) : chartArea_(state.unwrap.charts.size(), 0) {
    for (std::size_t i = 0; i < state.unwrap.texels.size(); ++i) {
        chartArea_[state.unwrap.texelChart[i]] += state.texelArea[i];
        totalArea_ += state.texelArea[i];
    }
    previous_ = chartIrradiance(state);
}

std::vector<double> Convergence::chartIrradiance(const BakeState& state) const {
    std::vector<double> sum(chartArea_.size(), 0);
    for (std::size_t i = 0; i < state.unwrap.texels.size(); ++i)
        sum[state.unwrap.texelChart[i]] +=
            static_cast<double>(state.texelArea[i]) * luminance(state.irradiance[i]);
    return sum;
}

void Convergence::update(const BakeState& state) {
    const std::vector<double> now = chartIrradiance(state);
    double growth = 0;
    for (std::size_t c = 0; c < now.size(); ++c)
        if (now[c] > 0) growth += chartArea_[c] * (now[c] - previous_[c]) / now[c];
    growth_.push_back(std::abs(growth) / std::max(totalArea_, 1e-300));
    previous_ = now;
}

double Convergence::residual() const {
    const std::size_t n = growth_.size();
    if (n < 3) return 1;
    // Ratio over two bounces: with it the light to come is growth · r / (1 - r).
    const double ratio = std::sqrt(growth_[n - 1] / std::max(growth_[n - 3], 1e-300));
    const double r = std::clamp(ratio, 0.0, 0.98);
    return growth_[n - 1] * r / (1 - r);
}

bool Convergence::reached(int maxBounces, double tolerance) const {
    const int bounces = static_cast<int>(growth_.size());
    if (maxBounces > 0) return bounces >= maxBounces;
    return residual() < tolerance || bounces >= kMaxSweeps;
}

}  // namespace vlf
