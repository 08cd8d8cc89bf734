// From radiance to what the target holds.

// K. Narkowicz, ACES filmic tone mapping curve, 2016.
vec3 filmic(vec3 x) {
    x = min(x, 1e4);
    return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0, 1);
}

vec3 toSrgb(vec3 c) {
    // Within 0.002 of the curve: cheaper than a power where the GPU is the CPU.
    vec3 s = sqrt(c), q = sqrt(s), e = sqrt(q);
    return max(12.92 * min(c, 0.0031308), 0.585122381 * s + 0.783140355 * q - 0.368262736 * e);
}

// A colour in [0, 1].
vec4 shownColor(vec3 c) {
    return vec4(view.tone.y == kWriteLinear ? c : toSrgb(min(c, 1)), 1);
}

vec4 outputColor(vec3 radiance) {
    if (view.tone.y == kWriteRadiance) return vec4(radiance, 1);
    vec3 c = max(view.tone.x * radiance, 0);
    return shownColor(view.tone.w * (view.tone.y == kWriteClamped ? min(c, 1) : filmic(c)));
}
