#include "vlf/render/gl/context_loss.h"

#include <epoxy/gl.h>

namespace vlf::gl {

bool contextLost() {
    return glGetGraphicsResetStatus() != GL_NO_ERROR;
}

}  // namespace vlf::gl
