// The environment; as scene/environment.cpp.

layout(binding = kSkyUnit) uniform sampler2D skyPicture;

// From a unit direction.
vec3 skyRadiance(vec3 direction) {
    float azimuth = atan(direction.x, -direction.z);
    vec2 place = vec2(0.5 + 0.159154943 * azimuth + view.skyRight.w,
                      0.318309886 * atan(length(direction.xz), direction.y));
    return textureLod(skyPicture, place, 0).rgb;
}
