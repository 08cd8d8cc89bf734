#include "key_bindings.h"

#include "viewer.h"

#include <fmt/format.h>

namespace vlf::app {

namespace {

constexpr float kExposureStep = 0.25f;  // EV
constexpr float kFovStep = 5;           // degrees

Key letter(char c) {
    return Key{c};
}

/// After Wither (2005). Arrows still move the camera.
std::vector<Binding> objectBindings() {
    constexpr Subject kObject = Subject::object;
    return {
        {.name = "O",
         .help = "keys move the selected object, or the camera again",
         .keys = {letter('O')},
         .press = [](Viewer& v) { v.objects().toggleSubject(); }},
        {.name = "object: W X",
         .help = "to its -Z, +Z; with Ctrl to its +Y, -Y",
         .keys = {letter('W')},
         .control = false,
         .subject = kObject,
         .push = {0, 0, -1}},
        {.keys = {letter('X')}, .control = false, .subject = kObject, .push = {0, 0, 1}},
        {.keys = {letter('W')}, .control = true, .subject = kObject, .push = {0, 1, 0}},
        {.keys = {letter('X')}, .control = true, .subject = kObject, .push = {0, -1, 0}},
        {.name = "object: A D",
         .help = "to its -X, +X; with Ctrl turn it about its Y",
         .keys = {letter('A')},
         .control = false,
         .subject = kObject,
         .push = {-1, 0, 0}},
        {.keys = {letter('D')}, .control = false, .subject = kObject, .push = {1, 0, 0}},
        {.keys = {letter('A')}, .control = true, .subject = kObject, .spin = {1, 0}},
        {.keys = {letter('D')}, .control = true, .subject = kObject, .spin = {-1, 0}},
        {.name = "object: Q Z",
         .help = "turn it about its X",
         .keys = {letter('Q')},
         .subject = kObject,
         .spin = {0, 1}},
        {.keys = {letter('Z')}, .subject = kObject, .spin = {0, -1}},
        {.name = "click",
         .help = "select an object; drag its arms, squares and rings to move and turn it"},
        {.name = "J",
         .help = "select the next object",
         .keys = {letter('J')},
         .press = [](Viewer& v) { v.objects().selectNext(); }},
        {.name = "Delete",
         .help = "remove the selected object",
         .keys = {Key::del},
         .press =
             [](Viewer& v) {
                 if (v.objects().selected()) v.objects().remove(*v.objects().selected());
             }},
        {.name = "P",
         .help = "motions of objects stand still, or go on",
         .keys = {letter('P')},
         .press = [](Viewer& v) { v.objects().setPlaying(!v.objects().playing()); }},
        {.name = "V",
         .help = "bake the room again with its objects and compare: beside it, by a wipe, end",
         .keys = {letter('V')},
         .press = [](Viewer& v) { v.compareNext(); }},
    };
}

std::vector<Binding> makeBindings() {
    std::vector<Binding> table{
        {.name = "W A S D, arrows",
         .help = "go",
         .keys = {letter('W')},
         .subject = Subject::camera,
         .go = {0, 0, 1}},
        {.keys = {letter('S')}, .subject = Subject::camera, .go = {0, 0, -1}},
        {.keys = {letter('A')}, .subject = Subject::camera, .go = {-1, 0, 0}},
        {.keys = {letter('D')}, .subject = Subject::camera, .go = {1, 0, 0}},
        {.keys = {Key::up}, .go = {0, 0, 1}},
        {.keys = {Key::down}, .go = {0, 0, -1}},
        {.keys = {Key::left}, .go = {-1, 0, 0}},
        {.keys = {Key::right}, .go = {1, 0, 0}},
        {.name = "E, Q",
         .help = "fly up, down",
         .keys = {letter('E')},
         .subject = Subject::camera,
         .go = {0, 1, 0}},
        {.keys = {letter('Q')}, .subject = Subject::camera, .go = {0, -1, 0}},
        {.name = "Shift",
         .help = "faster",
         .keys = {Key::leftShift, Key::rightShift},
         .fast = true},
        {.name = "mouse", .help = "look around while a button is held"},
        {.name = "wheel", .help = "speed"},
        {.name = "gamepad", .help = "sticks go and look, triggers fly down and up, bumpers hurry"},
        {.name = "C",
         .help = "capture the mouse: look around without a button; Escape frees it",
         .keys = {letter('C')},
         .press = [](Viewer& v) { v.captureMouse(true); }},
        {.name = "G",
         .help = "walk on the floor, or fly",
         .keys = {letter('G')},
         .press =
             [](Viewer& v) {
                 v.walk().setMovement(v.walk().navigator().movement() == Movement::fly
                                          ? Movement::walk
                                          : Movement::fly);
             }},
        {.name = "0",
         .help = "back to the start, exposure too",
         .keys = {letter('0')},
         .press = [](Viewer& v) { v.walk().reset(); }},
        {.name = "1 ... 9", .help = "cameras of the scene"},
    };
    for (char digit = '1'; digit <= '9'; ++digit)
        table.push_back({.keys = {letter(digit)}, .press = [digit](Viewer& v) {
                             v.walk().goToCamera(static_cast<std::size_t>(digit - '1'));
                         }});
    const std::vector<Binding> rest{
        {.name = "B",
         .help = "add a bookmark of this place",
         .keys = {letter('B')},
         .press = [](Viewer& v) { v.addBookmark(); }},
        {.name = "N",
         .help = "next bookmark",
         .keys = {letter('N')},
         .press = [](Viewer& v) { v.walk().goToNextBookmark(); }},
        {.name = "M",
         .help = "next display mode",
         .keys = {letter('M')},
         .press = [](Viewer& v) { v.walk().setMode(v.walk().mode() + 1); }},
        {.name = "L",
         .help = "mirrors: correct the lookup by depth, or not",
         .keys = {letter('L')},
         .press =
             [](Viewer& v) {
                 v.walk().setLookup(v.walk().lookup() == LookupKind::plain
                                        ? LookupKind::depthCorrected
                                        : LookupKind::plain);
             }},
        {.name = "+ -",
         .help = "exposure",
         .keys = {Key::equal, Key::keypadAdd},
         .press = [](Viewer& v) { v.walk().changeExposure(kExposureStep); },
         .repeats = true},
        {.keys = {Key::minus, Key::keypadSubtract},
         .press = [](Viewer& v) { v.walk().changeExposure(-kExposureStep); },
         .repeats = true},
        {.name = "X",
         .help = "exposure automatic, or fixed",
         .keys = {letter('X')},
         .press =
             [](Viewer& v) { v.walk().setAutomaticExposure(!v.walk().exposure().automatic()); },
         .subject = Subject::camera},
        {.name = "T",
         .help = "tone curve filmic, or linear",
         .keys = {letter('T')},
         .press =
             [](Viewer& v) {
                 v.walk().setTone(v.walk().tone() == ToneCurve::filmic ? ToneCurve::clamp
                                                                       : ToneCurve::filmic);
             }},
        {.name = "[ ], Page Up, Page Down",
         .help = "narrower, wider field of view",
         .keys = {Key::leftBracket, Key::pageUp},
         .press = [](Viewer& v) { v.walk().changeFov(-kFovStep); },
         .repeats = true},
        {.keys = {Key::rightBracket, Key::pageDown},
         .press = [](Viewer& v) { v.walk().changeFov(kFovStep); },
         .repeats = true},
        {.name = "F5",
         .help = "save the newest finished bake of an opened scene",
         .keys = {Key::f5},
         .press = [](Viewer& v) { v.saveBake(); }},
        {.name = "Tab, F2",
         .help = "panel with all settings",
         .keys = {Key::tab, Key::f2},
         .press = [](Viewer& v) { v.shown().panel ^= true; }},
        {.name = "F3",
         .help = "frame times and memory",
         .keys = {Key::f3},
         .press = [](Viewer& v) { v.shown().statistics ^= true; }},
        {.name = "H, F1",
         .help = "these keys",
         .keys = {letter('H'), Key::f1},
         .press = [](Viewer& v) { v.shown().help ^= true; }},
        {.name = "F11",
         .help = "full screen, or a window",
         .keys = {Key::f11},
         .press = [](Viewer& v) { v.toggleFullscreen(); }},
        {.name = "F12",
         .help = "write the picture as a .png in the current folder",
         .keys = {Key::f12},
         .press = [](Viewer& v) { v.wantPicture(Picture::png); },
         .shift = false},
        {.name = "Shift+F12",
         .help = "write its radiance as an .exr",
         .keys = {Key::f12},
         .press = [](Viewer& v) { v.wantPicture(Picture::exr); },
         .shift = true},
        {.name = "Escape",
         .help = "free the mouse, else hide these keys, else close",
         .keys = {Key::escape},
         .press = [](Viewer& v) { v.escape(); }},
    };
    const std::vector<Binding> objects = objectBindings();
    table.insert(table.end(), objects.begin(), objects.end());
    table.insert(table.end(), rest.begin(), rest.end());
    return table;
}

}  // namespace

const std::vector<Binding>& keyBindings() {
    static const std::vector<Binding> table = makeBindings();
    return table;
}

std::string keyHelp() {
    std::string text;
    for (const Binding& binding : keyBindings())
        if (!binding.name.empty()) text += fmt::format("  {:<24}{}\n", binding.name, binding.help);
    return text;
}

}  // namespace vlf::app
