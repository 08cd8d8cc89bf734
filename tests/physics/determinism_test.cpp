// The same field, to the last bit, for any number of threads.

#include "solved_scene.h"

#include "vlf/base/parallel.h"
#include "vlf/propagate/radiance_bake.h"
#include "vlf/scene/generate/generate.h"

#include <gtest/gtest.h>

namespace vlf::test {

namespace {

LightField bakeOn(int threads, const Scene& scene) {
    const ThreadLimit limit(threads);
    BakeParams p = quickParams(6000);
    p.maxBounces = 3;
    p.cells = 128;
    Progress progress;
    LightField field = bake(scene, p, progress);
    field.radiance = bakeRadiance(scene, RayScene(scene), field, {129, 64, 16}, progress);
    return field;
}

void expectSameField(const LightField& a, const LightField& b) {
    EXPECT_EQ(a.atlas.width, b.atlas.width);
    EXPECT_EQ(a.atlas.irradiance, b.atlas.irradiance);
    EXPECT_EQ(a.record.energy.absorbed, b.record.energy.absorbed);
    ASSERT_EQ(a.radiance.elements.size(), b.radiance.elements.size());
    for (std::size_t i = 0; i < a.radiance.elements.size(); ++i) {
        ASSERT_EQ(a.radiance.elements[i].rgb9e5(), b.radiance.elements[i].rgb9e5());
        ASSERT_EQ(a.radiance.elements[i].distance, b.radiance.elements[i].distance);
    }
}

}  // namespace

TEST(Determinism, TheFieldIsTheSameForAnyNumberOfThreads) {
    for (const char* name : {"caustic", "cornell"}) {
        const Scene scene = generateScene(name);
        const LightField one = bakeOn(1, scene);
        expectSameField(one, bakeOn(2, scene));
        expectSameField(one, bakeOn(7, scene));
    }
}

}  // namespace vlf::test
