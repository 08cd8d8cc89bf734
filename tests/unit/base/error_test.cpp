#include "vlf/base/error.h"

#include <gtest/gtest.h>

namespace vlf {
namespace {

TEST(SourceLocation, ShowsThePartsThatAreKnown) {
    EXPECT_EQ(toString({"room.obj", 12, ""}), "room.obj:12");
    EXPECT_EQ(toString({"room.gltf", 0, "meshes[3]"}), "room.gltf: meshes[3]");
    EXPECT_EQ(toString({"room.obj", 12, "face"}), "room.obj:12: face");
    EXPECT_EQ(toString({"room.obj", 0, ""}), "room.obj");
    EXPECT_EQ(toString({"", 0, "--cells"}), "--cells");
}

TEST(InputError, NamesThePlaceThenTheFault) {
    const InputError error({"room.obj", 7, ""}, "face index 9 of 8 vertices: check the export");
    EXPECT_STREQ(error.what(), "room.obj:7: face index 9 of 8 vertices: check the export");
}

TEST(Error, IsTheBaseOfAllThatAUserCanCause) {
    EXPECT_THROW(throw InputError("x"), Error);
    EXPECT_THROW(throw FileError("room.vlf", "no space left"), Error);
    EXPECT_THROW(throw Cancelled(), Error);
}

}  // namespace
}  // namespace vlf
