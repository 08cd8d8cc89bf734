#pragma once
// Checks after which no index of a baked room leads out of its arrays and every number is finite.
// They run on what is about to be written and on what was read.

#include "vlf/field/light_field.h"
#include "vlf/scene/scene.h"

#include <string>

namespace vlf {

/// All throw InputError naming `path`, the chunk and the element.
void checkScene(const Scene& scene, const std::string& path);
void checkCharts(const LightField& field, const Scene& scene, const std::string& path);
void checkAtlas(const IrradianceAtlas& atlas, const std::string& path);
void checkBakeRecord(const BakeRecord& record, const std::string& path);

/// Sizes, directions and tiles, which must lie within the subfields; not the elements.
void checkRadianceLayout(const RadianceField& radiance, std::size_t charts,
                         const std::string& path);

/// Every block's elements exist.
void checkRadianceElements(const RadianceField& radiance, const std::string& path);

}  // namespace vlf
