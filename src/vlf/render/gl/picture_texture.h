#pragma once
// A picture as a texture, for whoever draws windows over the room.

#include "vlf/image/image.h"
#include "vlf/render/gl/gl_object.h"

namespace vlf::gl {

/// Needs the context current in which it was made.
class PictureTexture {
  public:
    /// Takes display-linear colours; its texels are sRGB-encoded.
    void set(const Image& image);

    /// Name of the texture; 0: nothing was set.
    unsigned id() const { return texture_.id(); }

  private:
    TextureObject texture_;
};

}  // namespace vlf::gl
