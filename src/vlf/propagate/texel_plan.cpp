#include "vlf/propagate/texel_plan.h"

#include "vlf/propagate/light_bend.h"
#include "vlf/propagate/piece_tree.h"
#include "vlf/scene/cut_planes.h"
#include "vlf/unwrap/chart_groups.h"
#include "vlf/unwrap/texel_size.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace vlf {

namespace {

constexpr double kPilotScale = 2;    // texels of the pilot to even ones
constexpr float kBlockTexels = 16;   // even texels along a block
constexpr double kPieceWork = 200;   // texels that take as long as a piece does in the sweeps
constexpr float kTolerance = 0.02f;  // of a block, within which vertices lie on its faces
constexpr float kAligned = 0.9999f;  // cosine between a surface's normal and an axis
constexpr double kWorthwhile = 0.8;  // square error, to that of even texels
constexpr double kSlight = 5e-4;     // relative error that is not worth a plan
constexpr int kPriceSteps = 60;

float scaleOf(int level) {
    return std::exp2(-static_cast<float>(level));
}

/// The flat surfaces that scatter light, in blocks of a grid of cubes.
class Blocks {
  public:
    Blocks(const Scene& scene, float texelSize)
        : groups_(groupTriangles(scene, texelSize)),
          surfaceOf_(groupOfTriangles(groups_, scene.triangles.size())),
          origin_(boundsOf(scene).lower),
          step_(kBlockTexels * texelSize) {
        for (const ChartGroup& g : groups_) {
            const Material& m = scene.material(g.triangles[0]);
            divisible_.push_back(g.planar && maxComponent(m.diffuse) > 0 && !m.isEmitter() &&
                                 !m.isSpecular());
        }
    }

    std::size_t surfaces() const { return groups_.size(); }
    std::uint32_t surfaceOf(std::uint32_t triangle) const { return surfaceOf_[triangle]; }

    /// A surface that lies across an axis has one layer of cells along it.
    Cell cellOf(std::uint32_t surface, const Vec3& p) const {
        Cell cell{};
        for (int a = 0; a < 3; ++a)
            if (std::abs(groups_[surface].axis[a]) < kAligned)
                cell[a] = std::max(0, static_cast<int>(std::floor((p[a] - origin_[a]) / step_)));
        return cell;
    }

    /// Numbers the blocks as they are asked for; kNoBlock: of a surface that is not divided.
    std::uint32_t blockOf(std::uint32_t triangle, const Vec3& p) {
        const std::uint32_t surface = surfaceOf_[triangle];
        if (!divisible_[surface]) return kNoBlock;
        const auto next = static_cast<std::uint32_t>(numbers_.size());
        return numbers_.try_emplace({surface, cellOf(surface, p)}, next).first->second;
    }
    const auto& numbers() const { return numbers_; }

    float plane(int axis, int cell) const {
        return origin_[axis] + static_cast<float>(cell) * step_;
    }
    float tolerance() const { return kTolerance * step_; }

  private:
    std::vector<ChartGroup> groups_;
    std::vector<std::uint32_t> surfaceOf_;
    std::vector<bool> divisible_;  // by surface
    Vec3 origin_;
    float step_;
    std::map<std::pair<std::uint32_t, Cell>, std::uint32_t> numbers_;
};

/// The pilot is cancelled with the whole, but does not pause: there is nothing to keep of it.
class PilotProgress : public Progress {
  public:
    explicit PilotProgress(Progress& whole) : whole_(whole) {}

    void stage(const std::string&) override { follow(); }
    void update(double) override { follow(); }

  private:
    void follow() {
        if (whole_.cancelled()) cancel();
    }

    Progress& whole_;
};

/// A quick bake with few and large texels.
BakeParams pilotParams(const BakeParams& params) {
    BakeParams p = presetParams("draft");
    p.texelSize = static_cast<float>(kPilotScale) * params.texelSize;
    p.texelBudget = params.texelBudget / (kPilotScale * kPilotScale);
    p.radianceDirections = p.glossDirections = 0;
    p.seed = params.seed;
    p.directions = 129;
    p.coarseCells = 64;
    return p;
}

/// By surface.
using Costs = std::vector<std::vector<BlockCost>>;

Costs costsOf(const Blocks& blocks, const std::vector<BendBlock>& bend, float texelSize) {
    Costs costs(blocks.surfaces());
    for (const auto& [place, number] : blocks.numbers()) {
        BlockCost& cost = costs[place.first].emplace_back();
        cost.cell = place.second;
        for (std::size_t i = 0; i < kLevels; ++i) {
            const double size = double{texelSize} * scaleOf(kCoarsestLevel + static_cast<int>(i));
            cost.texels[i] = bend[number].area / (size * size);
            cost.squareError[i] = bend[number].squareError(size);
        }
    }
    return costs;
}

PieceCost total(const std::vector<PieceTree>& trees) {
    PieceCost sum;
    for (const PieceTree& tree : trees) {
        sum.work += tree.cost().work;
        sum.squareError += tree.cost().squareError;
    }
    return sum;
}

/// All surfaces whole, with even texels.
PieceCost evenCost(const Costs& costs) {
    PieceCost sum;
    for (const auto& surface : costs) {
        if (!surface.empty()) sum.work += kPieceWork;
        for (const BlockCost& block : surface) {
            sum.work += block.texels[-kCoarsestLevel];
            sum.squareError += block.squareError[-kCoarsestLevel];
        }
    }
    return sum;
}

/// Pieces of all surfaces that leave the least square error for so much work: each is what is best
/// at one price of work, as it must be where no other sharing of the work would be better.
std::vector<PieceTree> choosePieces(const Costs& costs, double work) {
    std::vector<PieceTree> trees(costs.size());
    const auto choose = [&](double price) {
        for (std::size_t s = 0; s < costs.size(); ++s)
            trees[s] = PieceTree(costs[s], price, kPieceWork);
    };
    double cheap = 1e-30, dear = 1e30;
    for (int i = 0; i < kPriceSteps; ++i) {
        const double price = std::sqrt(cheap * dear);
        choose(price);
        (total(trees).work > work ? cheap : dear) = price;
    }
    choose(dear);
    return trees;
}

AxisPlanes planesBetween(const std::vector<PieceTree>& trees, const Blocks& blocks) {
    AxisPlanes planes;
    for (const PieceTree& tree : trees)
        for (const auto& [axis, cell] : tree.faces())
            planes[axis].push_back(blocks.plane(axis, cell));
    for (std::vector<float>& p : planes) {
        std::sort(p.begin(), p.end());
        p.erase(std::unique(p.begin(), p.end()), p.end());
    }
    return planes;
}

/// The pieces of the triangles of a scene that has been cut from `sources`: 0 is all that is not
/// divided. What is hidden, where the pilot had no texel, is a piece by itself.
TexelPieces piecesOf(const Scene& scene, const std::vector<std::uint32_t>& sources,
                     const std::vector<PieceTree>& trees, const Blocks& blocks) {
    std::vector<std::uint32_t> first;
    std::uint32_t next = 1;
    for (const PieceTree& tree : trees) {
        first.push_back(next);
        next += static_cast<std::uint32_t>(tree.pieces()) + 1;
    }
    TexelPieces pieces(sources.size());
    for (std::uint32_t t = 0; t < pieces.size(); ++t) {
        const std::uint32_t surface = blocks.surfaceOf(sources[t]);
        const PieceTree& tree = trees[surface];
        if (tree.pieces() == 0) continue;
        const Vec3 middle = positionAt(scene, t, Vec2(1.0f / 3));
        const std::size_t piece = tree.pieceAt(blocks.cellOf(surface, middle));
        const bool hidden = piece == PieceTree::kNoPiece;
        pieces[t].piece =
            first[surface] + static_cast<std::uint32_t>(hidden ? tree.pieces() : piece);
        pieces[t].scale = scaleOf(hidden ? kCoarsestLevel : tree.level(piece));
    }
    return pieces;
}

double squareLight(const BakeState& state) {
    double sum = 0;
    for (std::size_t i = 0; i < state.irradiance.size(); ++i)
        if (maxComponent(state.reflectance[i]) > 0)
            sum += state.unwrap.texelArea(i) * glm::dot(state.irradiance[i], state.irradiance[i]);
    return sum;
}

/// By surface; none if even texels are as good.
std::vector<PieceTree> plan(const Scene& scene, const BakeParams& params, float texelSize,
                            Blocks& blocks, Progress& progress) {
    PilotProgress pilotProgress(progress);
    BakeState pilot = makeState(scene, pilotParams(params), pilotProgress);
    propagate(pilot, pilotProgress);
    const std::vector<BendBlock> bend =
        findBend(pilot, [&](std::uint32_t t, const Vec3& p) { return blocks.blockOf(t, p); });
    const Costs costs = costsOf(blocks, bend, texelSize);
    const PieceCost even = evenCost(costs);
    if (even.squareError <= kSlight * kSlight * squareLight(pilot)) return {};
    std::vector<PieceTree> trees = choosePieces(costs, even.work);
    if (total(trees).squareError > kWorthwhile * even.squareError) return {};
    return trees;
}

}  // namespace

TexelPieces planTexels(Scene& scene, const BakeParams& params, Progress& progress) {
    progress.stage("texel sizes");
    const float size =
        params.texelSize > 0 ? params.texelSize : texelSizeForBudget(scene, params.texelBudget);
    Blocks blocks(scene, size);
    const std::vector<PieceTree> trees = plan(scene, params, size, blocks, progress);
    if (trees.empty()) return {};
    std::vector<bool> divided;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        divided.push_back(trees[blocks.surfaceOf(t)].pieces() > 1);
    const std::vector<std::uint32_t> sources =
        cutByPlanes(scene, planesBetween(trees, blocks), blocks.tolerance(), divided);
    return piecesOf(scene, sources, trees, blocks);
}

}  // namespace vlf
