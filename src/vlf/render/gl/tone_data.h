#pragma once
// How colours leave the shaders.

#include "vlf/render/gl/renderer.h"
#include "vlf/render/gl/shaders/shared.h"

#include <cmath>

namespace vlf::gl {

/// ViewData::tone of the settings.
inline Vec4 toneData(const RenderSettings& settings) {
    float kind = showsRadiance(settings.mode) ? shared::kWriteRadiance : shared::kWriteLinear;
    if (settings.tone)
        kind = *settings.tone == ToneCurve::filmic ? shared::kWriteFilmic : shared::kWriteClamped;
    return {std::exp2(settings.exposure), kind, settings.textureBias,
            settings.mode == DisplayMode::diagram ? kDimmed : 1};
}

}  // namespace vlf::gl
