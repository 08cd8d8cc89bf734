// The direction set by arithmetic alone; field/direction_set.h describes it.

const float kQuarterTurn = 1.57079632679;

// Angle of (x, z) in quarter turns, in [0, 4].
float quarterTurns(float x, float z) {
    float t = atan(z, x) * (1 / kQuarterTurn);
    return t < 0 ? t + 4 : t;
}

struct Direction {
    vec3 vector;  // unit
    uint index;
};

// The point of ring k at `position`, in the upper half.
Direction directionOf(float ring, float position) {
    float rings = radianceField.field.x;
    float r = ring / rings;
    float horizontal = r * sqrt(2 - r * r);
    float phi = ring > 0 ? kQuarterTurn * position / ring : 0;
    Direction d;
    d.vector = vec3(horizontal * cos(phi), 1 - r * r, horizontal * sin(phi));
    float perRing = 4 * ring;
    float p = position < perRing ? position : position - perRing;
    bool opposite = ring == rings && p >= 2 * rings;
    float index = ring > 0 ? 1 + 2 * ring * (ring - 1) + p : 0;
    if (opposite) index += radianceField.field.y - 2 * rings;
    d.index = uint(index + 0.5);
    return d;
}

struct Triple {
    Direction corner[3];
    vec3 weight;
};

// The triangle around unit vector d of the upper half, and weights: d is parallel to the sum of
// weight times corner. Edges are great circles on the sphere but not in the grid, so that d may lie
// a little beyond an edge; the third weight is then 0.
Triple tripleOf(vec3 d) {
    float rings = radianceField.field.x;
    float ring = min(rings * sqrt(dot(d.xz, d.xz) / (1 + d.y)), rings);
    float turns = quarterTurns(d.x, d.z);
    float octant = min(floor(turns), 3);
    float row = min(floor(ring), rings - 1);
    float along = (turns - octant) * ring;
    float down = ring - row;
    float column = clamp(floor(along), 0, row);
    float s = along - column;
    bool up = s <= down || column == row;
    vec2 upper = vec2(row, octant * row + column);
    vec2 lower = vec2(row + 1, octant * (row + 1) + column);
    vec2 lowerNext = lower + vec2(0, 1);
    vec2 second = up ? lowerNext : upper + vec2(0, 1);
    vec2 third = up ? lower : lowerNext;
    Triple t;
    t.corner[0] = directionOf(upper.x, upper.y);
    t.corner[1] = directionOf(second.x, second.y);
    t.corner[2] = directionOf(third.x, third.y);
    vec3 u = t.corner[0].vector - d, v = t.corner[1].vector - d, w = t.corner[2].vector - d;
    t.weight = max(vec3(dot(d, cross(v, w)), dot(d, cross(w, u)), dot(d, cross(u, v))), 0);
    t.weight /= max(dot(t.weight, vec3(1)), 1e-20);
    return t;
}
