#include "vlf/field/parallel_subfield.h"

#include <cmath>

namespace vlf {

ParallelSubfield makeSubfield(const FieldFrame& frame, const Vec3& direction, int cells,
                              float roll, const Vec2& jitter) {
    const Frame axes = frameFromNormal(direction);
    const float c = std::cos(roll), s = std::sin(roll);
    const float cellsPerMetre = (cells - 1) / (2 * frame.radius);
    ParallelSubfield subfield;
    subfield.xAxis = cellsPerMetre * (c * axes.tangent + s * axes.bitangent);
    subfield.yAxis = cellsPerMetre * (c * axes.bitangent - s * axes.tangent);
    subfield.xOffset = 0.5f * (cells - 1) + jitter.x - glm::dot(subfield.xAxis, frame.centre);
    subfield.yOffset = 0.5f * (cells - 1) + jitter.y - glm::dot(subfield.yAxis, frame.centre);
    subfield.direction = direction;
    subfield.depthOffset = frame.radius - glm::dot(direction, frame.centre);
    subfield.cells = cells;
    return subfield;
}

}  // namespace vlf
