// How objects have changed the light of the room at a place that a mirror shows; as
// dynamic/changed_charts.cpp.

#include "objects_block.glsl"

layout(binding = kChangeUnit) uniform sampler2D changeOfIrradiance;  // factors, in the atlas

// The receivers that may be at a place, see receiver_grid.h.
uint receiversAt(vec3 p) {
    ivec3 cell = clamp(ivec3((p - objects.gridOrigin.xyz) * objects.gridScale.xyz), ivec3(0),
                       ivec3(kGridSide - 1));
    int index = (cell.z * kGridSide + cell.y) * kGridSide + cell.x;
    return texelFetch(objectRecords, index >> 2)[index & 3];
}

// A factor of radiance that a ray sees at a distance.
vec3 changeOfLight(vec3 origin, vec3 direction, float distance_) {
    vec3 p = origin + distance_ * direction;
    vec2 place = vec2(0);
    float nearest = objects.tolerance.x;
    bool found = false;
    uint left = receiversAt(p);
    while (left != 0u) {
        ReceiverData r = objects.receivers[(left & 255u) - 1u];
        left >>= 8;
        float slope = dot(r.normal.xyz, direction), depth = dot(r.normal.xyz, p);
        float off = max(max(r.normal.w - depth, depth - r.place.z), 0);
        // The distance is that of a cell; a plane says more exactly where the ray meets it.
        vec3 q = p + (r.place.w != 0 ? (r.normal.w - depth) / min(slope, -1e-6) : 0) * direction;
        vec2 texel = vec2(dot(r.uAxis.xyz, q) + r.uAxis.w, dot(r.vAxis.xyz, q) + r.vAxis.w);
        if (slope < 0 && off <= nearest && texel == clamp(texel, r.range.xy, r.range.zw)) {
            place = r.place.xy + texel;
            nearest = off;
            found = true;
        }
    }
    vec3 factor = vec3(1);
    while (found) {
        vec2 at = place / vec2(textureSize(changeOfIrradiance, 0));
        factor = textureLod(changeOfIrradiance, at, 0).rgb;
        found = factor.r < 0;
    }
    return factor;
}
