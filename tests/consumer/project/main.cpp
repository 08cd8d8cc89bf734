// The smallest program around the library: makes a room, bakes it, saves and loads the field, and
// looks something up in it.

#include <vlf/base/error.h>
#include <vlf/base/progress.h>
#include <vlf/field/direction_set.h>
#include <vlf/io/field_file.h>
#include <vlf/propagate/bake.h>
#include <vlf/scene/generate/generate.h>
#include <vlf/scene/scene.h>

#include <cstdio>

int main() try {
    const vlf::Scene scene = vlf::generateScene("cornell");

    vlf::BakeParams params = vlf::presetParams("draft");
    params.texelBudget = 2000;
    vlf::Progress progress;
    vlf::writeField("cornell.vlf", {scene, vlf::bake(scene, params, progress)});

    const vlf::BakedRoom room = vlf::readField("cornell.vlf");
    const vlf::Chart& chart = room.field.charts.front();
    const vlf::Vec3 irradiance =
        room.field.atlas.sample(chart, {0.5f * chart.width, 0.5f * chart.height});
    const vlf::DirectionSet directions(513);
    std::printf("%zu charts, %g W/m2 in the middle of the first, straight up is direction %u\n",
                room.field.charts.size(), vlf::luminance(irradiance),
                directions.nearest({0, 1, 0}));
    return irradiance.x > 0 ? 0 : 1;
} catch (const vlf::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
