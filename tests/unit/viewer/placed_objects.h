#pragma once
// Objects in a small baked room, and what they say.

#include "support/baked_example.h"
#include "viewer/objects.h"

namespace vlf::test {

inline ScenarioObject bodyAt(const std::string& shape, const Vec3& place) {
    ScenarioObject object;
    object.source.primitive = object.object.name = shape;
    object.object.pose = {place, {1, 0, 0, 0}, 0.1f};
    object.object.settings.shading = Shading::flat;
    object.object.settings.shadow = ShadowKind::none;
    return object;
}

/// Lit at more texels than there can be.
inline ObjectSettings unlightable() {
    ObjectSettings settings;
    settings.shading = Shading::gather;
    settings.shadow = ShadowKind::none;
    settings.gather.texelSize = 1e-6f;
    return settings;
}

/// Appears after a second.
inline KeyframeMotion appearing(const Pose& pose) {
    return {{{0, pose, false}, {1, pose, true}}, Interpolation::linear, false};
}

inline std::shared_ptr<const BakedRoom> smallRoom() {
    static const std::shared_ptr<const BakedRoom> room = [] {
        Scene scene = generateScene("cornell");
        LightField field = bakeDraft(scene, 500);
        return std::make_shared<const BakedRoom>(BakedRoom{std::move(scene), std::move(field)});
    }();
    return room;
}

/// A cube and a sphere in the Cornell box, before the blocks.
struct PlacedObjects {
    explicit PlacedObjects(Scenario scenario = {{bodyAt("cube", {3.8f, 0.5f, 1}),
                                                 bodyAt("sphere", {4.8f, 0.5f, 1})}}) {
        ModelLibrary library;
        std::vector<std::string> warnings;
        loadModels(scenario, library, warnings);
        objects = std::make_unique<app::Objects>(std::move(scenario), library,
                                                 [this](const std::string& text) { said = text; });
        objects->enter(room, rays, nullptr);
        update(0);
    }

    bool update(double seconds) {
        return objects->update(seconds, eye, [this](const DynamicRoom&) { ++shows; });
    }

    std::shared_ptr<const BakedRoom> room = smallRoom();
    RayScene rays{room->scene};
    Vec3 eye{4.3f, 1.2f, -0.5f};
    std::string said;
    int shows = 0;
    std::unique_ptr<app::Objects> objects;
};

}  // namespace vlf::test
