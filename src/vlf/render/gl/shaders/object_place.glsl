// The place of the object that is drawn.

layout(location = kPlaceLocation) uniform mat4 place;

// In the world; w: 1 for points, 0 for directions, which are then scaled.
vec3 placed(vec4 p) {
    return (place * p).xyz;
}
