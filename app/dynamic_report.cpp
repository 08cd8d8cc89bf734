#include "dynamic_report.h"

#include "picture_output.h"

#include "vlf/dynamic/object_names.h"

#include <fmt/format.h>

namespace vlf::app {

namespace {

nlohmann::ordered_json toJson(const FaceRadiance& face, const DynamicRoom& objects) {
    return {{"object", objects.object(face.object).name},
            {"normal", numbers(face.normal)},
            {"pixels", face.pixels},
            {"dynamic", numbers(face.test)},
            {"truth", numbers(face.truth)},
            {"error", face.error()}};
}

nlohmann::ordered_json toJson(const RoomLightError& light) {
    return {{"texels", light.texels},
            {"relRmse", light.relativeRmse},
            {"changedTexels", light.changedTexels},
            {"changeError", light.changeError},
            {"noise", light.noise}};
}

}  // namespace

nlohmann::ordered_json toJson(const DynamicReport& report, const DynamicRoom& objects) {
    nlohmann::ordered_json things = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const DynamicObject& object = objects.object(i);
        things.push_back({{"name", object.name},
                          {"shading", nameAmong(kShadingNames, object.settings.shading)},
                          {"shadow", nameAmong(kShadowNames, object.settings.shadow)}});
    }
    nlohmann::ordered_json faces = nlohmann::ordered_json::array();
    for (const FaceRadiance& face : report.faces) faces.push_back(toJson(face, objects));
    nlohmann::ordered_json json{
        {"objects", things},
        {"seconds", {{"objects", report.updateSeconds}, {"truth", report.truthSeconds}}},
        {"exposure", report.exposure},
        {"flip", report.flip.mean},
        {"relMse", report.relMse},
        {"meanFaceError", meanFaceError(report.faces)},
        {"faces", faces}};
    if (report.light) json["room"] = toJson(*report.light);
    return json;
}

void printReport(const DynamicReport& report, const DynamicRoom& objects) {
    fmt::print("objects lit in {:.1f} ms, truth made in {:.1f} s\n", 1e3 * report.updateSeconds,
               report.truthSeconds);
    fmt::print("FLIP {:.5f}, relMSE {:.4g} at exposure {:+.2f} EV\n", report.flip.mean,
               report.relMse, report.exposure);
    if (report.faces.empty()) fmt::print("no face of an object fills a pixel of the picture\n");
    for (const FaceRadiance& face : report.faces)
        fmt::print(
            "  {:<16} face {:+.2f} {:+.2f} {:+.2f}  {:>7} pixels  {:>9.4g} for {:>9.4g}  "
            "{:+6.2f} %\n",
            objects.object(face.object).name, face.normal.x, face.normal.y, face.normal.z,
            face.pixels, luminance(face.test), luminance(face.truth), 100 * face.error());
    if (!report.faces.empty())
        fmt::print("  mean error of a face {:.2f} %\n", 100 * meanFaceError(report.faces));
    if (!report.light) return;
    const RoomLightError& light = *report.light;
    fmt::print(
        "room: {} texels, relRMSE {:.3f} %; {} changed by the objects, error {:.1f} % of "
        "the change; baking again changes the others by {:.3f} %\n",
        light.texels, 100 * light.relativeRmse, light.changedTexels, 100 * light.changeError,
        100 * light.noise);
}

}  // namespace vlf::app
