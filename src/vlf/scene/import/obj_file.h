#pragma once
// Wavefront OBJ as written: polygons, not yet triangulated, with the lines they come from.

#include "vlf/math/vector.h"
#include "vlf/scene/import/import.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vlf {

/// One corner of a polygon: indices from 0, -1 where the file gives none.
struct ObjCorner {
    int position = -1, uv = -1, normal = -1;
};

/// A polygon: a range of ObjFile::corners, at least three.
struct ObjFace {
    std::uint32_t firstCorner = 0, cornerCount = 0;
    int material = -1;  ///< index into ObjFile::materials; -1: no usemtl
    int part = 0;       ///< index into ObjFile::parts
    int smoothing = 0;  ///< smoothing group; 0: off
    int line = 0;
};

/// A name and the line that first mentions it.
struct ObjName {
    std::string name;
    int line = 0;
};

struct ObjFile {
    std::string path;
    std::vector<Vec3> positions, normals;  ///< normals as given, of any length
    std::vector<Vec2> uvs;
    std::vector<ObjCorner> corners;
    std::vector<ObjFace> faces;      ///< in the order of the file
    std::vector<ObjName> parts;      ///< objects and groups, in the order of their first face
    std::vector<ObjName> materials;  ///< names of usemtl
    std::vector<ObjName> libraries;  ///< operands of mtllib, unsplit
};

/// Parses the text of an OBJ file. Every index of the result is in range and every number finite.
/// Curves, lines, points and faces of fewer than three corners are skipped with a warning. Throws
/// InputError with the line of a number or index that cannot be used.
ObjFile parseObj(const std::string& path, std::string_view text, ImportReport& report);

}  // namespace vlf
