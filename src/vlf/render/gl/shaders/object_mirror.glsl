// The reflection of the line of sight in a mirror on an object.

struct ObjectMirror {
    vec3 side;       // unit: the geometric normal on the side that is seen
    vec3 direction;  // unit
};

ObjectMirror objectMirror() {
    vec3 sight = normalize(position - view.eye.xyz);
    vec3 side = normalize(cross(dFdx(position), dFdy(position)));
    if (dot(side, sight) > 0) side = -side;
    vec3 n = normalize(normal);
    vec3 reflected = reflect(sight, dot(n, side) < 0 ? -n : n);
    return ObjectMirror(side, dot(reflected, side) > 0 ? reflected : reflect(sight, side));
}
