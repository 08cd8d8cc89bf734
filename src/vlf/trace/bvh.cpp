#include "vlf/trace/bvh.h"

#include "vlf/base/error.h"
#include "vlf/trace/embree.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <new>
#include <type_traits>

namespace vlf {

namespace {

constexpr std::uint32_t kNormalFloat = 1u << 30, kLeaf = 1u << 31;
constexpr std::size_t kMaxTriangles = std::size_t{1} << 27;

/// A node of Embree's tree. Its boxes are not kept: they follow from the triangles.
struct TreeNode {
    TreeNode* child[2] = {nullptr, nullptr};  ///< both null in a leaf
    std::uint32_t count = 0;                  ///< triangles in or below it
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

void setChildren(void* node, void** children, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i)
        static_cast<TreeNode*>(node)->child[i] = static_cast<TreeNode*>(children[i]);
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
TreeNode* buildTree(RTCBVH tree, std::vector<RTCBuildPrimitive>& primitives) {
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = 512;  // Flattening keeps the limit: Embree would fail at it
    arguments.maxLeafSize = Bvh::kMaxLeafSize;
    arguments.bvh = tree;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = createNode;
    arguments.setNodeChildren = setChildren;
    arguments.setNodeBounds = [](void*, const RTCBounds**, unsigned, void*) {};
    arguments.createLeaf = createLeaf;
    return static_cast<TreeNode*>(rtcBuildBVH(&arguments));
}

/// Inner nodes on the longest way down when n triangles are halved until they fit leaves.
int halvingDepth(std::size_t n) {
    return n <= Bvh::kMaxLeafSize ? 0 : std::bit_width((n - 1) / Bvh::kMaxLeafSize);
}

/// Copies Embree's tree depth first. Where what is left would not fit into the depth that is left,
/// its triangles are halved in the order of Embree's leaves instead.
class Flattening {
  public:
    explicit Flattening(const Scene& scene) : scene_(scene) {
        const Bounds all = boundsOf(scene);
        if (all.empty()) return;
        padding_ = 1e-6f * maxComponent(glm::max(glm::abs(all.lower), glm::abs(all.upper)));
    }

    /// `root` is null for a scene without triangles.
    Bvh run(TreeNode* root) && {
        order_.reserve(scene_.triangles.size());
        if (root) collect(*root);
        bvh_.triangles.reserve(order_.size());
        if (order_.size() > Bvh::kMaxLeafSize)
            addInner(root, {0, static_cast<std::uint32_t>(order_.size())}, 1);
        else
            addOnlyLeaf();
        return std::move(bvh_);
    }

  private:
    struct Range {
        std::uint32_t begin, end;
        std::uint32_t size() const { return end - begin; }
    };

    /// Lists the triangles in the order of the leaves and counts those below inner nodes.
    void collect(TreeNode& node) {
        if (node.isLeaf()) {
            order_.insert(order_.end(), node.triangle, node.triangle + node.count);
            return;
        }
        node.count = 0;
        for (TreeNode* child : node.child) {
            collect(*child);
            node.count += child->count;
        }
    }

    /// `node` is null below the place where halving began; `depth` counts the nodes from the root
    /// to the one added.
    BvhChild addInner(const TreeNode* node, Range range, int depth) {
        const auto index = static_cast<std::uint32_t>(bvh_.nodes.size());
        bvh_.nodes.emplace_back();
        bvh_.depth = std::max(bvh_.depth, depth);
        if (node && (node->isLeaf() || !fits(*node, depth))) node = nullptr;
        const std::uint32_t left = node ? node->child[0]->count : (range.size() + 1) / 2;
        const std::uint32_t middle = range.begin + left;
        BvhNode inner;
        inner.child[0] = addChild(node ? node->child[0] : nullptr, {range.begin, middle}, depth);
        inner.child[1] = addChild(node ? node->child[1] : nullptr, {middle, range.end}, depth);
        bvh_.nodes[index] = inner;
        BvhChild whole;
        whole.lower = glm::min(inner.child[0].lower, inner.child[1].lower);
        whole.upper = glm::max(inner.child[0].upper, inner.child[1].upper);
        whole.reference.word = kNormalFloat | index;
        return whole;
    }

    bool fits(const TreeNode& node, int depth) const {
        return depth + halvingDepth(node.child[0]->count) <= Bvh::kMaxDepth &&
               depth + halvingDepth(node.child[1]->count) <= Bvh::kMaxDepth;
    }

    BvhChild addChild(const TreeNode* node, Range range, int depth) {
        const bool leaf = node ? node->isLeaf() : range.size() <= Bvh::kMaxLeafSize;
        return leaf ? addLeaf(range) : addInner(node, range, depth + 1);
    }

    BvhChild addLeaf(Range range) {
        BvhChild leaf;
        leaf.reference.word = kLeaf | kNormalFloat | range.size() << 27 |
                              static_cast<std::uint32_t>(bvh_.triangles.size());
        Bounds bounds;
        for (std::uint32_t i = range.begin; i < range.end; ++i) addTriangle(order_[i], bounds);
        leaf.lower = bounds.lower - padding_;
        leaf.upper = bounds.upper + padding_;
        return leaf;
    }

    void addTriangle(std::uint32_t index, Bounds& bounds) {
        const Vec3& v0 = scene_.position(index, 0);
        const Vec3& v1 = scene_.position(index, 1);
        const Vec3& v2 = scene_.position(index, 2);
        for (const Vec3* v : {&v0, &v1, &v2}) bounds.add(*v);
        bvh_.triangles.push_back({v0, kNormalFloat | index, v1 - v0, 0, v2 - v0, 0});
    }

    void addOnlyLeaf() {
        BvhNode root;
        const auto count = static_cast<std::uint32_t>(order_.size());
        root.child[0] = addLeaf({0, count});
        root.child[1] = addLeaf({count, count});
        bvh_.nodes = {root};
        bvh_.depth = 1;
    }

    const Scene& scene_;
    float padding_ = 0;  ///< metres
    std::vector<std::uint32_t> order_;
    Bvh bvh_;
};

}  // namespace

Bvh buildBvh(const Scene& scene) {
    if (scene.triangles.size() > kMaxTriangles)
        throw InputError("the scene has more triangles than a hierarchy can hold, 2^27");
    if (scene.triangles.empty()) return Flattening(scene).run(nullptr);
    const Device device(rtcNewDevice(nullptr));
    const Tree tree(device ? rtcNewBVH(device.get()) : nullptr);
    std::vector<RTCBuildPrimitive> primitives = makePrimitives(scene);
    TreeNode* root = tree ? buildTree(tree.get(), primitives) : nullptr;
    if (!root) throw Error("the hierarchy over the triangles could not be built: out of memory?");
    return Flattening(scene).run(root);
}

}  // namespace vlf
