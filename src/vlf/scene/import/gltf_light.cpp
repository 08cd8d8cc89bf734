#include "vlf/scene/import/gltf_light.h"

#include "vlf/base/error.h"
#include "vlf/scene/import/gltf_json.h"
#include "vlf/scene/import/warn.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vlf {

namespace {

using nlohmann::json;

constexpr const char* kExtension = "KHR_lights_punctual";
constexpr double kMostIntensity = 1e15;
constexpr double kHalfPi = 1.5707963267948966;
constexpr double kAngleSlack = 1e-4;  // of exporters that write angles in single precision

/// Null if it is not there.
const json& memberOf(const json& object, const char* name) {
    static const json kNone;
    if (!object.is_object()) return kNone;
    const auto found = object.find(name);
    return found == object.end() ? kNone : *found;
}

const json& extensionOf(const json& element) {
    return memberOf(memberOf(element, "extensions"), kExtension);
}

/// Reads one light.
class LightReader {
  public:
    LightReader(SourceLocation where, const json& light, ImportReport& report)
        : where_(std::move(where)), light_(light), report_(report) {}

    PunctualLight read() {
        if (!light_.is_object()) throw InputError(where_, "must be an object");
        PunctualLight light;
        light.kind = kind();
        if (const json& name = memberOf(light_, "name"); name.is_string())
            light.name = name.get<std::string>();
        light.intensity =
            static_cast<float>(number(light_, "intensity", 1, 0, kMostIntensity)) * color();
        if (light.kind == PunctualKind::spot) readCone(light);
        if (!memberOf(light_, "range").is_null())
            warn(report_, at("range"), "left out: the light reaches as far as there is nothing");
        return light;
    }

  private:
    SourceLocation at(const char* member) const {
        return {where_.file, 0, where_.element + "." + member};
    }

    PunctualKind kind() const {
        const json& type = memberOf(light_, "type");
        if (type == "point") return PunctualKind::point;
        if (type == "spot") return PunctualKind::spot;
        if (type == "directional") return PunctualKind::directional;
        throw InputError(at("type"), "must be point, spot or directional");
    }

    double number(const json& parent, const char* member, double otherwise, double least,
                  double most) const {
        const json& value = memberOf(parent, member);
        if (value.is_null()) return otherwise;
        const double x = value.is_number() ? value.get<double>() : NAN;
        if (!(x >= least && x <= most))
            throw InputError(at(member), fmt::format("must be a number from {:g} to {:g}, not {}",
                                                     least, most, value.dump()));
        return x;
    }

    Vec3 color() const {
        const json& value = memberOf(light_, "color");
        if (value.is_null()) return Vec3(1);
        Vec3 color(0);
        bool fine = value.is_array() && value.size() == 3;
        for (int i = 0; fine && i < 3; ++i) {
            const json& item = value[static_cast<std::size_t>(i)];
            color[i] = item.is_number() ? item.get<float>() : NAN;
            fine = color[i] >= 0 && color[i] <= 1e6f;
        }
        if (!fine)
            throw InputError(at("color"),
                             "must be three numbers, none of them negative, not " + value.dump());
        return color;
    }

    void readCone(PunctualLight& light) const {
        const json& spot = memberOf(light_, "spot");
        if (!spot.is_object()) throw InputError(at("spot"), "missing: the light is a spot");
        const double outer = number(spot, "outerConeAngle", kHalfPi / 2, 0, kHalfPi + kAngleSlack);
        const double inner = number(spot, "innerConeAngle", 0, 0, kHalfPi + kAngleSlack);
        if (!(outer > 0) || inner > outer)
            throw InputError(at("spot"),
                             fmt::format("the outer cone angle, {:g}, must be above 0 and above "
                                         "the inner one, {:g}",
                                         outer, inner));
        light.outerCone = static_cast<float>(std::min(outer, kHalfPi));
        light.innerCone = std::min(static_cast<float>(inner), light.outerCone);
    }

    SourceLocation where_;
    const json& light_;
    ImportReport& report_;
};

}  // namespace

GltfLights readGltfLights(const std::string& path, const json& root, ImportReport& report) {
    GltfLights result;
    const std::string element = fmt::format("extensions.{}.lights", kExtension);
    if (const json& lights = memberOf(extensionOf(root), "lights"); !lights.is_null()) {
        if (!lights.is_array()) throw InputError({path, 0, element}, "must be an array");
        for (std::size_t i = 0; i < lights.size(); ++i)
            result.lights.push_back(
                LightReader({path, 0, fmt::format("{}[{}]", element, i)}, lights[i], report)
                    .read());
    }
    const json& nodes = gltfElements(root, "nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const json& light = memberOf(extensionOf(nodes[i]), "light");
        if (!light.is_null() &&
            (!light.is_number_unsigned() || light.get<std::size_t>() >= result.lights.size()))
            throw InputError({path, 0, fmt::format("nodes[{}].extensions.{}.light", i, kExtension)},
                             fmt::format("lights[{}] does not exist", light.dump()));
        result.ofNode.push_back(light.is_null() ? -1 : light.get<int>());
    }
    return result;
}

}  // namespace vlf
