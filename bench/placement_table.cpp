// placement_table [--scene cornell] [--preset standard] [--sheets DIR] [--json FILE] ...
// Cubes at eight places of an example scene, each white, red and green, lit by several methods,
// against the room baked again with them: mean error of the radiance of their visible faces, FLIP,
// and error of the room's light in per cent of its change.

#include "vlf/dynamic/rebake.h"
#include "vlf/image/contact_sheet.h"
#include "vlf/image/flip.h"
#include "vlf/image/heat_map.h"
#include "vlf/image/image_io.h"
#include "vlf/image/tone_map.h"
#include "vlf/render/cpu/object_faces.h"
#include "vlf/render/cpu/still.h"
#include "vlf/scene/generate/generate.h"
#include "vlf/scene/generate/primitives.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace vlf;

/// A cube, with where it is looked at from: metres from it.
struct Placement {
    const char* name;
    Vec3 at;
    float size;
    bool rests;  ///< falls from `at` onto what is beneath
    Vec3 eye;
    bool between = false;  ///< two white cubes of its size beside it
};

const std::map<std::string, std::vector<Placement>> kPlacements{
    {"cornell",
     {{"in the air, in light", {2.78f, 2.2f, 1.2f}, 0.3f, false, {-0.7f, 0.6f, -1.1f}},
      {"on the floor, in light", {3.6f, 1, 1.2f}, 0.3f, true, {-0.8f, 0.8f, -1.0f}},
      {"in the tall block's shadow", {5.1f, 1, 4.6f}, 0.3f, true, {-0.5f, 1.1f, -1.6f}},
      {"beside the green wall", {0.16f, 0.6f, 0.9f}, 0.2f, false, {0.8f, 0.4f, -0.5f}},
      {"beside the red wall", {5.36f, 1, 1.2f}, 0.2f, true, {-0.8f, 0.5f, -0.4f}},
      {"on the short block", {1.8f, 2, 1.7f}, 0.2f, true, {-0.5f, 0.5f, -0.7f}},
      {"between two cubes", {3.9f, 1, 0.9f}, 0.3f, true, {-0.5f, 1.0f, -1.1f}, true},
      {"small, on the floor", {2.9f, 0.5f, 0.5f}, 0.1f, true, {-0.3f, 0.3f, -0.4f}}}},
    {"office",
     {{"in the air", {2.3f, 1.3f, 2.3f}, 0.3f, false, {-0.7f, 0.5f, 1.1f}},
      {"under the desk", {2.6f, 0.5f, 0.45f}, 0.2f, true, {-0.2f, 0.15f, 1.0f}},
      {"on the rug", {2.0f, 0.5f, 2.4f}, 0.3f, true, {-0.7f, 0.8f, 1.0f}},
      {"on the desk", {2.45f, 1.2f, 0.6f}, 0.1f, true, {0.1f, 0.35f, 0.6f}},
      {"beside the bush", {4.1f, 0.5f, 3.3f}, 0.3f, true, {-1.1f, 0.7f, -0.6f}},
      {"on the cabinet", {0.2f, 1.2f, 1.6f}, 0.2f, true, {0.8f, 0.4f, 0.4f}},
      {"between two cubes", {1.5f, 0.5f, 3.0f}, 0.3f, true, {0.5f, 1.0f, -1.1f}, true},
      {"on the floor by the window", {4.6f, 0.5f, 2.2f}, 0.1f, true, {-0.4f, 0.35f, 0.3f}}}}};

struct Colour {
    const char* name;
    Vec3 diffuse;
};
const std::vector<Colour> kColours{{"white", {0.725f, 0.71f, 0.68f}},
                                   {"red", {0.63f, 0.065f, 0.05f}},
                                   {"green", {0.14f, 0.45f, 0.091f}}};

struct Method {
    const char* name;
    Shading shading;
    ShadowKind shadow;
};
const std::vector<Method> kMethods{{"gather+field", Shading::gather, ShadowKind::field},
                                   {"prt+soft", Shading::prt, ShadowKind::soft},
                                   {"lights+hard", Shading::lights, ShadowKind::hard}};

struct Options {
    std::string scene = "cornell", preset = "standard", sheets, json;
    std::vector<std::string> only;  ///< colours; empty: all
    int placement = 0;              ///< from 1; 0: all
    int samples = 16;  ///< shadow rays per texel of both bakes: their noise is not the method's
    int width = 320, height = 240;
};

struct Result {
    double meanFace = 0, worstFace = 0, flip = 0, change = 0, room = 0;
};

class PlacementTable {
  public:
    explicit PlacementTable(const Options& options)
        : options_(options), scene_(generateScene(options.scene)), rays_(scene_) {
        Progress progress;
        BakeParams params = presetParams(options.preset);
        params.radianceDirections = 0;
        params.directSamples = options.samples;
        field_ = bake(scene_, params, progress);
    }

    void run() {
        std::printf("%-28s %-6s %-13s %8s %8s %8s %9s %8s\n", "place", "cube", "method", "face %",
                    "worst %", "FLIP", "change %", "room %");
        int number = 0;
        for (const Placement& placement : kPlacements.at(options_.scene)) {
            if (++number != options_.placement && options_.placement != 0) continue;
            for (const Colour& colour : kColours)
                if (options_.only.empty() ||
                    std::ranges::find(options_.only, colour.name) != options_.only.end())
                    compare(placement, colour, number);
        }
        printMeans();
    }

    const nlohmann::ordered_json& report() const { return report_; }

  private:
    std::vector<DynamicObject> objectsOf(const Placement& placement, const Colour& colour) const {
        Vec3 at = placement.at;
        if (placement.rests) at.y += 0.5f * placement.size - rays_.closest({at, {0, -1, 0}}).t;
        std::vector<DynamicObject> objects{cube(at, placement.size, colour.diffuse)};
        if (placement.between)
            for (const float side : {-1.4f, 1.4f})
                objects.push_back(cube(at + side * placement.size * Vec3(1, 0, 0), placement.size,
                                       kColours[0].diffuse));
        return objects;
    }

    static DynamicObject cube(const Vec3& at, float size, const Vec3& diffuse) {
        Material material;
        material.diffuse = diffuse;
        DynamicObject object;
        object.name = "cube";
        object.model = std::make_shared<ObjectModel>(makePrimitive("cube", material));
        object.pose.translation = at;
        object.pose.scale = size;
        return object;
    }

    StillParams still(const Vec3& look, const Vec3& eye) const {
        StillParams params;
        params.camera.look = look;
        params.camera.eye = look + eye;
        params.width = options_.width, params.height = options_.height;
        return params;
    }

    void compare(const Placement& placement, const Colour& colour, int number) {
        DynamicRoom room(scene_, rays_, field_);
        for (DynamicObject& object : objectsOf(placement, colour)) room.add(std::move(object));
        room.update();
        Progress progress;
        BakeParams params = paramsOf(field_.record);
        const RebakedRoom rebaked = rebake(room, params, progress);
        StillParams shown = still(room.object(0).pose.translation, placement.eye);
        const Image truth =
            renderStill(rebaked.scene, RayScene(rebaked.scene), rebaked.field, shown, progress);
        shown.objects = &room;
        for (const Method& method : kMethods) {
            for (std::size_t i = 0; i < room.size(); ++i) {
                ObjectSettings settings = room.object(i).settings;
                settings.shading = method.shading, settings.shadow = method.shadow;
                room.setSettings(i, settings);
            }
            room.update();
            const Image picture = renderStill(scene_, rays_, field_, shown, progress);
            const std::string name = std::to_string(number) + "-" + colour.name + "-" + method.name;
            const Result result = judge(room, rebaked.field, shown.camera, picture, truth, name);
            std::printf("%-28s %-6s %-13s %8.2f %8.2f %8.4f %9.1f %8.3f\n", placement.name,
                        colour.name, method.name, 100 * result.meanFace, 100 * result.worstFace,
                        result.flip, 100 * result.change, 100 * result.room);
            std::fflush(stdout);
            all_[method.name].push_back(result);
            report_.push_back({{"scene", options_.scene},
                               {"place", placement.name},
                               {"cube", colour.name},
                               {"method", method.name},
                               {"meanFaceError", result.meanFace},
                               {"worstFaceError", result.worstFace},
                               {"flip", result.flip},
                               {"changeError", result.change},
                               {"roomRelRmse", result.room}});
        }
    }

    Result judge(const DynamicRoom& room, const LightField& rebaked, const Camera& camera,
                 const Image& picture, const Image& truth, const std::string& name) const {
        const float exposure = autoExposure(truth);
        const Image mapped = toneMap(picture, exposure, ToneCurve::filmic),
                    mappedTruth = toneMap(truth, exposure, ToneCurve::filmic);
        const FlipResult difference = flip(mapped, mappedTruth);
        if (!options_.sheets.empty()) {
            ContactSheetLayout layout;
            layout.columns = 3, layout.cellWidth = picture.width;
            const std::vector<Image> cells{
                mapped, mappedTruth,
                heatMap(difference.error, picture.width, picture.height, 0.5f)};
            writePng(options_.sheets + "/" + name + ".png", contactSheet(cells, layout));
        }
        Result result;
        const std::vector<FaceRadiance> faces = compareFaces(room, rays_, camera, picture, truth);
        result.meanFace = meanFaceError(faces);
        for (const FaceRadiance& face : faces)
            result.worstFace = std::max(result.worstFace, std::abs(face.error()));
        result.flip = difference.mean;
        const RoomLightError light = compareRoomLight(room, rebaked);
        result.change = light.changeError, result.room = light.relativeRmse;
        return result;
    }

    void printMeans() const {
        for (const auto& [method, results] : all_) {
            Result mean;
            for (const Result& r : results) {
                const double n = static_cast<double>(results.size());
                mean.meanFace += r.meanFace / n, mean.flip += r.flip / n;
                mean.change += r.change / n, mean.room += r.room / n;
                mean.worstFace = std::max(mean.worstFace, r.worstFace);
            }
            std::printf("%-28s %-6s %-13s %8.2f %8.2f %8.4f %9.1f %8.3f\n", "mean, worst face", "",
                        method.c_str(), 100 * mean.meanFace, 100 * mean.worstFace, mean.flip,
                        100 * mean.change, 100 * mean.room);
        }
    }

    Options options_;
    Scene scene_;
    RayScene rays_;
    LightField field_;
    std::map<std::string, std::vector<Result>> all_;
    nlohmann::ordered_json report_ = nlohmann::ordered_json::array();
};

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Objects in baked rooms against the rooms baked again with them");
    app.add_option("--scene", options.scene)->check(CLI::IsMember({"cornell", "office"}));
    app.add_option("--preset", options.preset);
    app.add_option("--cube", options.only, "white, red, green [all]");
    app.add_option("--place", options.placement, "Its number [all]")->check(CLI::Range(1, 8));
    app.add_option("--samples", options.samples, "Shadow rays per texel of the bakes [16]")
        ->check(CLI::Range(1, 1024));
    app.add_option("--sheets", options.sheets, "Folder for sheets: dynamic, truth, FLIP");
    app.add_option("--json", options.json);
    CLI11_PARSE(app, argc, argv);
    PlacementTable table(options);
    table.run();
    if (!options.json.empty()) std::ofstream(options.json) << table.report().dump(2) << '\n';
}
