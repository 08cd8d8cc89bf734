#include "vlf/propagate/bundle_sweep.h"

#include "vlf/base/error.h"
#include "vlf/propagate/sweep_buffers.h"

#include <algorithm>
#include <cmath>
#include <cstring>

// Compiled once per instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vlf/propagate/bundle_sweep.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vlf {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using namespace sweep;
using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::ScalableTag<std::int32_t>;
using UintTag = hn::ScalableTag<std::uint32_t>;
using Floats = hn::Vec<FloatTag>;
using Uints = hn::Vec<UintTag>;

constexpr std::size_t kMaxLanes = HWY_MAX_BYTES / sizeof(float);

/// Corners of one face in cells and metres of depth.
struct Corners {
    float x[3], y[3], depth[3];
};

class Sweep {
    using Float4 = float __attribute__((vector_size(16)));

  public:
    Sweep(const BundleFaces& faces, const ParallelSubfield& subfield, const TexelBuffer& radiance,
          TexelBuffer& gathered, std::vector<MirrorSight>& sights, SweepScratch::Buffers& buffers,
          const OutsideRadiance& outside)
        : faces_(faces),
          subfield_(subfield),
          radiance_(radiance.data()),
          gathered_(gathered.data()),
          outside_(static_cast<std::uint32_t>(radiance.texelCount())),
          ahead_(lightOf(outside.ahead)),
          behind_(lightOf(outside.behind)),
          lit_(maxComponent(outside.ahead) > 0 || maxComponent(outside.behind) > 0),
          sights_(sights),
          b_(buffers) {}

    std::uint64_t run() {
        b_.prepare(subfield_.cells);
        projectFaces();
        for (int row = 0; row < subfield_.cells; ++row) {
            if (b_.rowHead[row] == kNoSpan) continue;
            rowBegin_ = subfield_.cells;
            rowEnd_ = 0;
            for (std::uint32_t s = b_.rowHead[row]; s != kNoSpan; s = b_.spans[s].next) {
                rowBegin_ = std::min<std::size_t>(rowBegin_, b_.spans[s].begin);
                rowEnd_ = std::max<std::size_t>(rowEnd_, b_.spans[s].end);
                insertSpan(b_.spans[s], row);
            }
            rowBegin_ &= ~(hn::Lanes(FloatTag()) - 1);
            exchangeRow(row);
            clearRow();
        }
        return exchanges_;
    }

  private:
    // --- Projection: every face to spans of the rows it covers

    /// a·p + offset for the corner k of consecutive faces, p relative to the frame's centre.
    Floats transform(const Vec3& a, float offset, int k, std::size_t i) const {
        const FloatTag d;
        Floats r = hn::MulAdd(hn::Set(d, a.x), hn::LoadU(d, &faces_.x[k][i]), hn::Set(d, offset));
        r = hn::MulAdd(hn::Set(d, a.y), hn::LoadU(d, &faces_.y[k][i]), r);
        return hn::MulAdd(hn::Set(d, a.z), hn::LoadU(d, &faces_.z[k][i]), r);
    }

    void projectFaces() {
        const FloatTag d;
        const Vec3& centre = faces_.frame.centre;
        const Vec2 middle = subfield_.cellCoordinates(centre);
        const float depthMiddle = subfield_.depth(centre);
        const std::size_t lanes = hn::Lanes(d);
        HWY_ALIGN float x[3][kMaxLanes], y[3][kMaxLanes], depth[3][kMaxLanes];
        for (std::size_t i = 0; i < faces_.count; i += lanes) {
            Floats xs[3], ys[3];
            for (int k = 0; k < 3; ++k) {
                xs[k] = transform(subfield_.xAxis, middle.x, k, i);
                ys[k] = transform(subfield_.yAxis, middle.y, k, i);
            }
            std::uint8_t bits[8] = {};
            hn::StoreMaskBits(d, hn::And(spansCentre(xs), spansCentre(ys)), bits);
            std::uint32_t mask = bits[0] | bits[1] << 8;
            if (faces_.count - i < lanes) mask &= (1u << (faces_.count - i)) - 1;
            if (mask == 0) continue;
            for (int k = 0; k < 3; ++k) {
                hn::Store(xs[k], d, x[k]);
                hn::Store(ys[k], d, y[k]);
                hn::Store(transform(subfield_.direction, depthMiddle, k, i), d, depth[k]);
            }
            for (; mask != 0; mask &= mask - 1) {
                const auto lane = static_cast<unsigned>(__builtin_ctz(mask));
                projectFace(i + lane, {{x[0][lane], x[1][lane], x[2][lane]},
                                       {y[0][lane], y[1][lane], y[2][lane]},
                                       {depth[0][lane], depth[1][lane], depth[2][lane]}});
            }
        }
    }

    /// Whether the interval of three coordinates holds the centre of any cell: most triangles of a
    /// dense mesh fall between.
    static hn::Mask<FloatTag> spansCentre(const Floats (&c)[3]) {
        const FloatTag d;
        const Floats half = hn::Set(d, 0.5f);
        const Floats lower = hn::Min(c[0], hn::Min(c[1], c[2]));
        const Floats upper = hn::Max(c[0], hn::Max(c[1], c[2]));
        return hn::Lt(hn::Ceil(hn::Sub(lower, half)), hn::Ceil(hn::Sub(upper, half)));
    }

    void projectFace(std::size_t i, const Corners& c) {
        const float x1 = c.x[1] - c.x[0], y1 = c.y[1] - c.y[0];
        const float x2 = c.x[2] - c.x[0], y2 = c.y[2] - c.y[0];
        const float doubleArea = x1 * y2 - x2 * y1;
        const float extent = std::max(x1 * x1 + y1 * y1, x2 * x2 + y2 * y2);
        if (!(std::abs(doubleArea) > 1e-6f * extent)) return;  // seen edge-on

        ProjectedFace face;
        face.xReference = static_cast<int>(c.x[0]);
        face.yReference = static_cast<int>(c.y[0]);
        const float dx = face.xReference + 0.5f - c.x[0], dy = face.yReference + 0.5f - c.y[0];
        const auto plane = [&](float a0, float a1, float a2) {
            const float perX = ((a1 - a0) * y2 - (a2 - a0) * y1) / doubleArea;
            const float perY = ((a2 - a0) * x1 - (a1 - a0) * x2) / doubleArea;
            return Plane{a0 + perX * dx + perY * dy, perX, perY};
        };
        const bool exits = (doubleArea > 0) != ((faces_.flags[i] & BundleFaces::kFlipped) != 0);
        face.depth = plane(c.depth[0], c.depth[1], c.depth[2]);
        face.depth.atReference += (exits ? kContactBias : -kContactBias) * faces_.frame.radius;
        face.u = plane(faces_.u[0][i], faces_.u[1][i], faces_.u[2][i]);
        face.v = plane(faces_.v[0][i], faces_.v[1][i], faces_.v[2][i]);
        face.uMax = static_cast<float>(faces_.width[i]) - 1;
        face.vMax = static_cast<float>(faces_.height[i]) - 1;
        face.origin = faces_.origin[i];
        face.flags =
            (exits ? kExit : 0) | (faces_.flags[i] & BundleFaces::kMirror ? kMirrorBit : 0);
        addSpans(face, c);
    }

    /// An edge's crossing of row centres, computed alike for the two faces that share it, so that
    /// every cell centre falls in exactly one of them.
    struct EdgeWalk {
        float x, y, slope;

        EdgeWalk(float xa, float ya, float xb, float yb) {
            const bool ordered = ya < yb || (ya == yb && xa < xb);
            x = ordered ? xa : xb;
            y = ordered ? ya : yb;
            const float height = ordered ? yb - ya : ya - yb;
            slope = height > 0 ? (ordered ? xb - xa : xa - xb) / height : 0;
        }
        int firstCell(int row) const {
            return static_cast<int>(std::ceil(x + slope * (row + 0.5f - y) - 0.5f));
        }
    };

    static int firstRow(float y) { return static_cast<int>(std::ceil(y - 0.5f)); }

    void addSpans(const ProjectedFace& face, const Corners& c) {
        int top = 0, middle = 1, bottom = 2;
        if (c.y[middle] < c.y[top]) std::swap(middle, top);
        if (c.y[bottom] < c.y[top]) std::swap(bottom, top);
        if (c.y[bottom] < c.y[middle]) std::swap(bottom, middle);
        const EdgeWalk longEdge(c.x[top], c.y[top], c.x[bottom], c.y[bottom]);
        const EdgeWalk upper(c.x[top], c.y[top], c.x[middle], c.y[middle]);
        const EdgeWalk lower(c.x[middle], c.y[middle], c.x[bottom], c.y[bottom]);
        const int begin = std::max(0, firstRow(c.y[top]));
        const int bend = std::clamp(firstRow(c.y[middle]), begin, subfield_.cells);
        const int end = std::clamp(firstRow(c.y[bottom]), bend, subfield_.cells);
        const std::size_t before = b_.spans.size();
        for (int row = begin; row < bend; ++row) addSpan(row, longEdge, upper);
        for (int row = bend; row < end; ++row) addSpan(row, longEdge, lower);
        if (b_.spans.size() > before) b_.faces.push_back(face);
    }

    void addSpan(int row, const EdgeWalk& a, const EdgeWalk& b) {
        const auto [left, right] = std::minmax({a.firstCell(row), b.firstCell(row)});
        const int begin = std::max(left, 0), end = std::min(right, subfield_.cells);
        if (begin >= end) return;
        b_.spans.push_back({static_cast<std::uint32_t>(b_.faces.size()), b_.rowHead[row],
                            static_cast<std::int16_t>(begin), static_cast<std::int16_t>(end)});
        b_.rowHead[row] = static_cast<std::uint32_t>(b_.spans.size() - 1);
    }

    // --- A-buffer: fragments of a row, sorted by depth

    void insertSpan(const Span& span, int row) {
        const FloatTag d;
        const IntTag di;
        const UintTag du;
        const ProjectedFace& f = b_.faces[span.face];
        const auto lanes = static_cast<int>(hn::Lanes(d));
        const int first = span.begin & -lanes;  // aligned: partly overlapping stores would stall
        const int dx = first - f.xReference, dy = row - f.yReference;
        const Floats iota = hn::Iota(d, 0.0f);
        const auto start = [&](const Plane& p) {
            return hn::MulAdd(iota, hn::Set(d, p.perX), hn::Set(d, p.at(dx, dy)));
        };
        Floats depth = start(f.depth), u = start(f.u), v = start(f.v);
        const Floats depthStep = hn::Set(d, f.depth.perX * lanes);
        const Floats uStep = hn::Set(d, f.u.perX * lanes), vStep = hn::Set(d, f.v.perX * lanes);
        const Floats zero = hn::Zero(d), uMax = hn::Set(d, f.uMax), vMax = hn::Set(d, f.vMax);
        const auto pitch = hn::Set(di, static_cast<std::int32_t>(faces_.atlasWidth));
        const auto origin = hn::Set(di, static_cast<std::int32_t>(f.origin));
        const Uints flags = hn::Set(du, f.flags);
        auto live = hn::Not(hn::FirstN(d, static_cast<std::size_t>(span.begin - first)));
        for (int x = first; x < span.end; x += lanes) {
            const auto column = hn::ConvertTo(di, hn::Min(hn::Max(u, zero), uMax));
            const auto line = hn::ConvertTo(di, hn::Min(hn::Max(v, zero), vMax));
            const auto texel = hn::Add(hn::Add(origin, column), hn::Mul(line, pitch));
            live = hn::And(live, hn::FirstN(d, static_cast<std::size_t>(span.end - x)));
            insert(static_cast<std::size_t>(x), hn::IfThenElse(live, depth, hn::Set(d, kFar)),
                   hn::Or(hn::BitCast(du, texel), flags));
            live = hn::FirstN(d, static_cast<std::size_t>(lanes));
            depth = hn::Add(depth, depthStep);
            u = hn::Add(u, uStep);
            v = hn::Add(v, vStep);
        }
    }

    /// Bubbles fragments into the sorted layers of consecutive cells from x on.
    void insert(std::size_t x, Floats depth, Uints fragment) {
        const FloatTag d;
        const UintTag du;
        for (std::size_t layer = 0;; ++layer) {
            if (layer == b_.layersUsed) {
                if (layer == b_.layerCapacity) b_.addLayers(2 * layer);
                b_.layersUsed = layer + 1;
            }
            float* const depths = &b_.depth[layer * b_.stride + x];
            std::uint32_t* const fragments = &b_.fragment[layer * b_.stride + x];
            const Floats there = hn::LoadU(d, depths);
            const Uints thereFragment = hn::LoadU(du, fragments);
            const auto nearer = hn::Lt(depth, there);
            const auto nearerBits = hn::RebindMask(du, nearer);
            hn::StoreU(hn::Min(depth, there), d, depths);
            hn::StoreU(hn::IfThenElse(nearerBits, fragment, thereFragment), du, fragments);
            depth = hn::Max(depth, there);
            fragment = hn::IfThenElse(nearerBits, thereFragment, fragment);
            if (hn::AllFalse(d, hn::Lt(depth, hn::Set(d, kFar)))) return;
        }
    }

    void clearRow() {
        for (std::size_t layer = 0; layer < b_.layersUsed; ++layer) {
            const std::size_t begin = layer * b_.stride + rowBegin_;
            std::fill_n(b_.depth.begin() + begin, rowEnd_ - rowBegin_, kFar);
            std::fill_n(b_.fragment.begin() + begin, rowEnd_ - rowBegin_, kNone);
        }
        b_.layersUsed = 0;
    }

    // --- Exchange of radiance between consecutive fragments

    void exchangeRow(int row) {
        // One empty layer beyond the last: what leaves the scene.
        if (b_.layersUsed == b_.layerCapacity) b_.addLayers(2 * b_.layersUsed);
        std::size_t count = collectFirst();
        exchange(count);
        for (std::size_t layer = 0; layer < b_.layersUsed; ++layer) {
            count = collectPairs(layer);
            exchange(count);
        }
        collectMirrorSights(row);
    }

    /// The first fragments of all rays: those that face back see outside.
    std::size_t collectFirst() {
        const UintTag du;
        std::size_t count = 0;
        for (std::size_t x = rowBegin_; x < rowEnd_; x += hn::Lanes(du)) {
            const Uints first = hn::LoadU(du, &b_.fragment[x]);
            forEachSet(hn::And(isEntry(first), isFragment(first)), [&](std::size_t lane) {
                const std::uint32_t texel = b_.fragment[x + lane] & kTexelMask;
                b_.near[count] = outside_;
                b_.far[count++] = texel;
                if (lit_) add(texel, behind_);
            });
        }
        return count;
    }

    /// Pairs of fragments in this layer and the next that face each other, or the outside.
    std::size_t collectPairs(std::size_t layer) {
        const UintTag du;
        const std::uint32_t* const nears = &b_.fragment[layer * b_.stride];
        const std::uint32_t* const fars = nears + b_.stride;
        std::size_t count = 0;
        for (std::size_t x = rowBegin_; x < rowEnd_; x += hn::Lanes(du)) {
            const Uints a = hn::LoadU(du, nears + x), b = hn::LoadU(du, fars + x);
            forEachSet(hn::AndNot(isEntry(a), isEntry(b)), [&](std::size_t lane) {
                const std::uint32_t seen = fars[x + lane];
                b_.near[count] = nears[x + lane] & kTexelMask;
                b_.far[count++] = seen == kNone ? outside_ : seen & kTexelMask;
                if (lit_ && seen == kNone) add(nears[x + lane] & kTexelMask, ahead_);
            });
        }
        return count;
    }

    template <class Visit>
    static HWY_INLINE void forEachSet(hn::Mask<UintTag> mask, Visit visit) {
        std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(UintTag(), mask, bytes);
        for (std::uint32_t bits = bytes[0] | bytes[1] << 8; bits != 0; bits &= bits - 1)
            visit(static_cast<std::size_t>(__builtin_ctz(bits)));
    }

    static hn::Mask<UintTag> isEntry(Uints f) {
        const UintTag du;
        return hn::Eq(hn::And(f, hn::Set(du, kExit)), hn::Zero(du));
    }
    static hn::Mask<UintTag> isFragment(Uints f) {
        const UintTag du;
        return hn::Ne(f, hn::Set(du, kNone));
    }

    /// Hands radiance over both ways. Two pairs at a time, from both halves of the list:
    /// neighbours often share a texel and would wait for each other's sum.
    void exchange(std::size_t count) {
        exchanges_ += count;
        const std::size_t half = count / 2;
        for (std::size_t i = 0; i < half; ++i) {
            handOver(b_.near[i], b_.far[i]);
            handOver(b_.near[half + i], b_.far[half + i]);
        }
        if (count % 2) handOver(b_.near[count - 1], b_.far[count - 1]);
    }

    HWY_INLINE void handOver(std::uint32_t a, std::uint32_t b) {
        float* const toA = gathered_ + 4 * static_cast<std::size_t>(a);
        float* const toB = gathered_ + 4 * static_cast<std::size_t>(b);
        const Float4 fromA = load4(radiance_ + 4 * static_cast<std::size_t>(a));
        const Float4 fromB = load4(radiance_ + 4 * static_cast<std::size_t>(b));
        store4(toA, load4(toA) + fromB);
        store4(toB, load4(toB) + fromA);
    }

    /// Light from outside, whose sample is that of an exchange with the black entry for it.
    HWY_INLINE void add(std::uint32_t texel, Float4 light) {
        float* const to = gathered_ + 4 * static_cast<std::size_t>(texel);
        store4(to, load4(to) + light);
    }

    static Float4 lightOf(const Vec3& radiance) {
        return Float4{radiance.x, radiance.y, radiance.z, 0};
    }
    static HWY_INLINE Float4 load4(const float* p) {
        Float4 v;
        std::memcpy(&v, p, sizeof v);
        return v;
    }
    static HWY_INLINE void store4(float* p, Float4 v) { std::memcpy(p, &v, sizeof v); }

    void collectMirrorSights(int row) {
        const UintTag du;
        for (std::size_t layer = 0; layer + 1 < b_.layersUsed; ++layer)
            for (std::size_t x = rowBegin_; x < rowEnd_; x += hn::Lanes(du)) {
                const std::size_t i = layer * b_.stride + x;
                const Uints either = hn::Or(hn::LoadU(du, &b_.fragment[i]),
                                            hn::LoadU(du, &b_.fragment[i + b_.stride]));
                const Uints mirror = hn::And(either, hn::Set(du, kMirrorBit));
                if (!hn::AllTrue(du, hn::Eq(mirror, hn::Zero(du))))
                    for (std::size_t k = 0; k < std::min(hn::Lanes(du), rowEnd_ - x); ++k)
                        addMirrorSight(i + k, x + k, row);
            }
    }

    void addMirrorSight(std::size_t i, std::size_t x, int row) {
        const std::uint32_t a = b_.fragment[i], b = b_.fragment[i + b_.stride];
        if (!(a & kExit) || b == kNone || (b & kExit)) return;
        const float aDepth = b_.depth[i], bDepth = b_.depth[i + b_.stride];
        const auto cell = static_cast<std::uint16_t>(x), line = static_cast<std::uint16_t>(row);
        const std::uint32_t aTexel = a & kTexelMask, bTexel = b & kTexelMask;
        if (b & kMirrorBit) sights_.push_back({aTexel, bTexel, aDepth, bDepth, cell, line, true});
        if (a & kMirrorBit) sights_.push_back({bTexel, aTexel, bDepth, aDepth, cell, line, false});
    }

    const BundleFaces& faces_;
    const ParallelSubfield& subfield_;
    const float* radiance_;
    float* gathered_;
    std::uint32_t outside_;
    Float4 ahead_, behind_;  // what is seen of the outside
    bool lit_;               // whether it shines
    std::vector<MirrorSight>& sights_;
    SweepScratch::Buffers& b_;
    std::size_t rowBegin_ = 0, rowEnd_ = 0;  // cells of the row that hold fragments
    std::uint64_t exchanges_ = 0;
};

std::uint64_t runSweep(const BundleFaces& faces, const ParallelSubfield& subfield,
                       const TexelBuffer& radiance, TexelBuffer& gathered,
                       std::vector<MirrorSight>& sights, SweepScratch::Buffers& buffers,
                       const OutsideRadiance& outside) {
    return Sweep(faces, subfield, radiance, gathered, sights, buffers, outside).run();
}

const char* targetName() {
    return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace vlf
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace vlf {

HWY_EXPORT(runSweep);
HWY_EXPORT(targetName);

std::uint64_t sweepBundle(const BundleFaces& faces, const ParallelSubfield& subfield,
                          const TexelBuffer& radiance, TexelBuffer& gathered,
                          std::vector<MirrorSight>& mirrorSights, SweepScratch& scratch,
                          const OutsideRadiance& outside) {
    return HWY_DYNAMIC_DISPATCH(runSweep)(faces, subfield, radiance, gathered, mirrorSights,
                                          scratch.buffers(), outside);
}

std::vector<std::string> availableInstructionSets() {
    std::vector<std::string> names;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
        names.emplace_back(hwy::TargetName(target));
    return names;
}

void useInstructionSet(const std::string& name) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
        if (name == hwy::TargetName(target)) {
            hwy::GetChosenTarget().Update(target);
            return;
        }
    std::string known;
    for (const std::string& n : availableInstructionSets())
        known += (known.empty() ? "" : ", ") + n;
    throw InputError("instruction set '" + name + "' is not available here: choose one of " +
                     known);
}

std::string currentInstructionSet() {
    return HWY_DYNAMIC_DISPATCH(targetName)();
}

}  // namespace vlf

#endif  // HWY_ONCE
