#include "vlf/scene/scene_hash.h"

#include <cinttypes>
#include <cstdio>
#include <memory>

#include <xxhash.h>

namespace vlf {

namespace {

class Hasher {
  public:
    Hasher() : state_(XXH3_createState(), XXH3_freeState) { XXH3_128bits_reset(state_.get()); }

    template <class T>
    void add(const T& value) {
        XXH3_128bits_update(state_.get(), &value, sizeof value);
    }
    template <class T>
    void add(const std::vector<T>& values) {
        add(values.size());
        XXH3_128bits_update(state_.get(), values.data(), values.size() * sizeof(T));
    }
    std::string text() const {
        const XXH128_hash_t h = XXH3_128bits_digest(state_.get());
        char digits[33];
        std::snprintf(digits, sizeof digits, "%016" PRIx64 "%016" PRIx64,
                      static_cast<std::uint64_t>(h.high64), static_cast<std::uint64_t>(h.low64));
        return digits;
    }

  private:
    std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

/// Of a scene without any nothing is added.
void addLights(const std::vector<PunctualLight>& lights, Hasher& hash) {
    if (lights.empty()) return;
    hash.add(lights.size());
    for (const PunctualLight& light : lights) {
        hash.add(light.kind);
        for (const Vec3& v : {light.position, light.direction, light.intensity}) hash.add(v);
        hash.add(light.innerCone);
        hash.add(light.outerCone);
    }
}

/// Likewise.
void addEnvironment(const Environment& environment, Hasher& hash) {
    if (environment.isBlack()) return;
    hash.add(environment.radiance);
    hash.add(environment.picture.width);
    hash.add(environment.picture.height);
    hash.add(environment.picture.pixels);
    hash.add(environment.turn);
}

}  // namespace

std::string sceneHash(const Scene& scene) {
    Hasher hash;
    hash.add(scene.positions);
    hash.add(scene.normals);
    hash.add(scene.uvs);
    hash.add(scene.triangles);
    for (const Material& m : scene.materials) {
        for (const Vec3& v : {m.diffuse, m.mirror, m.emission, m.transmission}) hash.add(v);
        hash.add(m.roughness);
        for (const int t : {m.diffuseTexture, m.mirrorTexture, m.emissionTexture}) hash.add(t);
        hash.add(m.emitsBothSides);
        hash.add(m.ior);
        hash.add(m.thin);
    }
    for (const Texture& t : scene.textures) {
        hash.add(t.width);
        hash.add(t.height);
        hash.add(t.srgb8);
        hash.add(t.linear);
        hash.add(t.wrapU);
        hash.add(t.wrapV);
    }
    addLights(scene.lights, hash);
    addEnvironment(scene.environment, hash);
    return hash.text();
}

}  // namespace vlf
