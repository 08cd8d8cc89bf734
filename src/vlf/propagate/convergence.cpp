#include "vlf/propagate/convergence.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {
constexpr int kMaxSweeps = 300;
constexpr std::size_t kWindow = 3;  // bounces looked at together
constexpr double kMinRate = 0.3, kMaxRate = 0.8;
constexpr double kWorthExtrapolating = 0.01;  // flux growth; below, noise would be amplified
}  // namespace

Convergence::Convergence(const BakeState& state) : chartArea_(state.unwrap.charts.size(), 0) {
    for (std::size_t i = 0; i < state.unwrap.texels.size(); ++i) {
        chartArea_[state.unwrap.texelChart[i]] += state.unwrap.texelArea(i);
        totalArea_ += state.unwrap.texelArea(i);
    }
    previous_ = chartIrradiance(state);
}

std::vector<double> Convergence::chartIrradiance(const BakeState& state) const {
    std::vector<double> sum(chartArea_.size(), 0);
    for (std::size_t i = 0; i < state.unwrap.texels.size(); ++i)
        sum[state.unwrap.texelChart[i]] +=
            static_cast<double>(state.unwrap.texelArea(i)) * luminance(state.irradiance[i]);
    return sum;
}

void Convergence::update(BakeState& state) {
    const std::vector<double> now = chartIrradiance(state);
    double growth = 0, flux = 0, fluxGrowth = 0;
    for (std::size_t c = 0; c < now.size(); ++c) {
        if (now[c] > 0) growth += chartArea_[c] * (now[c] - previous_[c]) / now[c];
        flux += now[c];
        fluxGrowth += now[c] - previous_[c];
    }
    growth_.push_back({growth / totalArea_, flux > 0 ? fluxGrowth / flux : 0});
    ++bounces_;
    if (growth_.size() == kWindow) judge(state, now);
    previous_ = chartIrradiance(state);
}

void Convergence::judge(BakeState& state, const std::vector<double>& now) {
    const bool worthwhile = std::abs(growth_[2].flux) > kWorthExtrapolating;
    if (worthwhile) rate_ = std::clamp(growth_[2].flux / growth_[1].flux, kMinRate, kMaxRate);
    // The sum of successive differences: the sweeps' noise cancels but for its ends.
    double sum = 0;
    for (const Growth& g : growth_) sum += g.relative;
    residual_ = std::abs(sum) / kWindow * rate_ / (1 - rate_);
    if (worthwhile)
        extrapolate(state, now);
    else
        growth_.erase(growth_.begin());
}

void Convergence::extrapolate(BakeState& state, const std::vector<double>& now) {
    // By chart: the growth of single texels is mostly noise.
    const double gain = rate_ / (1 - rate_);
    for (std::size_t i = 0; i < state.irradiance.size(); ++i) {
        const std::uint32_t c = state.unwrap.texelChart[i];
        const double scale = now[c] > 0 ? 1 + gain * (now[c] - previous_[c]) / now[c] : 1;
        state.irradiance[i] *= static_cast<float>(std::max(scale, 0.5));
    }
    growth_.clear();
}

double Convergence::residualAfter(int sweeps) const {
    return residual_ * std::pow(rate_, sweeps);
}

bool Convergence::reached(int maxBounces, double tolerance) const {
    if (maxBounces > 0) return bounces_ >= maxBounces;
    return residual_ < tolerance || bounces_ >= kMaxSweeps;
}

}  // namespace vlf
