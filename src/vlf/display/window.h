#pragma once
// A window with an OpenGL 4.5 core context, and what its user does in it.

#include "vlf/display/keys.h"
#include "vlf/math/vector.h"

#include <optional>
#include <string>
#include <vector>

struct GLFWwindow;

namespace vlf {

/// Where a window lies on the desktop, in the units of the desktop.
struct WindowPlace {
    int width = 1024, height = 768;
    std::optional<int> x, y;  ///< of the upper left corner; none: the desktop chooses

    bool operator==(const WindowPlace&) const = default;
};

struct WindowOptions {
    std::string title;
    WindowPlace place;
    bool fullscreen = false;
    bool vsync = true;
    int samples = 0;  ///< of multisampling, per pixel; 0: none
};

struct KeyPress {
    Key key = Key::unknown;
    bool shift = false;
    bool control = false;
    bool repeated = false;  ///< it has been held for a while
};

/// Whoever is told what the user does. Calls come from within Window::poll.
class WindowListener {
  public:
    virtual ~WindowListener() = default;

    virtual void keyPressed(const KeyPress& press) = 0;
    /// The left button goes down, or up again. `at` is the pointer's place in parts of the window's
    /// width and height, from the upper left.
    virtual void pointerPressed(const Vec2& at) = 0;
    virtual void pointerReleased(const Vec2& at) = 0;
    /// The pointer has moved, with a button held or captured, by so many units of the desktop, and
    /// is now at `at`; right and down are positive.
    virtual void pointerDragged(const Vec2& by, const Vec2& at) = 0;
    /// The wheel has turned; away from the user is positive.
    virtual void scrolled(float steps) = 0;
};

/// The window, whose context is current on the calling thread while it lives; there is one at a
/// time. A window that cannot be opened is an Error that says why and what to do instead.
class Window {
  public:
    explicit Window(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Takes what has happened since the last call to the listener. Never waits, except for up to
    /// a tenth of a second while nothing of the window is to be seen.
    void poll(WindowListener& listener);
    /// Shows what has been drawn.
    void swap();

    bool closing() const;
    void close();
    /// Nothing can be drawn: the window is an icon or has no area.
    bool hidden() const;

    int pixelWidth() const;   ///< of the framebuffer
    int pixelHeight() const;  ///< of the framebuffer
    /// What sizes of text and lines are to be multiplied by on this monitor; at least 1.
    float contentScale() const;

    void setTitle(const std::string& title);
    bool fullscreen() const;
    void setFullscreen(bool on);
    /// Place outside of full screen.
    WindowPlace place() const;

    /// A captured pointer is invisible and moves without end.
    bool pointerCaptured() const;
    void capturePointer(bool on);
    /// In parts of the window's width and height, from the upper left.
    Vec2 pointer() const;

    bool held(Key key) const;
    std::optional<Gamepad> gamepad() const;

    /// For libraries that draw into windows of GLFW.
    GLFWwindow* handle() const { return window_; }

  private:
    enum class PointerAction { press, drag, release };

    struct PointerEvent {
        PointerAction action = PointerAction::drag;
        Vec2 at{0}, by{0};
    };

    void open(const WindowOptions& options);
    void listen();
    void noteDrag(const Vec2& from, const Vec2& to);
    void tellPointer(WindowListener& listener);
    Vec2 inWindow(const Vec2& desktop) const;
    Vec2 placeOfEvent() const;
    void forgetPointer();

    GLFWwindow* window_ = nullptr;
    WindowPlace place_;
    std::vector<KeyPress> presses_;
    std::optional<Vec2> pointer_;
    std::vector<PointerEvent> pointerEvents_;
    float scrolled_ = 0;
};

}  // namespace vlf
