#include "vlf/propagate/convergence.h"

#include "vlf/propagate/bake.h"

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {
constexpr int kMaxSweeps = 300;
constexpr std::size_t kWindow = 3;  // bounces looked at together
constexpr double kMinRate = 0.3, kMaxRate = 0.8;
constexpr double kWorthExtrapolating = 0.01;  // flux growth; below, noise would be amplified
}  // namespace

Convergence::Convergence(BakeState& state)
    : state_(state), history_(state.convergence), chartArea_(state.unwrap.charts.size(), 0) {
    for (std::size_t i = 0; i < state.unwrap.texels.size(); ++i) {
        chartArea_[state.unwrap.texelChart[i]] += state.unwrap.texelArea(i);
        totalArea_ += state.unwrap.texelArea(i);
    }
    if (history_.charts.empty()) history_.charts = chartIrradiance();
}

std::vector<double> Convergence::chartIrradiance() const {
    std::vector<double> sum(chartArea_.size(), 0);
    for (std::size_t i = 0; i < state_.unwrap.texels.size(); ++i)
        sum[state_.unwrap.texelChart[i]] +=
            static_cast<double>(state_.unwrap.texelArea(i)) * luminance(state_.irradiance[i]);
    return sum;
}

void Convergence::update() {
    const std::vector<double> now = chartIrradiance();
    double growth = 0, flux = 0, fluxGrowth = 0;
    for (std::size_t c = 0; c < now.size(); ++c) {
        if (now[c] > 0) growth += chartArea_[c] * (now[c] - history_.charts[c]) / now[c];
        flux += now[c];
        fluxGrowth += now[c] - history_.charts[c];
    }
    history_.growth.push_back({growth / totalArea_, flux > 0 ? fluxGrowth / flux : 0});
    ++history_.bounces;
    if (history_.growth.size() == kWindow) judge(now);
    history_.charts = chartIrradiance();
}

void Convergence::judge(const std::vector<double>& now) {
    const bool worthwhile = std::abs(history_.growth[2].flux) > kWorthExtrapolating;
    if (worthwhile)
        history_.rate =
            std::clamp(history_.growth[2].flux / history_.growth[1].flux, kMinRate, kMaxRate);
    // The sum of successive differences: the sweeps' noise cancels but for its ends.
    double sum = 0;
    for (const ConvergenceHistory::Growth& g : history_.growth) sum += g.relative;
    history_.residual = std::abs(sum) / kWindow * history_.rate / (1 - history_.rate);
    if (worthwhile)
        extrapolate(now);
    else
        history_.growth.erase(history_.growth.begin());
}

void Convergence::extrapolate(const std::vector<double>& now) {
    // By chart: the growth of single texels is mostly noise.
    const double gain = history_.rate / (1 - history_.rate);
    for (std::size_t i = 0; i < state_.irradiance.size(); ++i) {
        const std::uint32_t c = state_.unwrap.texelChart[i];
        const double scale = now[c] > 0 ? 1 + gain * (now[c] - history_.charts[c]) / now[c] : 1;
        state_.irradiance[i] *= static_cast<float>(std::max(scale, 0.5));
    }
    history_.growth.clear();
}

double Convergence::residualAfter(int sweeps) const {
    return history_.residual * std::pow(history_.rate, sweeps);
}

bool Convergence::reached(int maxBounces, double tolerance) const {
    if (maxBounces > 0) return history_.bounces >= maxBounces;
    return history_.residual < tolerance || history_.bounces >= kMaxSweeps;
}

}  // namespace vlf
