#pragma once
// An example scene with its light field, baked by the preset "draft".

#include "vlf/propagate/bake.h"
#include "vlf/scene/generate/generate.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace vlf::test {

inline LightField bakeDraft(const Scene& scene, double texelBudget) {
    BakeParams params = presetParams("draft");
    params.texelBudget = texelBudget;
    Progress progress;
    return bake(scene, params, progress);
}

struct BakedExample {
    explicit BakedExample(const std::string& name,
                          double texelBudget = presetParams("draft").texelBudget)
        : scene(generateScene(name)), rays(scene), field(bakeDraft(scene, texelBudget)) {}

    const Camera& camera(const std::string& name) const {
        const auto found = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                        [&](const Camera& c) { return c.name == name; });
        if (found == scene.cameras.end()) throw std::logic_error("no camera " + name);
        return *found;
    }

    Scene scene;
    RayScene rays;
    LightField field;
};

}  // namespace vlf::test
