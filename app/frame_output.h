#pragma once
// Where the frames of a moving camera go: a film, or a picture each.

#include "render_options.h"

#include <memory>
#include <string>
#include <vector>

namespace vlf::app {

class FrameOutput {
  public:
    virtual ~FrameOutput() = default;

    /// Takes the pictures of a frame, one per name. Frames come in order. Throws FileError.
    virtual void add(int frame, const std::vector<Image>& pictures) = 0;

    /// After the last frame; without it a film is given up. Throws FileError.
    virtual void finish() {}

    /// Of the films, or the patterns of the pictures' names.
    virtual std::vector<std::string> names() const = 0;
};

/// What the options ask for. Throws FileError if a file cannot be written, the log included, and as
/// FilmWriter.
std::unique_ptr<FrameOutput> openFrameOutput(const RenderOptions& options, int firstFrame);

}  // namespace vlf::app
