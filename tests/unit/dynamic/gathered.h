#pragma once
// What an object that is alone in a room gathers from it, all light of the room known.

#include "lit_room.h"
#include "vlf/dynamic/gather_sights.h"
#include "vlf/dynamic/lit_room.h"
#include "vlf/scene/generate/primitives.h"

#include <memory>
#include <string>
#include <vector>

namespace vlf::test {

struct Gathered {
    std::unique_ptr<const ObjectReceivers> receivers;
    std::vector<Vec3> irradiance;  ///< by receiver

    Gathered(const LitRoom& room, const ObjectModel& model, const GatherSettings& settings,
             float cellsAcross, const Pose& pose)
        : receivers(makeReceivers(model, settings)), irradiance(receivers->size(), Vec3(0)) {
        const std::vector<Vec3> direct(receivers->size(), Vec3(0));
        LitObject lit;
        lit.mesh = receivers->mesh;
        lit.pose = pose;
        const RayInstance instance{&lit.mesh->rays, pose};
        RayInstances instances;
        instances.place({&instance, 1});
        const Sphere sphere{pose.point(model.bounds().centre), pose.scale * model.bounds().radius};
        Coverage coverage(room.texels);
        coverage.find(room.scene, room.rays, room.texels, instances, {&lit, 1}, {&sphere, 1});
        const GatherPlan plan = makeGatherPlan(*receivers, model.bounds(),
                                               {settings.lines, settings.step, cellsAcross});
        const vlf::LitRoom around{room.scene, room.rays, room.texels, room.radiance};
        const SightObjects objects{&instances, {&lit, 1}, 0};
        GatherSights sights;
        sights.pickDirections(plan, model.bounds().centre, settings.importanceSamples, pose, around,
                              objects);
        sights.trace(plan, *receivers, pose, around, objects, coverage, {},
                     settings.emittersByDirections);
        sights.gather(plan, *receivers, room.radiance, {&lit, 1}, direct, irradiance);
    }
};

inline ObjectModel bodyOf(const std::string& primitive, const Vec3& diffuse) {
    Material material;
    material.diffuse = diffuse;
    return ObjectModel(makePrimitive(primitive, material));
}

}  // namespace vlf::test
