#include "vlf/trace/bvh.h"

#include "vlf/base/error.h"
#include "vlf/trace/embree.h"

#include <algorithm>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace vlf {

namespace {

constexpr std::uint32_t kNormalFloat = 1u << 30;
constexpr std::size_t kMaxTriangles = std::size_t{1} << 26;

/// A node of Embree's tree. Its boxes are not kept: they follow from the triangles.
struct TreeNode {
    const TreeNode* child[2] = {nullptr, nullptr};  ///< both null in a leaf
    std::uint32_t count = 0;                        ///< triangles in or below it
    std::uint32_t triangle[Bvh::kMaxLeafSize] = {};

    bool isLeaf() const { return !child[0]; }
};

template <auto release>
struct Release {
    template <typename T>
    void operator()(T* object) const {
        release(object);
    }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release<rtcReleaseDevice>>;
using Tree = std::unique_ptr<std::remove_pointer_t<RTCBVH>, Release<rtcReleaseBVH>>;

Bounds boundsOfTriangle(const Scene& scene, std::uint32_t triangle) {
    Bounds bounds;
    for (int corner = 0; corner < 3; ++corner) bounds.add(scene.position(triangle, corner));
    return bounds;
}

std::vector<RTCBuildPrimitive> makePrimitives(const Scene& scene) {
    std::vector<RTCBuildPrimitive> primitives(scene.triangles.size());
    for (std::uint32_t i = 0; i < primitives.size(); ++i) {
        const auto [lower, upper] = boundsOfTriangle(scene, i);
        primitives[i] = {lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, i};
    }
    return primitives;
}

void* createNode(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(TreeNode), 16)) TreeNode;
}

/// Called when all that is below the node is complete.
void setChildren(void* node, void** children, unsigned count, void*) {
    auto* parent = static_cast<TreeNode*>(node);
    for (unsigned i = 0; i < count; ++i) {
        parent->child[i] = static_cast<const TreeNode*>(children[i]);
        parent->count += parent->child[i]->count;
    }
}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                 std::size_t count, void*) {
    auto* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(TreeNode), 16)) TreeNode;
    leaf->count = static_cast<std::uint32_t>(count);
    for (std::size_t i = 0; i < count; ++i) leaf->triangle[i] = primitives[i].primID;
    std::sort(leaf->triangle, leaf->triangle + count);
    return leaf;
}

/// Embree's tree of at least one triangle; it lives as long as `tree`.
const TreeNode* buildTree(RTCBVH tree, std::vector<RTCBuildPrimitive>& primitives) {
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = 512;  // far from any scene: Embree fails at it, a search has no limit
    arguments.maxLeafSize = Bvh::kMaxLeafSize;
    arguments.bvh = tree;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = createNode;
    arguments.setNodeChildren = setChildren;
    arguments.setNodeBounds = [](void*, const RTCBounds**, unsigned, void*) {};
    arguments.createLeaf = createLeaf;
    return static_cast<const TreeNode*>(rtcBuildBVH(&arguments));
}

/// Copies Embree's tree depth first, of two children the one of fewer triangles first: such are the
/// walls, quickly searched, and a hit there spares what is behind it.
class Flattening {
  public:
    explicit Flattening(const Scene& scene) : scene_(scene) {
        const Bounds all = boundsOf(scene);
        // 8 times the rounding of a coordinate: a slab test rounds three times.
        padding_ = 1e-6f * maxComponent(glm::max(glm::abs(all.lower), glm::abs(all.upper)));
        bvh_.triangles.reserve(scene.triangles.size());
    }

    Bvh run(const TreeNode& root) && {
        if (root.isLeaf())
            add(root);
        else
            addChildren(root);
        return std::move(bvh_);
    }

  private:
    /// Adds the node and all below it; returns its box.
    Bounds add(const TreeNode& node) {
        const std::size_t index = bvh_.nodes.size();
        bvh_.nodes.emplace_back();
        const std::uint32_t leaf = node.isLeaf() ? leafWord(node.count) : 0;
        const Bounds box = node.isLeaf() ? addTriangles(node) : addChildren(node);
        const auto next = static_cast<std::uint32_t>(bvh_.nodes.size());
        bvh_.nodes[index] = {box.lower, kNormalFloat | next, box.upper, leaf};
        return box;
    }

    Bounds addChildren(const TreeNode& node) {
        Bounds box;
        const bool leftFirst = node.child[0]->count <= node.child[1]->count;
        for (const TreeNode* child : {node.child[!leftFirst], node.child[leftFirst]}) {
            const Bounds part = add(*child);
            box.add(part.lower);
            box.add(part.upper);
        }
        return box;
    }

    std::uint32_t leafWord(std::uint32_t count) const {
        return kNormalFloat | count << 27 | static_cast<std::uint32_t>(bvh_.triangles.size());
    }

    Bounds addTriangles(const TreeNode& leaf) {
        Bounds box;
        for (std::uint32_t i = 0; i < leaf.count; ++i) {
            const std::uint32_t index = leaf.triangle[i];
            const Vec3& v0 = scene_.position(index, 0);
            const Vec3& v1 = scene_.position(index, 1);
            const Vec3& v2 = scene_.position(index, 2);
            for (const Vec3* v : {&v0, &v1, &v2}) box.add(*v);
            bvh_.triangles.push_back({v0, kNormalFloat | index, v1 - v0, 0, v2 - v0, 0});
        }
        return {box.lower - padding_, box.upper + padding_};
    }

    const Scene& scene_;
    float padding_ = 0;  ///< metres
    Bvh bvh_;
};

}  // namespace

Bvh buildBvh(const Scene& scene) {
    if (scene.triangles.size() > kMaxTriangles)
        throw InputError("the scene has more triangles than a hierarchy can hold, 2^26");
    if (scene.triangles.empty()) return {};
    const Device device(rtcNewDevice(nullptr));
    const Tree tree(device ? rtcNewBVH(device.get()) : nullptr);
    std::vector<RTCBuildPrimitive> primitives = makePrimitives(scene);
    const TreeNode* root = tree ? buildTree(tree.get(), primitives) : nullptr;
    if (!root) throw Error("the hierarchy over the triangles could not be built: out of memory?");
    return Flattening(scene).run(*root);
}

}  // namespace vlf
