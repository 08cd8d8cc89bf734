#include "vlf/render/gl/radiance_buffers.h"

#include "vlf/base/error.h"
#include "vlf/render/gl/packed_radiance.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace vlf::gl {

namespace {

/// Surfaces of one depth count as one if they are closer than this in a subfield, in cells; as on
/// the CPU (render/cpu/radiance_lookup.cpp).
constexpr float kTolerance = 5;

void requireRecords(std::uint64_t records) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (records > static_cast<std::uint64_t>(most))
        throw InputError("the number of mirrors times directions (" + std::to_string(records) +
                         ") exceeds what this GPU holds (" + std::to_string(most) +
                         "); bake it coarser, or render with --backend cpu");
}

}  // namespace

RadianceBuffers::RadianceBuffers(const FieldFrame& frame, const RadianceField& r,
                                 const std::vector<std::uint32_t>& charts,
                                 const RadianceLimits& limits, std::uint64_t bufferTexels) {
    const RadianceLayout layout = layOutWithin(limits, r, charts);
    const PackedRadiance packed = packRadiance(r, charts, layout);
    requireRecords(layout.records.size());
    elements_ = makeBuffer(packed.elements.data(), 4 * packed.elements.size());
    records_ = makeBuffer(layout.records.data(), sizeof(RadianceRecord) * layout.records.size());
    fourATexel_ = layout.elements > bufferTexels;
    elementTexture_ = makeBufferTexture(elements_, fourATexel_ ? GL_RGBA32UI : GL_R32UI);
    recordTexture_ = makeBufferTexture(records_, GL_RGBA32UI);
    coarseness_ = static_cast<std::uint32_t>(layout.coarseness);
    bytes_ = layout.bytes();
    elementCount_ = layout.elements;
    const float diameter = 2 * frame.radius;
    const float cells = static_cast<float>(r.cells - 1) / static_cast<float>(layout.coarseness);
    const shared::RadianceData data{
        Vec4(frame.centre, cells / diameter),
        {std::sqrt(0.5f * static_cast<float>(std::max(r.lines, 1) - 1)), r.lines, 0.5f * cells,
         kTolerance * diameter / std::max(cells, 1.0f)},
        {packed.longestDistance, packed.logSum.first, packed.logSum.step, 0},
        {packed.red.first, packed.red.step, packed.blue.first, packed.blue.step}};
    description_ = makeBuffer(&data, sizeof data);
}

void RadianceBuffers::bind() const {
    glBindTextureUnit(shared::kElementUnit, elementTexture_.id());
    glBindTextureUnit(shared::kRecordUnit, recordTexture_.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, shared::kRadianceBlock, description_.id());
}

}  // namespace vlf::gl
