#pragma once
// A bounding volume hierarchy over a scene's triangles as plain data, to be copied into the
// buffers of a GPU and searched by a shader (render/gl/shaders/trace.glsl).
//
// A node holds the boxes of its two children: one visit decides which of them to enter and which
// first. MEASURED_WHY

#include "vlf/math/vector.h"
#include "vlf/scene/scene.h"

#include <cstdint>
#include <vector>

namespace vlf {

/// Where a child is, in 32 bits: bit 31 is set for a leaf, bits 27 to 29 are its number of
/// triangles (0 to kMaxLeafSize; 0 for an inner node), bits 0 to 26 the index of the inner node or
/// of the leaf's first triangle. Bit 30 is always set: read as a float, the word is a normal
/// number, which no driver flushes to zero.
struct BvhReference {
    std::uint32_t word = 0;

    bool isLeaf() const { return word >> 31 != 0; }
    std::uint32_t count() const { return word >> 27 & 7; }
    std::uint32_t index() const { return word & 0x07ffffff; }
};

/// A child's box, in metres, a little larger than what it holds, so that a slab test in single
/// precision misses nothing; and what is in it.
struct BvhChild {
    Vec3 lower{0};
    BvhReference reference;
    Vec3 upper{0};
    std::uint32_t unused = 0;
};

/// An inner node: four texels of four floats.
struct BvhNode {
    BvhChild child[2];
};

/// A triangle v0, v0 + e1, v0 + e2: three texels of four floats. `index` is the scene's triangle
/// with bit 30 set.
struct BvhTriangle {
    Vec3 v0{0};
    std::uint32_t index = 0;
    Vec3 e1{0};
    std::uint32_t unused1 = 0;
    Vec3 e2{0};
    std::uint32_t unused2 = 0;

    std::uint32_t sceneTriangle() const { return index & 0x07ffffff; }
};

static_assert(sizeof(BvhNode) == 64 && sizeof(BvhTriangle) == 48);

/// The hierarchy. nodes[0] is the root and always there; nodes lie in depth-first order, the
/// triangles in the order of the leaves. A scene of one leaf or none has empty leaves (count 0).
struct Bvh {
    static constexpr std::uint32_t kMaxLeafSize = 4;
    /// Inner nodes on the longest way down are at most this many: a search that enters the nearer
    /// child and puts the other aside never has more than kMaxDepth references put aside.
    static constexpr int kMaxDepth = 48;

    std::vector<BvhNode> nodes;
    std::vector<BvhTriangle> triangles;
    int depth = 0;  ///< inner nodes on the longest way down, in [1, kMaxDepth]
};

/// Builds the hierarchy of a scene of finite vertices; the same scene gives the same bits with any
/// number of threads. Rays are expected to start within some lengths of the scene of its bounds.
/// Throws InputError for more than 2^27 triangles and Error if memory runs out.
Bvh buildBvh(const Scene& scene);

}  // namespace vlf
