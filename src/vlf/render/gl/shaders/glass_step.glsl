// Paths that come to glass.
#include "glass_split.glsl"

// How glass divides a ray.
struct GlassSplit {
    vec3 reflected, transmitted;  // directions
    vec3 weights;                 // of the transmitted ray's radiance
    float reflectance;            // of the reflected ray's
};

bool isGlass(HitSurface s) {
    return (s.range.w & uint(kGlassChart)) != 0u;
}

GlassSplit splitAtGlass(HitSurface s, vec3 incoming) {
    vec4 glass = uintBitsToFloat(hitRecord(s.range.z + 3u));  // transmission, index of refraction
    bool flat_ = (s.range.w & uint(kPlanarChart)) != 0u;
    vec3 n = !flat_ && dot(s.normal, incoming) < -1e-4 ? s.normal : s.geometricNormal;
    GlassSplit g;
    g.reflected = reflect(incoming, n);
    if (dot(g.reflected, s.geometricNormal) <= 0) g.reflected = reflect(incoming, s.geometricNormal);
    float scale = 1;
    if ((s.range.w & uint(kPaneChart)) != 0u) {
        g.reflectance = paneReflectance(-dot(s.geometricNormal, incoming), glass.w);
        g.transmitted = incoming;
    } else {
        float eta = s.front ? glass.w : 1 / glass.w;
        g.transmitted = refract(incoming, n, 1 / eta);
        if (dot(g.transmitted, s.geometricNormal) >= 0) {
            n = s.geometricNormal;
            g.transmitted = refract(incoming, n, 1 / eta);
        }
        g.reflectance = g.transmitted == vec3(0) ? 1 : fresnelReflectance(-dot(n, incoming), eta);
        scale = 1 / (eta * eta);
    }
    g.weights = (1 - g.reflectance) * scale * glass.rgb;
    return g;
}

// Goes on with one of the rays.
void followGlass(HitSurface s, GlassSplit g, bool transmits, inout TracedPath path) {
    path.throughput *= transmits ? g.weights : vec3(g.reflectance);
    path.direction = transmits ? g.transmitted : g.reflected;
    path.origin = s.position + (transmits ? -view.eye.w : view.eye.w) * s.geometricNormal;
}

// Goes on with the stronger ray; the other one's light is lost.
void passGlass(HitSurface s, inout TracedPath path) {
    GlassSplit g = splitAtGlass(s, path.direction);
    float passes = (1 - g.reflectance) *
                   maxOf(uintBitsToFloat(hitRecord(s.range.z + 3u)).rgb);
    followGlass(s, g, passes > g.reflectance, path);
}
