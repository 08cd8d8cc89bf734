// What a mirror, perfect or rough, shows, by lookup in its radiance field: the same few steps for every pixel of every
// scene. field/radiance_field.h says what is stored, packed_radiance.h and
// radiance_layout.h how.

layout(binding = kElementUnit) uniform usamplerBuffer elements;
layout(binding = kRecordUnit) uniform usamplerBuffer records;
layout(std140, binding = kRadianceBlock) uniform RadianceBlock { RadianceData radianceField; };

#include "direction_set.glsl"
#if defined(OBJECTS) || defined(CHANGED)
#include "changed_mirror.glsl"
#endif
#ifdef OBJECTS
#include "mirrored_objects.glsl"
#endif

const float kMinCosine = 1e-3;
const float kNone = 1e30;  // no depth

// One direction's subfield along the line of sight, see render/cpu/radiance_lookup.cpp: at depth s
// it is at cell + s * drift, and an element with distance d is at the depth d * metres.
struct Sight {
    uvec4 record;
    vec2 cell, drift;
    float metres;
    float weight;
};

// The element of column x of a row of cells; 0 where there is none.
uint elementOf(uvec4 record, int row, int x) {
    uvec2 size = uvec2(record.z & 0xffffu, record.z >> 16);
    bool inside = uint(x) < size.x && uint(row) < size.y;
    uint index = inside ? record.x + uint(row) * size.x + uint(x) : 0u;
#ifdef FOUR_A_TEXEL
    uint element = texelFetch(elements, int(index >> 2))[index & 3u];
#else
    uint element = texelFetch(elements, int(index)).r;
#endif
    return inside ? element : 0u;
}

// Row in a record, and column there of the cell with x = 0.
ivec2 rowOf(uvec4 record, int y) {
    int row = y - int(record.y >> 16);
    int shift = int(floor(uintBitsToFloat(record.w) * float(row)));
    return ivec2(row, 0x8000 - int(record.y & 0xffffu) - shift);
}

uint elementAt(uvec4 record, vec2 at) {
    ivec2 cell = ivec2(floor(at)), row = rowOf(record, cell.y);
    return elementOf(record, row.x, row.y + cell.x);
}

// The four cells around a point, and their weights.
uvec4 elementsAround(uvec4 record, vec2 at, out vec4 weights) {
    vec2 lower = floor(at - 0.5), t = at - 0.5 - lower;
    weights = vec4((1 - t.x) * (1 - t.y), t.x * (1 - t.y), (1 - t.x) * t.y, t.x * t.y);
    ivec2 cell = ivec2(lower), a = rowOf(record, cell.y), b = rowOf(record, cell.y + 1);
    return uvec4(elementOf(record, a.x, a.y + cell.x), elementOf(record, a.x, a.y + cell.x + 1),
                 elementOf(record, b.x, b.y + cell.x), elementOf(record, b.x, b.y + cell.x + 1));
}

float distanceOf(uint element) {
    return float(bitfieldExtract(element, 0, kDistanceBits));
}

// Of the sum of red, green and blue.
float rootOf(uint element) {
    float code = float(bitfieldExtract(element, kDistanceBits, kSumBits));
    return exp2(0.5 * (radianceField.elementCode.y + radianceField.elementCode.z * code));
}

// Of red and blue in that sum.
vec2 sharesOf(uint element) {
    uvec2 code = uvec2(bitfieldExtract(element, kDistanceBits + kSumBits, kRedBits),
                       bitfieldExtract(element, kDistanceBits + kSumBits + kRedBits, kBlueBits));
    return radianceField.shareCode.xz + vec2(code) * radianceField.shareCode.yw;
}

vec3 radianceOf(float sum, vec2 shares) {
    return sum * vec3(shares.x, max(1 - shares.x - shares.y, 0), shares.y);
}

Sight sightOf(Direction d, float weight, float sense, vec3 toEye) {
    Sight s;
    float cosine = sense * dot(d.vector, geometricNormal);
    uint index = d.index;
    uint lines = uint(radianceField.field.y);
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
    vec3 p = position - radianceField.frame.xyz;
    s.cell = radianceField.frame.w * vec2(dot(x, p), dot(y, p)) + radianceField.field.z;
    s.drift = -radianceField.frame.w * vec2(dot(x, toEye), dot(y, toEye));
    s.metres = radianceField.elementCode.x / float((1 << kDistanceBits) - 1) * cosine /
               max(dot(toEye, geometricNormal), kMinCosine);
    s.weight = weight;
    return s;
}

#if defined(PLAIN) || defined(ROUGH)
#ifdef PLAIN
const int kDepthSteps = 0;
#else
const int kDepthSteps = 2;  // towards the mean depth of what a rough mirror shows
#endif

// At a depth of the line of sight. Adds depths, too, as often as radiances count.
vec4 bilinear(Sight s, float at, inout float depth) {
    vec4 weights;
    uvec4 e = elementsAround(s.record, s.cell + at * s.drift, weights);
    vec4 sum = vec4(0);
    for (int i = 0; i < 4; ++i) {
        float root = rootOf(e[i]), w = e[i] != 0u ? s.weight * weights[i] : 0;
        sum += w * vec4(radianceOf(root * root, sharesOf(e[i])), 1);
        depth += w * distanceOf(e[i]) * s.metres;
    }
    return sum;
}

vec3 mirrorRadiance() {
    vec3 toEye = normalize(view.eye.xyz - position);
    float sense = toEye.y < 0 ? -1 : 1;
    Triple t = tripleOf(sense * toEye);
    Sight sights[3];
    for (int k = 0; k < 3; ++k) sights[k] = sightOf(t.corner[k], t.weight[k], sense, toEye);
    vec3 radiance = vec3(0);
    float distance_ = kNone;
    for (int i = 0; i <= kDepthSteps; ++i) {
        vec4 sum = vec4(0);
        float depth = 0;
        for (int k = 0; k < 3; ++k)
            sum += bilinear(sights[k], distance_ == kNone ? 0 : distance_, depth);
        if (sum.w == 0) break;
        radiance = sum.rgb / sum.w;
        distance_ = depth / sum.w;
    }
#ifdef OBJECTS
    radiance = withObjects(radiance, radiance, distance_, distance_, 1, toEye);
#elif defined(CHANGED)
    radiance = withChange(radiance, distance_, distance_, 1, toEye);
#endif
    return radiance;
}
#else
const int kSteps = 4;
const float kStray = 1e-4;  // weight of samples at other depths: they count where no others are
const float kEdgeSoftness = 0.4;  // width of the blend at an edge, in votes

// Depth of the first surface that the line of sight meets, cells taken as flat; where it passes
// behind one, the depth that was seen just before. kNone where the mirror is not seen.
float firstSurface(Sight s) {
    float longest = float((1 << kDistanceBits) - 1);
    uint e = elementAt(s.record, s.cell);
    float seen = e != 0u ? distanceOf(e) * s.metres : kNone;
    float stride = (e != 0u ? distanceOf(e) : longest) * s.metres / kSteps;
    bool done = false;
    for (int i = 1; i <= kSteps; ++i) {
        float reached = stride * i;
        e = elementAt(s.record, s.cell + reached * s.drift);
        float depth = distanceOf(e) * s.metres;
        bool past = seen != kNone && (e == 0u || depth < reached - stride - radianceField.field.w);
        if (!done && !past && e != 0u) seen = depth;
        done = done || past || seen < reached + stride;
    }
    return seen;
}

// What the subfields show around the point of the line of sight at one depth.
struct Layer {
    float inverseRoot, root;  // means, of the samples at that depth
    vec2 shares;
    float weight;   // of all samples
    float surface;  // of those at that depth
    float open;     // of those that see through to something deeper
    float behind;   // least depth of these
};

// Shares count by the root of the sum, and the sum is the power mean of the samples' with exponent
// -1/2: a lamp's edge does not bleed.
Layer layerAt(Sight sights[3], float depth) {
    Layer l = Layer(0, 0, vec2(0), 0, 0, 0, kNone);
    for (int k = 0; k < 3; ++k) {
        Sight s = sights[k];
        vec4 weights;
        uvec4 around = elementsAround(s.record, s.cell + depth * s.drift, weights);
        for (int i = 0; i < 4; ++i) {
            uint e = around[i];
            float w = e != 0u ? s.weight * weights[i] : 0;
            float beyond = distanceOf(e) * s.metres - depth;
            bool here = abs(beyond) <= radianceField.field.w;
            bool open = beyond > radianceField.field.w;
            float weight = here ? w : kStray * w;
            float root = rootOf(e);
            l.inverseRoot += weight / root;
            l.root += weight * root;
            l.shares += weight * root * sharesOf(e);
            l.weight += weight;
            l.surface += here ? w : 0;
            l.open += open ? w : 0;
            l.behind = open ? min(l.behind, depth + beyond) : l.behind;
        }
    }
    l.inverseRoot /= max(l.weight, 1e-20);
    l.shares /= max(l.root, 1e-20);
    return l;
}

vec3 radianceOf(Layer l) {
    return l.inverseRoot > 0 ? radianceOf(1 / (l.inverseRoot * l.inverseRoot), l.shares) : vec3(0);
}

// How much of the line of sight ends in a layer; at an edge the samples vote.
float coverageOf(Layer l) {
    if (l.surface == 0) return 0;
    float vote = l.surface / (l.surface + l.open);
    return clamp((vote - 0.5) / kEdgeSoftness + 0.5, 0, 1);
}

vec3 mirrorRadiance() {
    vec3 toEye = normalize(view.eye.xyz - position);
    float sense = toEye.y < 0 ? -1 : 1;
    Triple t = tripleOf(sense * toEye);
    Sight sights[3];
    vec3 depths;
    for (int k = 0; k < 3; ++k) {
        // Parallax is corrected: all three are nearly equally good, but fade in and out.
        sights[k] = sightOf(t.corner[k], sqrt(sqrt(t.weight[k])), sense, toEye);
        depths[k] = firstSurface(sights[k]);
    }
    float nearest = min(depths.x, min(depths.y, depths.z));
    Layer front = layerAt(sights, nearest);
    vec3 deeper = mix(vec3(kNone), depths, greaterThan(depths, vec3(nearest + radianceField.field.w)));
    float behind = min(front.behind, min(deeper.x, min(deeper.y, deeper.z)));
    // At depth 0 all samples are stray: the plain lookup, for where there is no other.
    Layer back = layerAt(sights, behind != kNone ? behind : 0);
    float coverage = behind == kNone || back.weight == 0 ? 1 : coverageOf(front);
    if (front.weight == 0) coverage = 0;
    float inverseRoot = mix(back.inverseRoot, front.inverseRoot, coverage);
    vec2 shares = mix(back.shares, front.shares, coverage);
    vec3 seen = inverseRoot > 0 ? radianceOf(1 / (inverseRoot * inverseRoot), shares) : vec3(0);
#ifdef OBJECTS
    seen = withObjects(seen, radianceOf(front), nearest, behind, coverage, toEye);
#elif defined(CHANGED)
    seen = withChange(seen, nearest, behind, coverage, toEye);
#endif
    return seen;
}
#endif
