#pragma once
// How colours leave the shaders.

#include "vlf/render/gl/renderer.h"
#include "vlf/render/gl/shaders/shared.h"

#include <cmath>

namespace vlf::gl {

/// ViewData::tone of the settings.
inline Vec4 toneData(const RenderSettings& settings) {
    float kind = shared::kWriteRadiance;
    if (settings.tone)
        kind = *settings.tone == ToneCurve::filmic ? shared::kWriteFilmic : shared::kWriteClamped;
    return {std::exp2(settings.exposure), kind, settings.textureBias, 0};
}

}  // namespace vlf::gl
