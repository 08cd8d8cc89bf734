// The place of the object that is drawn.

layout(binding = kObjectUnit) uniform usamplerBuffer objectRecords;
layout(location = kObjectLocation) uniform int object;

vec4 objectRow(int row) {
    return uintBitsToFloat(texelFetch(objectRecords, kGridTexels + kObjectTexels * object + row));
}

// In the world; w: 1 for points, 0 for directions, which are then scaled.
vec3 placed(vec4 p) {
    return vec3(dot(objectRow(0), p), dot(objectRow(1), p), dot(objectRow(2), p));
}
