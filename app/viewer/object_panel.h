#pragma once
// The panel's section with the objects.

namespace vlf::app {

class Viewer;

/// Within the panel.
void drawObjectPanel(Viewer& viewer);

}  // namespace vlf::app
