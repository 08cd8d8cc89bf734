// The objects in the room, from their records (kObjectTexels).
#include "objects_block.glsl"

layout(binding = kVertexLightUnit) uniform samplerBuffer vertexLight;
layout(binding = kObjectAtlasUnit) uniform sampler2D objectAtlas;

// An object or the room: its axes and place in the world, and where what is known of it begins.
struct Body {
    int object;  // -1: the room
    mat3 axes;
    vec3 origin;
    float inverseSquare;  // of the axes' length
    uint firstRecord, firstTexel;
    uint firstVertex, firstLight, backLights;
    uvec2 atlasPlace;
    bool litByTexel;
    int probe;  // layer; -1: none
};

const Body kRoomBody =
    Body(-1, mat3(1), vec3(0), 1, 0u, 0u, 0u, 0u, 0u, uvec2(0), false, -1);

uvec4 objectRecord(int object, int texel) {
    return texelFetch(objectRecords, kGridTexels + kObjectTexels * object + texel);
}

Body bodyOf(int object) {
    vec4 x = uintBitsToFloat(objectRecord(object, 0)), y = uintBitsToFloat(objectRecord(object, 1)),
         z = uintBitsToFloat(objectRecord(object, 2));
    uvec4 hierarchy = objectRecord(object, 4), first = objectRecord(object, 5),
          light = objectRecord(object, 6);
    return Body(object, transpose(mat3(x.xyz, y.xyz, z.xyz)), vec3(x.w, y.w, z.w),
                uintBitsToFloat(hierarchy.x), first.x, first.y, first.z, first.w, light.w,
                light.xy, (light.z & uint(kLitByTexel)) != 0u,
                int(light.z >> kProbeShift) - 1);
}

vec3 toBody(Body body, vec3 direction) {
    return body.inverseSquare * (direction * body.axes);
}

vec3 irradianceAtTexel(Body body, vec2 at) {
    vec2 place = vec2(body.atlasPlace) + at;
    return textureLod(objectAtlas, place / vec2(textureSize(objectAtlas, 0)), 0).rgb;
}

vec3 irradianceAtVertices(Body body, uvec3 records, bool front, vec2 barycentric) {
    uvec3 v = body.firstLight + (front ? 0u : body.backLights) + (records - body.firstVertex) / 2u;
    mat3 corners = mat3(texelFetch(vertexLight, int(v.x)).rgb, texelFetch(vertexLight, int(v.y)).rgb,
                        texelFetch(vertexLight, int(v.z)).rgb);
    return corners * vec3(1 - barycentric.x - barycentric.y, barycentric);
}

// Whether a ray, its direction a unit vector, comes into a sphere before tMax.
bool entersSphere(vec4 sphere, vec3 origin, vec3 direction, float tMax) {
    vec3 c = sphere.xyz - origin;
    float along = dot(c, direction), square = dot(c, c), r = sphere.w * sphere.w;
    float half_ = r - square + along * along;
    return half_ > 0 && (square < r || (along > 0 && along - sqrt(max(half_, 0)) < tMax));
}

// The closest intersection with an object, if it is nearer than `hit`; its number, or -1. As in
// trace.glsl, rays that go in step wait for each other until each is in some object's sphere; where
// none is, the loops, unlike branches, are skipped.
int traceObjects(vec3 origin, vec3 direction, inout TraceHit hit) {
    int found = -1;
    int i = entersSphere(objects.sphere, origin, direction, hit.t) ? 0 : objects.counts.x;
    while (i < objects.counts.x) {
        while (i < objects.counts.x &&
               !entersSphere(uintBitsToFloat(objectRecord(i, 3)), origin, direction, hit.t))
            ++i;
        if (i >= objects.counts.x) break;
        Body o = bodyOf(i);
        uvec4 hierarchy = objectRecord(i, 4);
        TraceBody trace = TraceBody(int(hierarchy.y), int(hierarchy.z), int(hierarchy.w));
        if (traceNearer(trace, toBody(o, origin - o.origin), toBody(o, direction), 0, hit))
            found = i;
        ++i;
    }
    return found;
}
