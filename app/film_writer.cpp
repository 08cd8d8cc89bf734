#include "film_writer.h"

#include "vlf/base/error.h"
#include "vlf/base/parallel.h"
#include "vlf/image/srgb.h"

#include <cassert>
#include <cerrno>
#include <csignal>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vlf::app {

namespace {

constexpr std::size_t kLinesToQuote = 4;

std::string systemMessage(int code) {
    return std::generic_category().message(code);
}

std::vector<std::string> commandLine(const FilmFormat& format, const std::string& output) {
    return {"ffmpeg", "-hide_banner", "-nostdin", "-loglevel", "error",
            // what comes in
            "-f", "rawvideo", "-pixel_format", "rgb24", "-video_size",
            fmt::format("{}x{}", format.width, format.height), "-framerate",
            fmt::format("{}", format.fps), "-i", "pipe:0",
            // what goes out; players take untagged colours for one matrix or another
            "-vf", "scale=out_color_matrix=bt709:out_range=tv", "-c:v", "libx264", "-crf",
            fmt::format("{}", format.crf), "-pix_fmt", "yuv420p", "-colorspace", "bt709",
            "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range", "tv",
            "-movflags", "+faststart", "-f", "mp4", "-y", "file:" + output};
}

/// The settings of a new process: what it reads and says, and a process group of its own, so that
/// Ctrl-C at the terminal is this program's to act on.
class SpawnSettings {
  public:
    SpawnSettings(int input, int messages) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&actions_, messages, STDERR_FILENO);
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
        posix_spawnattr_setpgroup(&attributes_, 0);
    }
    ~SpawnSettings() {
        posix_spawnattr_destroy(&attributes_);
        posix_spawn_file_actions_destroy(&actions_);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    /// An error code, or 0.
    int spawn(pid_t& process, std::vector<std::string> arguments) const {
        std::vector<char*> pointers;
        for (std::string& argument : arguments) pointers.push_back(argument.data());
        pointers.push_back(nullptr);
        return posix_spawnp(&process, pointers[0], &actions_, &attributes_, pointers.data(),
                            environ);
    }

  private:
    posix_spawn_file_actions_t actions_;
    posix_spawnattr_t attributes_;
};

/// The last lines of a file, on one.
std::string lastLines(std::FILE* file) {
    std::rewind(file);
    std::string text;
    char buffer[4096];
    while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, file)) text.append(buffer, n);
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        if (!line.empty()) lines.push_back(line);
    const std::size_t first = lines.size() - std::min(lines.size(), kLinesToQuote);
    return fmt::format(
        "{}", fmt::join(lines.begin() + static_cast<std::ptrdiff_t>(first), lines.end(), " | "));
}

}  // namespace

FilmWriter::FilmWriter(const std::string& path, const FilmFormat& format)
    : path_(path),
      file_(path),
      messages_(std::tmpfile()),
      bytes_(3 * static_cast<std::size_t>(format.width) * format.height) {
    if (!messages_) throw Error("cannot create a temporary file: " + systemMessage(errno));
    start(format);
}

void FilmWriter::start(const FilmFormat& format) {
    // A socket, since writing to a pipe whose reader is gone would end this program.
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw Error("cannot start ffmpeg: " + systemMessage(errno));
    const SpawnSettings settings(ends[1], ::fileno(messages_.get()));
    const int error = settings.spawn(process_, commandLine(format, file_.name()));
    ::close(ends[1]);
    frames_ = ends[0];
    if (error == 0) return;
    ::close(frames_);
    throw Error("cannot start ffmpeg, which encodes films: " + systemMessage(error) +
                "; install it, or write pictures, as in -o frame-%05d.png");
}

FilmWriter::~FilmWriter() {
    if (process_ < 0) return;
    ::kill(process_, SIGKILL);
    wait();
}

int FilmWriter::wait() {
    ::close(frames_);
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return status;
}

void FilmWriter::fail() {
    if (process_ >= 0) wait();
    const std::string said = lastLines(messages_.get());
    throw FileError(path_, "ffmpeg has failed: " + (said.empty() ? "it says nothing" : said));
}

void FilmWriter::add(const Image& frame) {
    assert(bytes_.size() == 3 * frame.pixels.size());
    parallelFor(frame.pixels.size(), 4096, [&](std::size_t i) {
        for (int c = 0; c < 3; ++c)
            bytes_[3 * i + static_cast<std::size_t>(c)] = srgb8FromLinear(frame.pixels[i][c]);
    });
    for (std::size_t sent = 0; sent < bytes_.size();) {
        const ssize_t n = ::send(frames_, bytes_.data() + sent, bytes_.size() - sent, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail();
        sent += static_cast<std::size_t>(n);
    }
}

void FilmWriter::finish() {
    if (wait() != 0) fail();
    file_.commit();
}

}  // namespace vlf::app
