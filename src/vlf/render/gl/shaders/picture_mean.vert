// A triangle that covers the viewport.

out vec2 at;  // in [0, 1]² over the viewport

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    at = 2 * corner;
    gl_Position = vec4(4 * corner - 1, 0, 1);
}
