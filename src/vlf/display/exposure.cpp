#include "vlf/display/exposure.h"

#include <cmath>

namespace vlf {

namespace {

constexpr float kSecondsToAdapt = 0.5f;  // time constant

}  // namespace

void Exposure::adapt(float wanted, float seconds) {
    if (automatic_) base_ += (wanted - base_) * (1 - std::exp(-seconds / kSecondsToAdapt));
}

}  // namespace vlf
