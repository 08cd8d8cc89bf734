#pragma once
// The part of the panel that is about objects.

#include "objects.h"

#include <cstdint>
#include <optional>
#include <string>

namespace vlf::app {

class Viewer;

/// Remembers what is being typed and dragged.
class ObjectPanel {
  public:
    /// `viewer` must outlive it.
    explicit ObjectPanel(Viewer& viewer) : viewer_(viewer) {}

    /// Within a window of the Gui.
    void draw();

  private:
    struct MaterialEdit {
        std::uint64_t object;
        ObjectSource source;
    };

    void drawAdding();
    void drawSelected(std::size_t i);
    void drawMaterial(std::size_t i);

    Viewer& viewer_;
    std::string adding_;                   ///< text of what is to be added
    std::optional<MaterialEdit> editing_;  ///< while a colour is held
};

}  // namespace vlf::app
