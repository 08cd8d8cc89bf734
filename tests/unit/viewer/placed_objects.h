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
    explicit PlacedObjects(Scenario scenario = {
                               {bodyAt("cube", {3.8f, 0.5f, 1}), bodyAt("sphere", {4.8f, 0.5f, 1})}}) {
        ModelLibrary library;
        std::vector<std::string> warnings;
        loadModels(scenario, library, warnings);
        objects = std::make_unique<app::Objects>(std::move(scenario), library,
                                                 [this](const std::string& text) { said = text; });
        objects->enter(room, rays, nullptr);
        objects->update(0, eye);
    }

    std::shared_ptr<const BakedRoom> room = smallRoom();
    RayScene rays{room->scene};
    Vec3 eye{4.3f, 1.2f, -0.5f};
    std::string said;
    std::unique_ptr<app::Objects> objects;
};

}  // namespace vlf::test
