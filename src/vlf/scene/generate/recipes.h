#pragma once
// The example scenes, one file each. A recipe with a statue takes its triangle count, already
// checked.

#include "vlf/scene/scene.h"

namespace vlf {

Scene makeCornell();
Scene makeMirrorRoom(int statueTriangles);
Scene makeTwoRooms();
Scene makeSealed();
Scene makeOffice();
Scene makeGrotto();
Scene makeGallery(int statueTriangles);
Scene makeCaustic();
Scene makeGloss();
Scene makeGlass();

}  // namespace vlf
