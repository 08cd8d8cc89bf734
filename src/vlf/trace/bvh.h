#pragma once
// A bounding volume hierarchy over a scene's triangles as plain data, to be copied into the
// buffers of a GPU and searched by a shader (render/gl/shaders/trace.glsl).
//
// Nodes lie in one depth-first order and each names the next node for a ray that misses its box:
// a search is a single walk forward without a stack. Nodes of two boxes with the farther child put
// on a stack test as many boxes a ray (24 in a room of 10,000 triangles) but took twice the time
// with eight rays in step (llvmpipe), since the stack takes gathers and scatters of its own.

#include "vlf/math/vector.h"
#include "vlf/scene/scene.h"

#include <cstdint>
#include <vector>

namespace vlf {

/// A node: two texels of four floats. All words but the 0 of inner nodes have bit 30 set: read as a
/// float they are normal numbers, which no driver flushes to zero.
struct BvhNode {
    Vec3 lower{0};            ///< box, metres; a little larger than what it holds, so that a
                              ///< slab test in single precision misses nothing
    std::uint32_t after = 0;  ///< bits 0 to 26: the node to go on with past all that is below this
                              ///< one; the number of nodes: none
    Vec3 upper{0};
    std::uint32_t leaf = 0;  ///< 0 for an inner node, whose first child follows it; or bits 27 to
                             ///< 29: number of triangles, bits 0 to 26: the first of them

    std::uint32_t next() const { return after & 0x07ffffff; }
    std::uint32_t count() const { return leaf >> 27 & 7; }
    std::uint32_t first() const { return leaf & 0x07ffffff; }
};

/// A triangle v0, v0 + e1, v0 + e2: three texels of four floats.
struct BvhTriangle {
    Vec3 v0{0};
    std::uint32_t index = 0;  ///< bits 0 to 26: the scene's triangle; bit 30 is set
    Vec3 e1{0};
    std::uint32_t unused1 = 0;
    Vec3 e2{0};
    std::uint32_t unused2 = 0;

    std::uint32_t sceneTriangle() const { return index & 0x07ffffff; }
};

static_assert(sizeof(BvhNode) == 32 && sizeof(BvhTriangle) == 48);

/// The hierarchy. The root is left out, since rays start within its box: a search begins with node
/// 0, the root's first child. Both are empty for a scene without triangles.
struct Bvh {
    static constexpr std::uint32_t kMaxLeafSize = 4;

    std::vector<BvhNode> nodes;
    std::vector<BvhTriangle> triangles;  ///< each of the scene once, in the order of the leaves
};

/// Builds the hierarchy of a scene of finite vertices; the same scene gives the same bits with any
/// number of threads. Boxes are padded for rays that start in the scene or no farther from it than
/// it is large. Throws InputError for more than 2^26 triangles and Error if memory runs out.
Bvh buildBvh(const Scene& scene);

}  // namespace vlf
