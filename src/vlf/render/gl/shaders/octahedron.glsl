// Unit vectors from octahedron.h.

vec3 fromOctahedron(vec2 e) {
    vec3 v = vec3(e, 1 - abs(e.x) - abs(e.y));
    if (v.z < 0) v.xy = (1 - abs(v.yx)) * vec2(v.x < 0 ? -1 : 1, v.y < 0 ? -1 : 1);
    return normalize(v);
}
