#pragma once
// The keys of a keyboard and the state of a gamepad, without the library that reads them.

#include "vlf/math/vector.h"

namespace vlf {

/// Keys by their place on a US keyboard: letters and digits have their ASCII codes (Key{'G'}), the
/// others those of GLFW.
enum class Key : int {
    unknown = -1,
    minus = 45,
    equal = 61,
    leftBracket = 91,
    rightBracket = 93,
    escape = 256,
    tab = 258,
    del = 261,
    right = 262,
    left = 263,
    down = 264,
    up = 265,
    pageUp = 266,
    pageDown = 267,
    f1 = 290,
    f2 = 291,
    f3 = 292,
    f5 = 294,
    f11 = 300,
    f12 = 301,
    keypadSubtract = 333,
    keypadAdd = 334,
    leftShift = 340,
    leftControl = 341,
    rightShift = 344,
    rightControl = 345,
};

/// What the first gamepad says.
struct Gamepad {
    Vec2 leftStick{0}, rightStick{0};         ///< each axis in [-1, 1]; right and down positive
    float leftTrigger = 0, rightTrigger = 0;  ///< in [0, 1]
    bool fast = false;                        ///< either bumper is held
};

}  // namespace vlf
