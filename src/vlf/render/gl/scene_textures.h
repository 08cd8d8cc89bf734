#pragma once
// A scene's textures on the GPU.

#include "vlf/render/gl/gl_object.h"
#include "vlf/scene/scene.h"

#include <vector>

namespace vlf::gl {

class SceneTextures {
  public:
    explicit SceneTextures(const Scene& scene);

    /// Binds a texture of the scene to a unit; white for -1.
    void bind(int unit, int texture) const;

  private:
    std::vector<TextureObject> textures_;
    TextureObject white_;
};

}  // namespace vlf::gl
