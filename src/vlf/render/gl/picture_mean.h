#pragma once
// The weighted mean of pictures, pixel by pixel.

#include "vlf/render/gl/float_target.h"
#include "vlf/render/gl/renderer.h"
#include "vlf/render/gl/shader_library.h"

#include <string>

namespace vlf::gl {

class PictureMean {
  public:
    /// Throws InputError if a shader of the folder is at fault.
    explicit PictureMean(const std::string& shaderFolder);

    /// Of other pictures from now on. Call clear before the first is added.
    void resize(int width, int height);

    /// Forgets all pictures.
    void clear() const;

    /// Adds `part` of a picture, which lies in the lower left width x height pixels of `picture`
    /// and is stretched to the size of the mean.
    void add(const FloatTarget& picture, int width, int height, float weight,
             const PixelRectangle& part) const;

    /// To draw a first picture into instead, which then has weight 1.
    const FloatTarget& sum() const { return sum_; }

    /// Draws the mean into the view's rectangle, with the exposure and tone curve of the settings.
    void show(const View& view, const RenderSettings& settings, GLuint framebuffer) const;

  private:
    void draw(GLuint program, const FloatTarget& picture, int width, int height) const;

    ShaderLibrary shaders_;
    GLuint add_ = 0, show_ = 0;
    Buffer viewBuffer_;
    VertexArray nothing_ = makeVertexArray();
    FloatTarget sum_;  ///< its alpha is the sum of the weights
};

}  // namespace vlf::gl
