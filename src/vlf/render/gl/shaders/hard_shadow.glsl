// Hard shadows that objects cast on the room, from shadow_map.h.

layout(std140, binding = kShadowBlock) uniform ShadowBlock { ShadowData shadow; };
layout(binding = kShadowUnit) uniform sampler2D shadowMap;

const float kSteepest = 8;  // slope towards the light

// The part of radiance that shadows leave where the map has this texel; the room is the first that
// the light meets within `slack`.
float remainingAt(ivec2 texel, float distance_, float bias, float slack) {
    vec4 seen = texelFetch(shadowMap, clamp(texel, ivec2(0), textureSize(shadowMap, 0) - 1), 0);
    bool shadowed = seen.r < distance_ - bias && distance_ <= seen.b + slack;
    return shadowed ? 1 - seen.g : 1;
}

// At a place whose slope towards the light makes it `steepness` times as deep as a texel is wide.
float remainingLight(vec3 position, float steepness, float tolerance) {
    vec4 clip = shadow.clipFromWorld * vec4(position, 1);
    vec2 at = 0.5 * clip.xy / clip.w + 0.5;
    bool outside = clip.w <= 0 || at != clamp(at, vec2(0), vec2(1)) ||
                   dot(normalize(shadow.light.xyz - position), shadow.normal.xyz) > -shadow.light.w;
    float remaining = 1;
    while (!outside) {
        float texel = shadow.normal.w * clip.w;
        float bias = view.eye.w + texel * (1 + steepness), slack = bias + tolerance;
        vec2 p = at * vec2(textureSize(shadowMap, 0)) - 0.5;
        ivec2 lower = ivec2(floor(p));
        vec2 f = p - vec2(lower);
        remaining = mix(mix(remainingAt(lower, clip.w, bias, slack),
                            remainingAt(lower + ivec2(1, 0), clip.w, bias, slack), f.x),
                        mix(remainingAt(lower + ivec2(0, 1), clip.w, bias, slack),
                            remainingAt(lower + ivec2(1, 1), clip.w, bias, slack), f.x), f.y);
        outside = remaining >= 0;
    }
    return remaining;
}

// On a surface with this normal on the side that is seen: none where it turns away from the light.
float remainingOn(vec3 position, vec3 normal) {
    vec3 toLight = normalize(shadow.light.xyz - position);
    float cosine = dot(toLight, normal);
    if (cosine <= 0) return 1;
    float steepness = min(sqrt(max(1 - cosine * cosine, 0)) / cosine, kSteepest);
    return remainingLight(position, steepness, 0);
}
