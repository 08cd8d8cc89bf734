#include "vlf/scene/import/gltf_paint.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace vlf {

namespace {

/// Texels along a block: that suffice where colours are bilinear, where they are not, and at most.
constexpr int kPlainBlock = 2, kColourBlock = 8, kLargestBlock = 256;

/// Texels of a painted texture, unless its smallest blocks take more.
constexpr double kMostTexels = 1 << 22;

/// The part of a texture that shows a triangle: its corners lie at texels (0, 0), (size - 1, 0) and
/// (0, size - 1) of the block, beginning with corner `first`.
struct Block {
    int first = 0, size = kPlainBlock;
    int x = 0, y = 0;  ///< of texel (0, 0) in the texture

    /// Texels around it that continue it, for filtering.
    int gutter() const { return size > kPlainBlock ? 1 : 0; }
    int fullSize() const { return size + 2 * gutter(); }
};

/// A value of the three corners of a triangle, continued over its plane.
template <class T>
struct Plane {
    T a, b, c;

    T at(float s, float t) const { return a + s * (b - a) + t * (c - a); }
};

/// How far the value at (1, 1) leaves the range of the corners.
float overshoot(const Plane<Vec3>& colour) {
    const Vec3 least = glm::min(colour.a, glm::min(colour.b, colour.c));
    const Vec3 most = glm::max(colour.a, glm::max(colour.b, colour.c));
    const Vec3 opposite = colour.at(1, 1);
    return maxComponent(glm::max(opposite - most, least - opposite));
}

Vec3 withinCorners(const Plane<Vec3>& colour, float s, float t) {
    return glm::clamp(colour.at(s, t), glm::min(colour.a, glm::min(colour.b, colour.c)),
                      glm::max(colour.a, glm::max(colour.b, colour.c)));
}

/// The blocks of a primitive and the textures made of them.
class Sheet {
  public:
    Sheet(Scene& scene, const GltfPrimitive& primitive, const Material& material)
        : scene_(scene), primitive_(primitive) {
        blocks_.resize(primitive.corners.size() / 3);
        for (std::size_t i = 0; i < blocks_.size(); ++i) blocks_[i] = blockOf(i, material);
        limitSizes();
        pack();
    }

    /// The product of a texture (-1: white) at these coordinates and, if wanted, the colours.
    int paint(int texture, const std::vector<Vec2>& uvs, bool coloured) {
        Texture made;
        made.name = texture < 0 ? "vertex colours" : scene_.textures[texture].name;
        made.width = width_;
        made.height = height_;
        made.wrapU = made.wrapV = Wrap::clamp;
        made.linear.resize(static_cast<std::size_t>(width_) * height_, Vec3(0));
        for (std::size_t i = 0; i < blocks_.size(); ++i)
            paintBlock(made, i, texture < 0 ? nullptr : &scene_.textures[texture], uvs, coloured);
        scene_.textures.push_back(std::move(made));
        return static_cast<int>(scene_.textures.size()) - 1;
    }

    /// Texture coordinates of every corner on the sheet.
    std::vector<Vec2> uvs() const {
        std::vector<Vec2> uvs(3 * blocks_.size());
        for (std::size_t i = 0; i < blocks_.size(); ++i) {
            const Block& block = blocks_[i];
            for (int k = 0; k < 3; ++k) {
                const int x = block.x + (k == 1 ? block.size - 1 : 0);
                const int y = block.y + (k == 2 ? block.size - 1 : 0);
                uvs[3 * i + static_cast<std::size_t>((block.first + k) % 3)] = {
                    (x + 0.5f) / width_, 1 - (y + 0.5f) / height_};
            }
        }
        return uvs;
    }

  private:
    template <class T>
    Plane<T> planeOf(const std::vector<T>& values, std::size_t triangle, int first) const {
        const auto at = [&](int k) {
            return values[primitive_
                              .corners[3 * triangle + static_cast<std::size_t>((first + k) % 3)]];
        };
        return {at(0), at(1), at(2)};
    }

    /// Texels of a texture along the longest edge of a triangle.
    float texelsAlong(int texture, const std::vector<Vec2>& uvs, std::size_t triangle) const {
        if (texture < 0) return 0;
        const Texture& t = scene_.textures[texture];
        const Plane<Vec2> uv = planeOf(uvs, triangle, 0);
        float longest = 0;
        for (const Vec2& edge : {uv.b - uv.a, uv.c - uv.b, uv.a - uv.c})
            longest = std::max({longest, std::abs(edge.x) * t.width, std::abs(edge.y) * t.height});
        return std::min(longest, static_cast<float>(kLargestBlock));
    }

    const std::vector<Vec2>& emissionUvs() const {
        return primitive_.emissionUvs.empty() ? primitive_.uvs : primitive_.emissionUvs;
    }

    Block blockOf(std::size_t triangle, const Material& material) const {
        Block block;
        const float texels =
            std::max(texelsAlong(material.diffuseTexture, primitive_.uvs, triangle),
                     texelsAlong(material.emissionTexture, emissionUvs(), triangle));
        block.size =
            std::clamp(static_cast<int>(std::ceil(texels)) + 1, kPlainBlock, kLargestBlock);
        if (primitive_.colors.empty()) return block;
        std::array<float, 3> over{};
        for (int first = 0; first < 3; ++first)
            over[static_cast<std::size_t>(first)] =
                overshoot(planeOf(primitive_.colors, triangle, first));
        block.first = static_cast<int>(std::min_element(over.begin(), over.end()) - over.begin());
        if (over[static_cast<std::size_t>(block.first)] > 1e-3f)
            block.size = std::max(block.size, kColourBlock);
        return block;
    }

    double totalTexels() const {
        return std::accumulate(blocks_.begin(), blocks_.end(), 0.0, [](double sum, const Block& b) {
            return sum + static_cast<double>(b.fullSize()) * b.fullSize();
        });
    }

    void limitSizes() {
        const double scale = std::sqrt(kMostTexels / std::max(1.0, totalTexels()));
        if (scale >= 1) return;
        for (Block& block : blocks_)
            block.size = std::max(kPlainBlock, static_cast<int>(block.size * scale));
    }

    /// Rows of blocks, the largest first.
    void pack() {
        std::vector<std::uint32_t> order(blocks_.size());
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return blocks_[a].size > blocks_[b].size;
        });
        const int largest = blocks_[order.front()].fullSize();
        const auto side = static_cast<unsigned>(std::ceil(std::sqrt(totalTexels())));
        width_ = static_cast<int>(std::bit_ceil(std::max(side, static_cast<unsigned>(largest))));
        int x = 0, y = 0, rowHeight = largest;
        for (const std::uint32_t i : order) {
            Block& block = blocks_[i];
            if (x + block.fullSize() > width_) {
                x = 0;
                y += rowHeight;
                rowHeight = block.fullSize();
            }
            block.x = x + block.gutter();
            block.y = y + block.gutter();
            x += block.fullSize();
        }
        height_ = y + rowHeight;
    }

    void paintBlock(Texture& made, std::size_t triangle, const Texture* source,
                    const std::vector<Vec2>& uvs, bool coloured) const {
        const Block& block = blocks_[triangle];
        const Plane<Vec2> uv = planeOf(uvs, triangle, block.first);
        const Plane<Vec3> colour = coloured ? planeOf(primitive_.colors, triangle, block.first)
                                            : Plane<Vec3>{Vec3(1), Vec3(1), Vec3(1)};
        const auto scale = 1 / static_cast<float>(block.size - 1);
        const int begin = -block.gutter(), end = block.size + block.gutter();
        for (int j = begin; j < end; ++j)
            for (int i = begin; i < end; ++i) {
                const float s = i * scale, t = j * scale;
                const Vec3 texel = source ? source->sample(uv.at(s, t)) : Vec3(1);
                made.linear[static_cast<std::size_t>(block.y + j) * width_ + block.x + i] =
                    texel * withinCorners(colour, s, t);
            }
    }

    Scene& scene_;
    const GltfPrimitive& primitive_;
    std::vector<Block> blocks_;  ///< of the triangles
    int width_ = 0, height_ = 0;
};

bool areAll(const std::vector<Vec3>& colors, const Vec3& colour) {
    return std::all_of(colors.begin(), colors.end(), [&](const Vec3& c) { return c == colour; });
}

}  // namespace

GltfPainter::Painted GltfPainter::make(const GltfPrimitive& primitive, std::uint32_t material) {
    Material copy = scene_.materials[material];
    std::vector<Vec2> uvs;
    if (primitive.emissionUvs.empty() && areAll(primitive.colors, primitive.colors.front())) {
        copy.diffuse *= primitive.colors.front();
        copy.mirror *= primitive.colors.front();
    } else {
        Sheet sheet(scene_, primitive, copy);
        const bool coloured = !primitive.colors.empty();
        const bool sameTexture = copy.mirrorTexture == copy.diffuseTexture;
        uvs = sheet.uvs();
        if (coloured || copy.diffuseTexture >= 0)
            copy.diffuseTexture = sheet.paint(copy.diffuseTexture, primitive.uvs, coloured);
        if (sameTexture)
            copy.mirrorTexture = copy.diffuseTexture;
        else if (coloured || copy.mirrorTexture >= 0)
            copy.mirrorTexture = sheet.paint(copy.mirrorTexture, primitive.uvs, coloured);
        if (copy.emissionTexture >= 0)
            copy.emissionTexture = sheet.paint(
                copy.emissionTexture,
                primitive.emissionUvs.empty() ? primitive.uvs : primitive.emissionUvs, false);
    }
    scene_.materials.push_back(std::move(copy));
    return {static_cast<std::uint32_t>(scene_.materials.size()) - 1, std::move(uvs)};
}

std::uint32_t GltfPainter::paint(GltfPrimitive& primitive, std::uint32_t material,
                                 const tinygltf::Primitive& source) {
    if (areAll(primitive.colors, Vec3(1))) primitive.colors.clear();
    if (primitive.corners.empty() || (primitive.colors.empty() && primitive.emissionUvs.empty()))
        return material;
    auto known = painted_.find(&source);
    if (known == painted_.end()) known = painted_.emplace(&source, make(primitive, material)).first;
    const Painted& painted = known->second;
    if (!painted.uvs.empty()) {
        primitive.unshare();
        primitive.uvs = painted.uvs;
    }
    return painted.material;
}

}  // namespace vlf
