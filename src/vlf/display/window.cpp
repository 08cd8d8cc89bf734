#include "vlf/display/window.h"

#include "vlf/base/error.h"

#include <algorithm>
#include <array>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace vlf {

namespace {

constexpr double kSecondsHidden = 0.1;  // between looks at a window that nobody sees

#define VLF_SAME_KEY(ours, theirs) static_assert(static_cast<int>(Key::ours) == GLFW_KEY_##theirs)
VLF_SAME_KEY(unknown, UNKNOWN);
VLF_SAME_KEY(minus, MINUS);
VLF_SAME_KEY(equal, EQUAL);
VLF_SAME_KEY(leftBracket, LEFT_BRACKET);
VLF_SAME_KEY(rightBracket, RIGHT_BRACKET);
VLF_SAME_KEY(escape, ESCAPE);
VLF_SAME_KEY(tab, TAB);
VLF_SAME_KEY(del, DELETE);
VLF_SAME_KEY(right, RIGHT);
VLF_SAME_KEY(left, LEFT);
VLF_SAME_KEY(down, DOWN);
VLF_SAME_KEY(up, UP);
VLF_SAME_KEY(pageUp, PAGE_UP);
VLF_SAME_KEY(pageDown, PAGE_DOWN);
VLF_SAME_KEY(f1, F1);
VLF_SAME_KEY(f2, F2);
VLF_SAME_KEY(f3, F3);
VLF_SAME_KEY(f5, F5);
VLF_SAME_KEY(f11, F11);
VLF_SAME_KEY(f12, F12);
VLF_SAME_KEY(keypadSubtract, KP_SUBTRACT);
VLF_SAME_KEY(keypadAdd, KP_ADD);
VLF_SAME_KEY(leftShift, LEFT_SHIFT);
VLF_SAME_KEY(leftControl, LEFT_CONTROL);
VLF_SAME_KEY(rightShift, RIGHT_SHIFT);
VLF_SAME_KEY(rightControl, RIGHT_CONTROL);
#undef VLF_SAME_KEY
static_assert('A' == GLFW_KEY_A && '0' == GLFW_KEY_0);

[[noreturn]] void fail(const std::string& what) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    const std::string text = reason ? reason : "no reason given";
    glfwTerminate();
    throw Error(what + " (" + text + "); vlf render makes pictures without a window");
}

void setHints(const WindowOptions& options) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    glfwWindowHint(GLFW_DEPTH_BITS, 24);
    glfwWindowHint(GLFW_SAMPLES, options.samples);
}

/// Whether a remembered corner still lies on a monitor.
bool onSomeMonitor(int x, int y) {
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    return std::any_of(monitors, monitors + count, [&](GLFWmonitor* monitor) {
        int left = 0, top = 0, width = 0, height = 0;
        glfwGetMonitorWorkarea(monitor, &left, &top, &width, &height);
        return x >= left && y >= top && x < left + width && y < top + height;
    });
}

bool anyButtonHeld(GLFWwindow* window) {
    constexpr std::array kButtons{GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_RIGHT,
                                  GLFW_MOUSE_BUTTON_MIDDLE};
    return std::any_of(kButtons.begin(), kButtons.end(), [&](int button) {
        return glfwGetMouseButton(window, button) == GLFW_PRESS;
    });
}

Window& self(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

}  // namespace

Window::Window(const WindowOptions& options) : place_(options.place) {
    if (!glfwInit()) fail("there is no display to open a window on");
    open(options);
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(options.vsync ? 1 : 0);
    if (place_.x && place_.y && onSomeMonitor(*place_.x, *place_.y))
        glfwSetWindowPos(window_, *place_.x, *place_.y);
    listen();
    if (options.fullscreen) setFullscreen(true);
}

Window::~Window() {
    glfwTerminate();
}

void Window::open(const WindowOptions& options) {
    setHints(options);
    window_ =
        glfwCreateWindow(place_.width, place_.height, options.title.c_str(), nullptr, nullptr);
    if (!window_) fail("the display gives no window with OpenGL 4.5");
}

void Window::listen() {
    glfwSetWindowUserPointer(window_, this);
    // Noted here, told by poll: an exception must not pass through GLFW.
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int modifiers) {
        if (action != GLFW_RELEASE)
            self(w).presses_.push_back({Key{key}, (modifiers & GLFW_MOD_SHIFT) != 0,
                                        (modifiers & GLFW_MOD_CONTROL) != 0,
                                        action == GLFW_REPEAT});
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
        const Vec2 at(x, y);
        const auto last = std::exchange(self(w).pointer_, at);
        // Asked for now: a quick drag begins and ends between two polls.
        if (last && (anyButtonHeld(w) || self(w).pointerCaptured())) self(w).noteDrag(*last, at);
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
        if (button == GLFW_MOUSE_BUTTON_LEFT)
            self(w).pointerEvents_.push_back(
                {action == GLFW_PRESS ? PointerAction::press : PointerAction::release,
                 self(w).placeOfEvent(), Vec2(0)});
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double steps) {
        self(w).scrolled_ += static_cast<float>(steps);
    });
}

void Window::poll(WindowListener& listener) {
    if (hidden())
        glfwWaitEventsTimeout(kSecondsHidden);
    else
        glfwPollEvents();
    for (const KeyPress& press : std::exchange(presses_, {})) listener.keyPressed(press);
    tellPointer(listener);
    if (const float steps = std::exchange(scrolled_, 0.0f); steps != 0) listener.scrolled(steps);
}

/// Drags without a press or a release between them are one.
void Window::noteDrag(const Vec2& from, const Vec2& to) {
    if (pointerEvents_.empty() || pointerEvents_.back().action != PointerAction::drag)
        pointerEvents_.push_back({PointerAction::drag, Vec2(0), Vec2(0)});
    pointerEvents_.back().by += to - from;
    pointerEvents_.back().at = inWindow(to);
}

void Window::tellPointer(WindowListener& listener) {
    for (const PointerEvent& event : std::exchange(pointerEvents_, {})) switch (event.action) {
            case PointerAction::press:
                listener.pointerPressed(event.at);
                break;
            case PointerAction::drag:
                listener.pointerDragged(event.by, event.at);
                break;
            case PointerAction::release:
                listener.pointerReleased(event.at);
                break;
        }
}

void Window::swap() {
    glfwSwapBuffers(window_);
}

bool Window::closing() const {
    return glfwWindowShouldClose(window_) != 0;
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

bool Window::hidden() const {
    return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) || pixelWidth() == 0 || pixelHeight() == 0;
}

int Window::pixelWidth() const {
    int width = 0;
    glfwGetFramebufferSize(window_, &width, nullptr);
    return width;
}

int Window::pixelHeight() const {
    int height = 0;
    glfwGetFramebufferSize(window_, nullptr, &height);
    return height;
}

float Window::contentScale() const {
    float scale = 1;
    glfwGetWindowContentScale(window_, &scale, nullptr);
    return std::max(scale, 1.0f);
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

bool Window::fullscreen() const {
    return glfwGetWindowMonitor(window_) != nullptr;
}

void Window::setFullscreen(bool on) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (on == fullscreen() || !monitor) return;
    if (on) {
        place_ = place();
        const GLFWvidmode* mode = glfwGetVideoMode(monitor);
        glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    } else {
        glfwSetWindowMonitor(window_, nullptr, place_.x.value_or(0), place_.y.value_or(0),
                             place_.width, place_.height, GLFW_DONT_CARE);
    }
    forgetPointer();
}

WindowPlace Window::place() const {
    if (fullscreen()) return place_;
    WindowPlace now;
    int x = 0, y = 0;
    glfwGetWindowSize(window_, &now.width, &now.height);
    glfwGetWindowPos(window_, &x, &y);
    now.x = x;
    now.y = y;
    return now;
}

bool Window::pointerCaptured() const {
    return glfwGetInputMode(window_, GLFW_CURSOR) == GLFW_CURSOR_DISABLED;
}

void Window::capturePointer(bool on) {
    if (glfwRawMouseMotionSupported())
        glfwSetInputMode(window_, GLFW_RAW_MOUSE_MOTION, on ? GLFW_TRUE : GLFW_FALSE);
    glfwSetInputMode(window_, GLFW_CURSOR, on ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    forgetPointer();
}

/// The next place of the pointer is no movement from the last.
void Window::forgetPointer() {
    pointer_.reset();
    pointerEvents_.clear();
}

Vec2 Window::inWindow(const Vec2& desktop) const {
    int width = 1, height = 1;
    glfwGetWindowSize(window_, &width, &height);
    return desktop / Vec2(std::max(width, 1), std::max(height, 1));
}

/// Where the pointer was, by the events so far: asked for, it is where it has gone since.
Vec2 Window::placeOfEvent() const {
    return pointer_ ? inWindow(*pointer_) : pointer();
}

Vec2 Window::pointer() const {
    double x = 0, y = 0;
    glfwGetCursorPos(window_, &x, &y);
    return inWindow(Vec2(x, y));
}

bool Window::held(Key key) const {
    return key != Key::unknown && glfwGetKey(window_, static_cast<int>(key)) == GLFW_PRESS;
}

std::optional<Gamepad> Window::gamepad() const {
    GLFWgamepadstate state;
    if (!glfwGetGamepadState(GLFW_JOYSTICK_1, &state)) return std::nullopt;
    const auto trigger = [&](int axis) { return 0.5f * (state.axes[axis] + 1); };
    Gamepad pad;
    pad.leftStick = {state.axes[GLFW_GAMEPAD_AXIS_LEFT_X], state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y]};
    pad.rightStick = {state.axes[GLFW_GAMEPAD_AXIS_RIGHT_X], state.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]};
    pad.leftTrigger = trigger(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER);
    pad.rightTrigger = trigger(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER);
    pad.fast = state.buttons[GLFW_GAMEPAD_BUTTON_LEFT_BUMPER] == GLFW_PRESS ||
               state.buttons[GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER] == GLFW_PRESS;
    return pad;
}

}  // namespace vlf
