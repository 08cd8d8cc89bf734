#include "vlf/render/gl/driver.h"

#include <string>

#include <epoxy/gl.h>

namespace vlf::gl {

bool contextLost() {
    return glGetGraphicsResetStatus() != GL_NO_ERROR;
}

bool drawsOnCpu() {
    const std::string renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    for (const char* name : {"llvmpipe", "softpipe", "SwiftShader"})
        if (renderer.find(name) != std::string::npos) return true;
    return false;
}

}  // namespace vlf::gl
