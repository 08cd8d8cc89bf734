#include "fuzz/scratch.h"
#include "fuzz/seeds.h"

#include "unit/io/example_room.h"

#include "vlf/base/file.h"

namespace vlf::fuzz {

namespace {

Blob fileOf(const BakedRoom& room) {
    writeField(scratchPath("seed.vlf"), room);
    return readFile(scratchPath("seed.vlf"));
}

}  // namespace

std::vector<Blob> fieldSeeds() {
    test::ExampleSize mirrors{
        .texelsPerMetre = 1, .lines = 3, .cells = 6, .tileSize = 4, .textureSide = 4};
    test::ExampleSize diffuse = mirrors;
    diffuse.lines = 0;
    return {fileOf(test::makeExampleRoom(mirrors)), fileOf(test::makeExampleRoom(diffuse)),
            fileOf({})};
}

}  // namespace vlf::fuzz
