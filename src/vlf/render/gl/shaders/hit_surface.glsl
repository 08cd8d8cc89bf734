// The surface that a ray hits, from the records of hit_surfaces.h; as render/cpu/surface.cpp and
// scene/texture.cpp.
#include "shared.h"
#include "view.glsl"
#include "trace.glsl"
#ifdef OBJECTS
#include "objects.glsl"
#endif

layout(binding = kHitRecordUnit) uniform usamplerBuffer hitRecords;
layout(binding = kHitTexelUnit) uniform usamplerBuffer hitTexels;

const uint kNoRecord = 0xffffffffu;

#ifdef OBJECTS
Body body = kRoomBody;  // whose records are read, in whose space surfaces are
#else
struct Body {
    uint firstRecord, firstTexel;
};
const Body body = Body(0u, 0u);
#endif

// Both normals are unit and lie on the side that is hit.
struct HitSurface {
    vec3 position, normal, geometricNormal;
    vec2 uv;
    uvec4 range;  // the third texel of the side's chart
    uint chart;   // kNoRecord: black
    bool front;
#ifdef OBJECTS
    uvec3 vertices;  // records
    vec2 barycentric;
#endif
};

uvec4 hitRecord(uint texel) {
    return texelFetch(hitRecords, int(body.firstRecord + texel));
}

vec3 interpolated(mat3 corners, vec2 barycentric) {
    return corners * vec3(1 - barycentric.x - barycentric.y, barycentric);
}

// The corners of a triangle, given one of its sides.
mat3 cornersOf(uvec4 side) {
    return mat3(uintBitsToFloat(hitRecord(side.x).xyz), uintBitsToFloat(hitRecord(side.y).xyz),
                uintBitsToFloat(hitRecord(side.z).xyz));
}

HitSurface surfaceAt(TraceHit hit, vec3 direction) {
    uvec4 side = hitRecord(2u * hit.triangle);
    uvec4 a = hitRecord(side.x), b = hitRecord(side.y), c = hitRecord(side.z);
    vec4 a1 = uintBitsToFloat(hitRecord(side.x + 1u)), b1 = uintBitsToFloat(hitRecord(side.y + 1u)),
         c1 = uintBitsToFloat(hitRecord(side.z + 1u));
    mat3 corners = mat3(uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), uintBitsToFloat(c.xyz));
    mat3 normals = mat3(uintBitsToFloat(a.w), a1.xy, uintBitsToFloat(b.w), b1.xy,
                        uintBitsToFloat(c.w), c1.xy);
    vec3 outwards = cross(corners[1] - corners[0], corners[2] - corners[0]);
    HitSurface s;
    s.front = dot(outwards, direction) < 0;
    s.chart = s.front ? side.w : hitRecord(2u * hit.triangle + 1u).w;
    s.range = s.chart == kNoRecord ? uvec4(0) : hitRecord(s.chart + 2u);
    s.position = interpolated(corners, hit.barycentric);
    s.geometricNormal = normalize(s.front ? outwards : -outwards);
    s.uv = interpolated(mat3(a1.zw, 0, b1.zw, 0, c1.zw, 0), hit.barycentric).xy;
    vec3 n = interpolated(normals, hit.barycentric);
    float size = length(n);
    s.normal = size > 1e-6 ? n / size : s.geometricNormal;
    if (dot(s.normal, s.geometricNormal) < 0) s.normal = -s.normal;
#ifdef OBJECTS
    s.vertices = side.xyz;
    s.barycentric = hit.barycentric;
#endif
    return s;
}

int wrapped(int i, int size, int mode) {
    if (mode == kWrapClamp) return clamp(i, 0, size - 1);
    int period = mode == kWrapMirror ? 2 * size : size;
    i = (i + 2 * period) % period;
    return i < size ? i : period - 1 - i;
}

// Moves a coordinate near zero by whole periods.
float reduced(float t, int mode) {
    return mode == kWrapClamp ? clamp(t, -1, 2) : t - 2 * floor(0.5 * t);
}

vec3 hitTexel(uint texel) {
    uint code = texelFetch(hitTexels, int(body.firstTexel + texel)).r;
    uvec3 mantissa = uvec3(code, code >> 9, code >> 18) & 511u;
    return vec3(mantissa) * exp2(float(code >> 27) - 24);
}

// What a texture says, bilinearly interpolated; white if there is none.
vec3 textureAt(uint record, vec2 uv) {
    if (record == kNoRecord) return vec3(1);
    uvec4 t = hitRecord(record);
    ivec2 size = ivec2(t.y & 0xffffu, t.y >> 16), mode = ivec2(t.zw);
    vec2 at = vec2(reduced(uv.x, mode.x), 1 - reduced(uv.y, mode.y)) * vec2(size) - 0.5;
    ivec2 lower = ivec2(floor(at));
    vec2 f = at - vec2(lower);
    uint x0 = uint(wrapped(lower.x, size.x, mode.x));
    uint x1 = uint(wrapped(lower.x + 1, size.x, mode.x));
    uint y0 = t.x + uint(size.x * wrapped(lower.y, size.y, mode.y));
    uint y1 = t.x + uint(size.x * wrapped(lower.y + 1, size.y, mode.y));
    return mix(mix(hitTexel(y0 + x0), hitTexel(y0 + x1), f.x),
               mix(hitTexel(y1 + x0), hitTexel(y1 + x1), f.x), f.y);
}

// A reflectance or radiance of the surface's material: its texel and texture.
vec3 materialColor(HitSurface s, uint texel) {
    uvec4 record = hitRecord(s.range.z + texel);
    return uintBitsToFloat(record.xyz) * textureAt(record.w, s.uv);
}

vec3 irradianceAt(HitSurface s) {
    vec4 u = uintBitsToFloat(hitRecord(s.chart)), v = uintBitsToFloat(hitRecord(s.chart + 1u));
    vec2 at = vec2(dot(u.xyz, s.position) + u.w, dot(v.xyz, s.position) + v.w);
    at = clamp(at, vec2(s.range.xy & 0xffffu), vec2(s.range.xy >> 16));
#ifdef OBJECTS
    if (body.object >= 0)
        return body.litByTexel ? irradianceAtTexel(body, at)
                               : irradianceAtVertices(body, s.vertices, s.front, s.barycentric);
#endif
    return textureLod(irradianceAtlas, at / vec2(textureSize(irradianceAtlas, 0)), 0).rgb;
}

// Radiance that leaves the surface by emission and diffuse reflection.
vec3 ownRadiance(HitSurface s) {
    vec3 radiance = materialColor(s, 0u) * irradianceAt(s) * 0.318309886;
    if (s.front || (s.range.w & uint(kEmitsBothSides)) != 0u) radiance += materialColor(s, 2u);
    return radiance;
}

vec3 mirrorReflectance(HitSurface s) {
    return materialColor(s, 1u);
}

// Reflects against `incoming`: about the geometric normal where the chart is flat or the shading
// normal would send the ray into the surface.
vec3 mirrorDirection(HitSurface s, vec3 incoming) {
    vec3 reflected = reflect(incoming, s.normal);
    bool curved = (s.range.w & uint(kPlanarChart)) == 0u && dot(reflected, s.geometricNormal) > 0;
    return curved ? reflected : reflect(incoming, s.geometricNormal);
}
