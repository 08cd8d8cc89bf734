#pragma once
// A scene as the bundle sweeps see it, and one bundle swept through it.

#include "vlf/base/error.h"
#include "vlf/propagate/bundle_faces.h"
#include "vlf/propagate/bundle_sweep.h"
#include "vlf/unwrap/chart_groups.h"
#include "vlf/unwrap/chart_layout.h"

#include "support/analytic_scenes.h"

namespace vlf::test {

/// Which sides of the surfaces have texels: all fronts and nothing else, or those light reaches.
enum class Sides { fronts, asFound };

/// Charts and atlas of all fronts.
inline Unwrap unwrapFronts(const Scene& scene, float texelSize) {
    Unwrap result;
    result.texelSize = texelSize;
    result.triangleCharts.resize(scene.triangles.size());
    for (const ChartGroup& group : groupTriangles(scene, texelSize)) {
        for (const std::uint32_t t : group.triangles)
            result.triangleCharts[t].front = static_cast<std::uint32_t>(result.charts.size());
        result.charts.push_back(layOutChart(scene, group, texelSize));
    }
    const AtlasSize size = packCharts(result.charts);
    result.atlasWidth = size.width;
    result.atlasHeight = size.height;
    return result;
}

struct SweptScene {
    SweptScene(const Scene& sceneToSweep, float texelSize, Sides sides = Sides::fronts)
        : scene(sceneToSweep),
          unwrap(sides == Sides::fronts ? unwrapFronts(scene, texelSize)
                                        : vlf::unwrap(scene, RayScene(scene), {texelSize})) {
        const Sphere sphere = boundingSphere(scene);
        frame = {sphere.centre, sphere.radius};
        faces = makeBundleFaces(scene, unwrap, frame);
        radiance = gathered = TexelBuffer(unwrap.atlasSize());
        for (std::size_t i = 0; i <= outside(); ++i) radiance.set(i, Vec3(0), 1);
    }

    /// Gives every texel of a triangle's front chart this radiance, gutter and all.
    void setRadiance(std::uint32_t triangle, const Vec3& rgb) {
        forEachTexel(triangle, [&](std::size_t texel) { radiance.set(texel, rgb, 1); });
    }
    void setOutside(const Vec3& rgb) { radiance.set(outside(), rgb, 1); }
    std::size_t outside() const { return radiance.texelCount(); }

    /// Sweeps one bundle on top of what is gathered already; returns the number of exchanges.
    std::uint64_t sweep(const Vec3& direction, int cells, float roll = 0,
                        const Vec2& jitter = Vec2(0)) {
        return sweepBundle(faces, makeSubfield(frame, direction, cells, roll, jitter), radiance,
                           gathered, sights, scratch);
    }

    /// What the texels of a triangle's front chart have gathered.
    struct Sum {
        Vec3 rgb{0};
        float samples = 0;
    };
    Sum gatheredBy(std::uint32_t triangle) const {
        Sum sum;
        forEachTexel(triangle, [&](std::size_t texel) {
            sum.rgb += gathered.rgb(texel);
            sum.samples += gathered.weight(texel);
        });
        return sum;
    }

    Scene scene;
    Unwrap unwrap;
    FieldFrame frame;
    BundleFaces faces;
    TexelBuffer radiance, gathered;
    std::vector<MirrorSight> sights;
    SweepScratch scratch;

  private:
    template <class Visit>
    void forEachTexel(std::uint32_t triangle, Visit visit) const {
        const Chart& c = unwrap.charts[unwrap.triangleCharts[triangle].front];
        for (std::uint32_t y = c.y; y < c.y + c.height; ++y)
            for (std::uint32_t x = c.x; x < c.x + c.width; ++x)
                visit(static_cast<std::size_t>(y) * unwrap.atlasWidth + x);
    }
};

/// Adds a horizontal unit square at height y, facing up or down.
inline void addSquare(SceneBuilder& b, float y, bool up, std::uint32_t material) {
    const Vec3 x(1, 0, 0), z(0, 0, 1);
    b.quad({0, y, 0}, up ? z : x, up ? x : z, material);
}

}  // namespace vlf::test
