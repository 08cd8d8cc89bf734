#pragma once
// What a sweep works in: projected faces, the rows' spans and the sorted layers of one row.

#include "vlf/propagate/bundle_sweep.h"

#include <limits>
#include <new>

namespace vlf {

namespace sweep {

// A fragment is a texel index and two flags.
inline constexpr std::uint32_t kExit = 1u << 31;  // its texel faces along the direction
inline constexpr std::uint32_t kMirrorBit = 1u << 30;
inline constexpr std::uint32_t kTexelMask = kMirrorBit - 1;
inline constexpr std::uint32_t kNone = kTexelMask;  // no fragment: neither exit nor mirror

/// SIMD loads and stores may reach this many cells beyond a row's end; rows begin at multiples.
inline constexpr std::size_t kPadding = 16;

/// Puts the layers at the start of cache lines, so that no vector lies across two.
template <class T>
struct LineAllocator {
    using value_type = T;
    static constexpr std::align_val_t kLine{64};

    LineAllocator() = default;
    template <class U>
    LineAllocator(const LineAllocator<U>&) {}

    T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kLine)); }
    void deallocate(T* p, std::size_t) { ::operator delete(p, kLine); }
    friend bool operator==(const LineAllocator&, const LineAllocator&) { return true; }
};

inline constexpr float kFar = std::numeric_limits<float>::infinity();

/// Of touching surfaces the one whose texels face against the direction comes first, so that
/// nothing is exchanged within the crack. Part of the field's radius.
inline constexpr float kContactBias = 1e-5f;

/// A face as seen along the direction: depth and texel coordinates are affine in the cell.
struct Plane {
    float atReference, perX, perY;

    float at(int dx, int dy) const { return atReference + perX * dx + perY * dy; }
};

struct ProjectedFace {
    Plane depth, u, v;
    int xReference, yReference;
    float uMax, vMax;  // last column and row of the chart
    std::uint32_t origin;
    std::uint32_t flags;
};

struct Span {
    std::uint32_t face;
    std::uint32_t next;
    std::int16_t begin, end;
};
inline constexpr std::uint32_t kNoSpan = 0xffffffffu;

}  // namespace sweep

struct SweepScratch::Buffers {
    std::vector<sweep::ProjectedFace> faces;
    std::vector<sweep::Span> spans;
    std::vector<std::uint32_t> rowHead;
    // Sorted layers of one row: layer k at [k * stride].
    std::vector<float, sweep::LineAllocator<float>> depth;
    std::vector<std::uint32_t, sweep::LineAllocator<std::uint32_t>> fragment;
    std::size_t stride = 0, layerCapacity = 0, layersUsed = 0;
    std::vector<std::uint32_t> near, far;  // pairs to exchange

    void prepare(int cells);
    void addLayers(std::size_t capacity);
};

}  // namespace vlf
