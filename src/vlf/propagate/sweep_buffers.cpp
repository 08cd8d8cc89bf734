#include "vlf/propagate/sweep_buffers.h"

namespace vlf {

void SweepScratch::Buffers::prepare(int cells) {
    const std::size_t wanted = (cells / sweep::kPadding + 2) * sweep::kPadding;
    if (stride != wanted) {
        stride = wanted;
        layerCapacity = layersUsed = 0;
        depth.clear();
        fragment.clear();
        addLayers(32);
        near.resize(stride + sweep::kPadding);
        far.resize(stride + sweep::kPadding);
    }
    faces.clear();
    spans.clear();
    rowHead.assign(cells, sweep::kNoSpan);
}

void SweepScratch::Buffers::addLayers(std::size_t capacity) {
    layerCapacity = capacity;
    depth.resize(capacity * stride, sweep::kFar);
    fragment.resize(capacity * stride, sweep::kNone);
}

SweepScratch::SweepScratch() : buffers_(std::make_unique<Buffers>()) {}
SweepScratch::~SweepScratch() = default;
SweepScratch::SweepScratch(SweepScratch&&) noexcept = default;
SweepScratch& SweepScratch::operator=(SweepScratch&&) noexcept = default;

}  // namespace vlf
