#pragma once
// The cells of a parallel subfield whose rays leave a mirror chart, and where on it they start.

#include "vlf/field/light_field.h"
#include "vlf/field/parallel_subfield.h"
#include "vlf/scene/scene.h"

#include <cstdint>
#include <vector>

namespace vlf {

/// A mirror chart with the triangle sides it consists of.
struct MirrorChart {
    std::uint32_t chart = kNoChart;
    bool planar = false;
    struct Side {
        std::uint32_t triangle;
        bool front;
        Vec3 normal;  ///< geometric, of the side
    };
    std::vector<Side> sides;
};

/// All charts whose material is a mirror of this kind or, of the perfect ones, glass; ascending.
/// Those within solid glass have no sides.
std::vector<MirrorChart> mirrorCharts(const Scene& scene, const LightField& field, MirrorKind kind);

/// A cell's place on a chart.
struct MirrorCell {
    int x = 0, y = 0;
    std::uint32_t triangle = 0;
    bool front = true;
    Vec2 barycentric{0};  ///< within the triangle
    Vec3 position{0};     ///< beyond it for guard cells of planar charts
    bool guard = false;   ///< the ray misses the triangle or meets its very edge
};

/// Tiles [begin, end) of one row of tiles; empty if begin >= end.
struct TileSpan {
    int begin = 0, end = 0;
};

/// The tiles that hold the cells of a chart: of row firstRow and the rows that follow it.
struct TileCover {
    int firstRow = 0;
    std::vector<TileSpan> spans;
};

/// Finds the cells of one chart after the other.
///
/// Besides the cells whose rays meet the chart there is a guard band: all cells whose centre lies
/// within one cell of the chart's projection in x and in y, i.e. the four around any of its points.
class MirrorCellFinder {
  public:
    explicit MirrorCellFinder(const Scene& scene) : scene_(scene) {}

    /// The tiles of m x m cells that hold all cells of the chart's sides that face `toEye` (unit;
    /// the subfield's direction or its opposite). No span is empty.
    TileCover tiles(const MirrorChart& chart, const ParallelSubfield& subfield, const Vec3& toEye,
                    int m) const;

    /// The cells of the chart, row by row; where several of its triangles lie behind each other,
    /// on the one nearest to the eye. Valid until the next call.
    const std::vector<MirrorCell>& find(const MirrorChart& chart, const ParallelSubfield& subfield,
                                        const Vec3& toEye);

  private:
    /// The best triangle so far for a cell.
    struct Candidate {
        float outside = kNone;  ///< squared distance of the cell's centre to the triangle, cells²
        float nearness = 0;     ///< metres towards the eye
        std::uint32_t side = 0;
        Vec2 barycentric{0};
        static constexpr float kNone = 1e30f;
    };
    /// Cells [x0, x1) x [y0, y1); empty if x0 >= x1.
    struct CellRange {
        int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    };
    struct Projected;

    bool project(const MirrorChart::Side& side, const ParallelSubfield& subfield, const Vec3& toEye,
                 Projected& projected) const;
    CellRange range(const MirrorChart& chart, const ParallelSubfield& subfield,
                    const Vec3& toEye) const;
    void cover(const Projected& triangle, std::uint32_t side);
    MirrorCell cellAt(const MirrorChart& chart, const ParallelSubfield& subfield, const Vec3& toEye,
                      int x, int y, const Candidate& candidate) const;

    const Scene& scene_;
    CellRange range_;
    std::vector<Candidate> candidates_;
    std::vector<MirrorCell> cells_;
};

}  // namespace vlf
