// Changed light in what a mirror of the room shows by lookup.
#include "changed_light.glsl"

// The reflected line of sight.
vec3 reflectedSight(vec3 toEye) {
    vec3 direction = reflect(-toEye, normalize(mirrorNormal));
    return dot(direction, geometricNormal) > 0 ? direction : reflect(-toEye, geometricNormal);
}

// `seen` is what the mirror shows without objects: a surface of radiance `front` at the distance
// `nearest` that covers so much of another one at the distance `behind`.
vec3 withChange(vec3 seen, float nearest, float behind, float coverage, vec3 toEye) {
    return seen * changeOfLight(position, reflectedSight(toEye), coverage < 0.5 ? behind : nearest);
}
