#pragma once
// The panel with all settings of the walkthrough.

namespace vlf::app {

class Viewer;

/// Draws it within a frame of the Gui, and does what is operated in it.
void drawPanel(Viewer& viewer);

}  // namespace vlf::app
