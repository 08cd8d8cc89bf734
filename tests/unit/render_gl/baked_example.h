#pragma once
// An example scene with a small light field.

#include "vlf/propagate/bake.h"
#include "vlf/scene/generate/generate.h"

#include <algorithm>

namespace vlf::test {

struct BakedExample {
    explicit BakedExample(const std::string& name)
        : scene(generateScene(name)), rays(scene), field(bakeDraft(scene)) {}

    static LightField bakeDraft(const Scene& scene) {
        BakeParams params = presetParams("draft");
        params.texelBudget = 5000;
        Progress progress;
        return bake(scene, params, progress);
    }

    const Camera& camera(const std::string& name) const {
        return *std::find_if(scene.cameras.begin(), scene.cameras.end(),
                             [&](const Camera& c) { return c.name == name; });
    }

    Scene scene;
    RayScene rays;
    LightField field;
};

/// The mirror room, made once.
inline const BakedExample& mirrorRoom() {
    static const BakedExample room("mirror-room");
    return room;
}

}  // namespace vlf::test
