#include "seen.h"

namespace vlf::app {

namespace {

bool sameView(const Camera& a, const Camera& b) {
    return a.eye == b.eye && a.look == b.look && a.up == b.up && a.verticalFov == b.verticalFov;
}

bool sameLook(const RenderSettings& a, const RenderSettings& b) {
    return a.mode == b.mode && a.normals == b.normals && a.lookup == b.lookup && a.tone == b.tone &&
           a.exposure == b.exposure;
}

}  // namespace

bool operator==(const Seen& a, const Seen& b) {
    return sameView(a.camera, b.camera) && sameLook(a.settings, b.settings) && a.width == b.width &&
           a.height == b.height && a.lightChanges == b.lightChanges;
}

}  // namespace vlf::app
