#pragma once
// Dear ImGui within the walkthrough's window.

#include "vlf/display/window.h"

namespace vlf::app {

/// Its context, as long as it is needed; one at a time. The window's context must be current.
class Gui {
  public:
    explicit Gui(const Window& window);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    /// Begins a frame. Not `interactive`: what is shown takes no notice of the mouse.
    void begin(bool interactive);
    /// Ends the frame and draws it on the window.
    void draw();

    bool wantsPointer() const;  ///< the mouse is over something that can be operated
    bool typing() const;        ///< keys are text for an entry field
};

}  // namespace vlf::app
