#pragma once
// OpenGL without a window, through EGL.

namespace vlf::gl {

/// An OpenGL 4.5 core context without a surface, current on the calling thread while it lives.
class HeadlessContext {
  public:
    /// Throws Error, saying what is missing and what to do, if there is no EGL or no OpenGL 4.5.
    explicit HeadlessContext(bool debug = false);
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

  private:
    void* display_ = nullptr;
    void* context_ = nullptr;
};

}  // namespace vlf::gl
