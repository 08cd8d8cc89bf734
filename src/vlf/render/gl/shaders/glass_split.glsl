// Smooth glass; as math/glass.h.

// The share that a surface reflects; `eta`: index of refraction beyond it by that before it.
float fresnelReflectance(float cosine, float eta) {
    float c = clamp(cosine, 0, 1);
    float beyond2 = 1 - (1 - c * c) / (eta * eta);
    if (beyond2 <= 0) return 1;
    float beyond = sqrt(beyond2);
    float parallel = (eta * c - beyond) / (eta * c + beyond);
    float across = (c - eta * beyond) / (c + eta * beyond);
    return 0.5 * (parallel * parallel + across * across);
}

float paneReflectance(float cosine, float ior) {
    float r = fresnelReflectance(cosine, ior);
    return 2 * r / (1 + r);
}
