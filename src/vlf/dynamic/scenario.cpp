#include "vlf/dynamic/scenario.h"

#include "vlf/base/error.h"
#include "vlf/scene/generate/primitives.h"
#include "vlf/scene/import/import.h"

#include <algorithm>

#include <fmt/format.h>

namespace vlf {

namespace {

void replace(Material& material, const ObjectSource& source) {
    if (source.diffuse) material.diffuse = *source.diffuse, material.diffuseTexture = -1;
    if (source.mirror) material.mirror = *source.mirror, material.mirrorTexture = -1;
    if (source.emission) material.emission = *source.emission, material.emissionTexture = -1;
    const float most = maxComponent(material.diffuse + material.mirror);
    if (most > 1) material.diffuse /= most, material.mirror /= most;
}

Scene sceneOf(const ObjectSource& source, std::vector<std::string>& warnings) {
    Material material;
    material.name = source.primitive;
    if (!source.primitive.empty()) return makePrimitive(source.primitive, material);
    ImportReport report;
    Scene scene = importScene({source.file}, report);
    warnings.insert(warnings.end(), report.warnings.begin(), report.warnings.end());
    if (makeGlossDiffuse(scene))
        warnings.push_back(source.file + ": glossy reflection of objects is treated as diffuse");
    return scene;
}

}  // namespace

std::string ObjectSource::key() const {
    std::string text = primitive + '\n' + file;
    for (const auto& colour : {diffuse, mirror, emission})
        text += colour ? fmt::format("\n{} {} {}", colour->x, colour->y, colour->z) : "\n";
    return text;
}

std::shared_ptr<const ObjectModel> ModelLibrary::model(const ObjectSource& source,
                                                       std::vector<std::string>& warnings) {
    std::weak_ptr<const ObjectModel>& known = models_[source];
    if (auto model = known.lock()) return model;
    Scene scene = sceneOf(source, warnings);
    for (Material& material : scene.materials) replace(material, source);
    const auto model = std::make_shared<const ObjectModel>(std::move(scene));
    known = model;
    return model;
}

std::string unusedName(const Scenario& scenario, const std::string& name) {
    const auto used = [&](const std::string& candidate) {
        return std::any_of(scenario.objects.begin(), scenario.objects.end(),
                           [&](const ScenarioObject& o) { return o.object.name == candidate; });
    };
    std::string candidate = name;
    for (int n = 2; used(candidate); ++n) candidate = fmt::format("{} {}", name, n);
    return candidate;
}

void loadModels(Scenario& scenario, ModelLibrary& library, std::vector<std::string>& warnings) {
    for (ScenarioObject& object : scenario.objects) {
        if (object.object.model) continue;
        try {
            object.object.model = library.model(object.source, warnings);
        } catch (const Error& e) {
            throw InputError(fmt::format("object '{}': {}", object.object.name, e.what()));
        }
    }
}

std::vector<DynamicObject> objectsAt(const Scenario& scenario, double seconds) {
    std::vector<DynamicObject> objects;
    for (const ScenarioObject& moving : scenario.objects) {
        objects.push_back(moving.object);
        objects.back().pose = poseAt(moving.motion, moving.object.pose, seconds);
        objects.back().visible = visibleAt(moving.motion, moving.object.visible, seconds);
    }
    return objects;
}

}  // namespace vlf
