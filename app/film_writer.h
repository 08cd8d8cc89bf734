#pragma once
// Films, encoded by the program ffmpeg.

#include "vlf/base/file.h"
#include "vlf/image/image.h"

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <sys/types.h>

namespace vlf::app {

struct FilmFormat {
    int width = 0, height = 0;  ///< pixels, even
    double fps = 30;
    int crf = 18;  ///< x264's constant rate factor: 1 hardly a loss ... 51 the worst
};

/// Writes an H.264 film (yuv420p, BT.709). It appears under its name only when it is complete;
/// until finish() has returned, destruction leaves nothing.
class FilmWriter {
  public:
    /// Starts ffmpeg. Throws FileError if `path` is no regular file, Error if there is no ffmpeg.
    FilmWriter(const std::string& path, const FilmFormat& format);
    ~FilmWriter();
    FilmWriter(const FilmWriter&) = delete;
    FilmWriter& operator=(const FilmWriter&) = delete;

    /// Appends a frame in display-linear colours. Precondition: it has the format's size. Throws
    /// FileError with what ffmpeg said if it has ended.
    void add(const Image& frame);

    /// Throws FileError with what ffmpeg said if it fails.
    void finish();

  private:
    void start(const FilmFormat& format);
    /// Ends the stream of frames and waits for ffmpeg; returns its wait status.
    int wait();
    [[noreturn]] void fail();

    struct CloseFile {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    std::string path_;
    PendingFile file_;
    std::unique_ptr<std::FILE, CloseFile> messages_;  ///< what ffmpeg says
    pid_t process_ = -1;                              ///< -1: none
    int frames_ = -1;                                 ///< socket that ffmpeg reads from
    std::vector<std::uint8_t> bytes_;                 ///< of a frame
};

}  // namespace vlf::app
