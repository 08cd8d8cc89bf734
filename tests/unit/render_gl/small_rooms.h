#pragma once
// Example scenes with few texels.

#include "support/baked_example.h"

namespace vlf::test {

inline BakedExample smallRoom(const std::string& name) {
    return BakedExample(name, 5000);
}

/// The mirror room, made once.
inline const BakedExample& mirrorRoom() {
    static const BakedExample room = smallRoom("mirror-room");
    return room;
}

}  // namespace vlf::test
