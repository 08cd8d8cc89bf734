// What a mirror shows, by lookup in the radiance field: the same few steps for every pixel of every
// scene. field/radiance_field.h says what is stored, packed_radiance.h how.

layout(binding = kElementUnit) uniform usamplerBuffer elements;
layout(binding = kRecordUnit) uniform usamplerBuffer records;

#include "direction_set.glsl"

const float kMinCosine = 1e-3;

// One direction's subfield along the line of sight, see render/cpu/radiance_lookup.cpp.
struct Sight {
    uvec4 record;
    vec2 cell, drift;
    float metres;
    float weight;
};

uint elementAt(uvec4 record, vec2 at) {
    ivec2 c = ivec2(floor(at)) - ivec2(record.y & 0xffffu, record.y >> 16);
    c.x += 0x8000 - int(floor(uintBitsToFloat(record.w) * float(c.y)));
    uvec2 size = uvec2(record.z & 0xffffu, record.z >> 16);
    if (uint(c.x) >= size.x || uint(c.y) >= size.y) return 0u;
    return texelFetch(elements, int(record.x + uint(c.y) * size.x + uint(c.x))).r;
}

float distanceOf(uint element) {
    return float(bitfieldExtract(element, 0, kDistanceBits));
}

vec3 radianceOf(uint element) {
    uint code = bitfieldExtract(element, kDistanceBits, kSumBits);
    float sum = code == 0u ? 0 : exp2(view.elementCode.y + view.elementCode.z * float(code));
    vec2 share = vec2(bitfieldExtract(element, kDistanceBits + kSumBits, kShareBits),
                      bitfieldExtract(element, kDistanceBits + kSumBits + kShareBits, kShareBits));
    share = view.shareCode.xz + share * view.shareCode.yw;
    return sum * vec3(share.x, max(1 - share.x - share.y, 0), share.y);
}

Sight sightOf(Direction d, float weight, float sense, vec3 toEye) {
    Sight s;
    float cosine = sense * dot(d.vector, geometricNormal);
    uint index = d.index;
    uint lines = uint(view.field.y);
    if (sense < 0) index = index < lines ? index + lines : index - lines;
    s.record = texelFetch(records, int(mirror * 2u * lines + index));
    if (cosine < kMinCosine) s.record.z = 0u;
    // Both senses of a line share a subfield.
    vec3 n = d.index >= lines ? -d.vector : d.vector;
    // frameFromNormal of math/frame.h
    float side = n.z < 0 ? -1 : 1;
    float a = -1 / (side + n.z), b = n.x * n.y * a;
    vec3 x = vec3(1 + side * n.x * n.x * a, side * b, -side * n.x);
    vec3 y = vec3(b, side + n.y * n.y * a, -n.y);
    vec3 p = position - view.fieldFrame.xyz;
    s.cell = view.fieldFrame.w * vec2(dot(x, p), dot(y, p)) + view.field.z;
    s.drift = -view.fieldFrame.w * vec2(dot(x, toEye), dot(y, toEye));
    s.metres = view.elementCode.x / float((1 << kDistanceBits) - 1) * cosine /
               max(dot(toEye, geometricNormal), kMinCosine);
    s.weight = weight;
    return s;
}

#ifdef PLAIN
vec4 bilinear(Sight s) {
    vec2 f = s.cell - 0.5, lower = floor(f), t = f - lower;
    vec4 sum = vec4(0);
    for (int i = 0; i < 4; ++i) {
        vec2 corner = vec2(i & 1, i >> 1);
        uint e = elementAt(s.record, lower + corner);
        vec2 w = mix(1 - t, t, corner);
        if (e != 0u) sum += s.weight * w.x * w.y * vec4(radianceOf(e), 1);
    }
    return sum;
}

vec3 mirrorRadiance() {
    vec3 toEye = normalize(view.eye.xyz - position);
    float sense = toEye.y < 0 ? -1 : 1;
    Triple t = tripleOf(sense * toEye);
    vec4 sum = vec4(0);
    for (int k = 0; k < 3; ++k) sum += bilinear(sightOf(t.corner[k], t.weight[k], sense, toEye));
    return sum.w > 0 ? sum.rgb / sum.w : vec3(0);
}
#else
// The radiance where the line of sight ends as the subfield shows it, and how deep that is; `found`
// is the sight's weight, or 0 if the subfield does not show it.
vec3 follow(Sight s, out float depth, out float found) {
    uint e = elementAt(s.record, s.cell);
    found = e != 0u ? s.weight : 0;
    depth = distanceOf(e) * s.metres;
    for (int i = 0; i < 2; ++i) {
        uint next = elementAt(s.record, s.cell + depth * s.drift);
        if (next != 0u) {
            e = next;
            depth = distanceOf(e) * s.metres;
            found = s.weight;
        }
    }
    return radianceOf(e);
}

vec3 mirrorRadiance() {
    vec3 toEye = normalize(view.eye.xyz - position);
    float sense = toEye.y < 0 ? -1 : 1;
    Triple t = tripleOf(sense * toEye);
    vec3 radiance[3], depth, weight;
    for (int k = 0; k < 3; ++k)
        radiance[k] = follow(sightOf(t.corner[k], sqrt(sqrt(t.weight[k])), sense, toEye), depth[k],
                             weight[k]);
    vec3 far = mix(depth, vec3(1e30), equal(weight, vec3(0)));
    float nearest = min(far.x, min(far.y, far.z));
    vec3 front = weight * vec3(lessThan(far, vec3(nearest + view.field.w)));
    float share = dot(front, vec3(1)) / max(dot(weight, vec3(1)), 1e-20);
    vec3 chosen = share >= 0.5 ? front : weight - front;
    vec3 sum = chosen.x * radiance[0] + chosen.y * radiance[1] + chosen.z * radiance[2];
    return sum / max(dot(chosen, vec3(1)), 1e-20);
}
#endif
